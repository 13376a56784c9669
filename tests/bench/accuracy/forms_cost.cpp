// What the two forms of cells cost: triangles and time of the blobs with tetrahedra everywhere, with cells
// that slide between the forms, and with the gates that playback needs. The eye lies so that levels 0 to 2
// are seen; k / tau is the number of cells of the allowed size that a length of 1 at distance 1 takes.
// Prints a line of JSON for each.
#include "surface/extract_view.h"
#include "volume/analytic.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace isoglass {
namespace {

struct Form {
    const char* name;
    CellOptions options;
};

void report(const Lattice& lattice, const TimedField& field, double cellsPerLength, const Form& form) {
    const LevelSpace space(lattice);
    View view;
    view.pixelsPerUnit = 1000;
    view.cellPixels = view.pixelsPerUnit / cellsPerLength;
    // Cells of level 1 in the middle.
    const double step = space.largestStep[0];
    view.eye = glm::dvec3(2, 1, 0.5) * (2.5 * step * cellsPerLength / std::sqrt(5.25));
    const SizeField sizes(space, view, field, form.options.iso, 0);
    const LevelFields fields{space, sizes, fieldsOfLevels(space, field)};
    const auto bricks = selectBricks(space, sizes, fields.fields, form.options.iso).bricks;
    std::vector<double> times;
    std::size_t triangles = 0;
    for (int run = 0; run < 9; ++run) {
        const auto begin = std::chrono::steady_clock::now();
        std::vector<MeshPart> parts = meshBricks(fields, bricks, form.options, 0);
        triangles = joinParts(parts, space.levels[0].origin, 0).triangleCount();
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::ranges::nth_element(times, times.begin() + times.size() / 2);
    std::size_t counts[3] = {};
    for (const LevelBrick& brick : bricks) ++counts[std::min(brick.level, 2)];
    std::printf(
        R"({"cells_per_length":%g,"form":"%s","bricks":[%zu,%zu,%zu],"triangles":%zu,"median_ms":%.2f})"
        "\n",
        cellsPerLength, form.name, counts[0], counts[1], counts[2], triangles, times[times.size() / 2]);
    std::fflush(stdout);
}

}  // namespace
}  // namespace isoglass

int main() {
    using namespace isoglass;
    constexpr float kIso = 0.5f;
    const Form forms[] = {{"tetrahedra", {.iso = kIso, .form = CellForm::tetrahedral}},
                          {"slide", {.iso = kIso}},
                          {"slide and gates", {.iso = kIso, .gate = 0.03f}}};
    const Lattice lattice = makeUnitLattice(256);
    const TimedField field{makeSparseBlobs(lattice, 0, 0.05f), makeSparseBlobs(lattice, 0.1, 0.05f), 0.3f};
    for (const double cellsPerLength : {400.0, 200.0, 100.0, 50.0, 20.0}) {
        for (const Form& form : forms) report(lattice, field, cellsPerLength, form);
    }
}
