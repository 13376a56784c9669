#include "numeric/hard_cases.h"
#include "surface/extract.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

// The hard cases once more, by IsoGlass and by VTK's vtkFlyingEdges3D (W. Schroeder, R. Maynard, B. Geveci,
// "Flying Edges: a high-performance scalable isocontouring algorithm", 2015) in one run. Prints a line for
// each: name, IsoGlass, Flying Edges, separated by tabs. Fails where IsoGlass breaks its contract.

namespace {

using namespace isoglass;
using numeric::HardCase;

/// The step of an evenly spaced axis; nothing for others, which Flying Edges does not take.
std::optional<double> stepOf(const Axis& axis) {
    if (axis.period || axis.size() < 2) return axis.size() == 1 ? std::optional(1.0) : std::nullopt;
    const double step = axis.coordinates[1] - axis.coordinates[0];
    for (std::size_t i = 1; i < axis.size(); ++i) {
        const double other = axis.coordinates[i] - axis.coordinates[i - 1];
        if (std::abs(other - step) > 1e-6 * std::abs(step)) return std::nullopt;
    }
    return step;
}

SurfaceMesh meshOf(vtkPolyData& surface) {
    SurfaceMesh mesh;
    for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
        const double* p = surface.GetPoint(i);
        mesh.positions.emplace_back(p[0], p[1], p[2]);
    }
    vtkNew<vtkIdList> ids;
    vtkCellArray* polygons = surface.GetPolys();
    for (polygons->InitTraversal(); polygons->GetNextCell(ids);) {
        for (int k = 0; k < 3; ++k) mesh.triangles.push_back(static_cast<std::uint32_t>(ids->GetId(k)));
    }
    return mesh;
}

/// In time it gets the interpolated samples; where inside is below, the negated ones.
std::optional<SurfaceMesh> flyingEdges(const HardCase& hard) {
    vtkNew<vtkImageData> image;
    const glm::ivec3 dims = hard.lattice.dims();
    image->SetDimensions(dims.x, dims.y, dims.z);
    std::array<double, 3> steps;
    for (int k = 0; k < 3; ++k) {
        const auto step = stepOf(hard.lattice.axes[k]);
        if (!step) return std::nullopt;
        steps[k] = *step;
    }
    image->SetSpacing(steps.data());
    image->SetOrigin(hard.lattice.axes[0].coordinates[0], hard.lattice.axes[1].coordinates[0],
                     hard.lattice.axes[2].coordinates[0]);
    const float sign = hard.below ? -1.0f : 1.0f;
    vtkNew<vtkFloatArray> values;
    for (std::size_t i = 0; i < hard.samples.size(); ++i) {
        const float a = hard.samples[i];
        const float b = hard.later.empty() ? a : hard.later[i];
        values->InsertNextValue(sign * (hard.fraction == 0 ? a : a + hard.fraction * (b - a)));
    }
    image->GetPointData()->SetScalars(values);
    vtkNew<vtkFlyingEdges3D> filter;
    filter->SetInputData(image);
    filter->SetValue(0, sign * hard.iso);
    filter->ComputeNormalsOff();
    filter->Update();
    return meshOf(*filter->GetOutput());
}

}  // namespace

int main() {
    bool sound = true;
    for (const HardCase& hard : numeric::hardCases()) {
        const SurfaceMesh own = extractSurface(hard.lattice, hard.field(), hard.options()).mesh;
        sound = sound && checkTopology(own).isOrientedManifold() && measure(own).nonFiniteVertices == 0;
        const auto peer = flyingEdges(hard);
        std::printf("%s\t%s\t%s\n", hard.name.c_str(), numeric::describe(own).c_str(),
                    peer ? numeric::describe(*peer).c_str() : "takes even, open axes only");
    }
    return sound ? 0 : 1;
}
