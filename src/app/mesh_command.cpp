#include "app/commands.h"
#include "app/text.h"
#include "base/atomic_file.h"
#include "meshio/mesh_file.h"
#include "meshio/mesh_format.h"
#include "surface/extract.h"
#include "volume/time_axis.h"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <iostream>

namespace isoglass {

namespace {

TimedField readField(const SeriesFile& file, double time) {
    const TimeSample sample = locate(file.description().time, time);
    if (sample.where != TimeSample::Where::inside) {
        printNote("time " + formatNumber(time) + " lies outside the series: the nearest key frame, " +
                  formatNumber(file.description().time.times[sample.frameA]) + ", is shown");
    }
    TimedField field;
    field.a = file.read(sample.frameA);
    if (sample.fraction > 0) field.b = file.read(sample.frameB);
    field.fraction = static_cast<float>(sample.fraction);
    return field;
}

std::optional<View> viewOf(const MeshCommand& command) {
    if (!command.eye) return std::nullopt;
    View view;
    view.eye = *command.eye;
    view.pixelsPerUnit = command.size.y / (2 * std::tan(glm::radians(command.fovDegrees) / 2));
    view.cellPixels = command.cellPixels;
    view.errorPixels = command.errorPixels;
    return view;
}

}  // namespace

void runMesh(const MeshCommand& command, const CommonOptions& common) {
    if (command.wholeSeries) return runMeshSeries(command, common);
    meshFormat(command.out);  // before the work: an unknown extension is an error
    checkPlace(command.out);
    const SeriesFile file(command.series);
    const double time = command.time.value_or(file.description().time.times.front());
    const Extraction result = extractSurface(file.description().lattice, readField(file, time),
                                             {.iso = static_cast<float>(command.iso),
                                              .insideIsBelow = command.insideIsBelow,
                                              .view = viewOf(command),
                                              .still = true,
                                              .threads = common.threads});
    const ExtractStats& stats = result.stats;
    if (result.mesh.empty()) {
        printNote("the mesh is empty: iso-value " + formatNumber(command.iso) +
                  ", but at this time the field is " +
                  (stats.range.min > stats.range.max
                       ? "missing everywhere"
                       : "from " + formatNumber(stats.range.min) + " to " + formatNumber(stats.range.max)));
    }
    if (stats.lostCells > 0) {
        printNote(std::to_string(stats.lostCells) +
                  " cells beside missing samples have no surface: it ends there");
    }
    writeMesh(command.out, result.mesh);
    std::cout << command.out.string() << ": " << result.mesh.vertexCount() << " vertices, "
              << result.mesh.triangleCount() << " triangles";
    const glm::dvec3 origin = result.mesh.origin;
    if (origin != glm::dvec3(0)) {
        std::cout << ", positions relative to " << formatNumber(origin.x) << ' ' << formatNumber(origin.y)
                  << ' ' << formatNumber(origin.z);
    }
    std::cout << '\n';
}

}  // namespace isoglass
