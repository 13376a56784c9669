#include "numeric/case_fields.h"
#include "support/random_fields.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass::numeric {

namespace {

const glm::ivec3 kDims(17, 17, 17);

Lattice steppedLattice(glm::ivec3 dims, double growth) {
    Lattice lattice = unitLattice(dims);
    for (int i = 1; i < dims.x; ++i)
        lattice.axes[0].coordinates[i] = lattice.axes[0].coordinates[i - 1] + std::pow(growth, i - 1);
    return lattice;
}

HardCase thinSheet(std::string name, double z, HardCase::Answer answer, std::string reason) {
    return {
        .name = std::move(name),
        .danger = "a sheet thinner than a cell gives holes or loose pieces",
        .reason = std::move(reason),
        .lattice = unitLattice({9, 9, 9}),
        .samples = fill({9, 9, 9}, [=](glm::ivec3 i) { return static_cast<float>(0.2 - std::abs(i.z - z)); }),
        .answer = std::move(answer)};
}

}  // namespace

std::vector<HardCase> latticeCases() {
    std::vector<HardCase> cases;
    cases.push_back({.name = "AnisotropyOf10000",
                     .danger = "flat cells lose their normals and the winding",
                     .reason = "the ball of radius 6 in samples, squeezed to 1/10000 in z: one closed sphere",
                     .lattice = makeUniformLattice(kDims, glm::dvec3(0), {1, 1, 1e-4}),
                     .samples = ball(kDims, 6),
                     .answer = {.closed = true, .components = 1, .eulerNumber = 2}});
    // 16 steps that grow to 1000 times the first.
    const Lattice stepped = steppedLattice(kDims, std::pow(1000, 1.0 / 15));
    cases.push_back(
        {.name = "RectilinearStepsOf1To1000",
         .danger = "index space is taken for world space",
         .reason = "f = x is linear, so the surface is the plane x = 100 exactly: one sheet over the "
                   "domain's 16 x 16",
         .lattice = stepped,
         .samples =
             fill(kDims, [&](glm::ivec3 i) { return static_cast<float>(stepped.axes[0].coordinates[i.x]); }),
         .iso = 100,
         .answer = {.closed = false, .components = 1, .eulerNumber = 1, .area = 256.0}});
    cases.push_back(thinSheet("ThinSheetOnSamples", 4,
                              {.closed = false, .components = 2, .eulerNumber = 2, .area = 2 * 64.0},
                              "one plane of samples is inside: two sheets, above and below it, 8 x 8 each"));
    cases.push_back(thinSheet("ThinSheetBetweenSamples", 4.5, {.triangles = 0},
                              "no sample is inside: linear interpolation knows of no sheet"));
    cases.push_back({.name = "DomainOneCellThin",
                     .danger = "bricks without inner samples, gradients without neighbours",
                     .reason = "the ball's middle slice of one cell: an open band",
                     .lattice = unitLattice({17, 17, 2}),
                     .samples = ball({17, 17, 2}, 6),
                     .answer = {.closed = false, .components = 1, .eulerNumber = 0}});
    cases.push_back({.name = "DomainOneSampleThin",
                     .danger = "a domain without cells",
                     .reason = "there is no cell, hence no surface",
                     .lattice = unitLattice({17, 17, 1}),
                     .samples = ball({17, 17, 1}, 6),
                     .answer = {.triangles = 0}});
    cases.push_back({.name = "SizesThatAreNoMultipleOfABrick",
                     .danger = "samples beyond the domain's end take part",
                     .reason = "random samples to the very end of a 23 x 9 x 15 domain",
                     .lattice = unitLattice({23, 9, 15}),
                     .samples = randomFloats({23, 9, 15}, 2)});
    Lattice far = makeUniformLattice(kDims, {5e6, 6.4e6, -6.4e6}, glm::dvec3(1));
    cases.push_back({.name = "CoordinatesOf6400km",
                     .danger = "positions in float step by half a metre",
                     .reason = "positions are relative to an origin in double: the ball of radius 6 as at 0",
                     .lattice = far,
                     .samples = ball(kDims, 6),
                     .answer = {.closed = true, .components = 1, .eulerNumber = 2}});
    Lattice mirrored = unitLattice(kDims);
    std::ranges::reverse(mirrored.axes[1].coordinates);
    cases.push_back(
        {.name = "DescendingAxis",
         .danger = "the mirrored mapping turns the surface inside out",
         .reason = "winding follows the sign of the mapping: the cube of samples 4 to 12, volume 8^3",
         .lattice = mirrored,
         .samples =
             fill(kDims,
                  [](glm::ivec3 i) {
                      return std::min({i.x, i.y, i.z}) >= 4 && std::max({i.x, i.y, i.z}) <= 12 ? 1.0f : 0.0f;
                  }),
         .iso = 1,
         .answer = {.closed = true, .components = 1, .eulerNumber = 2, .area = 6 * 64.0, .volume = 512.0}});
    return cases;
}

}  // namespace isoglass::numeric
