#include "numeric/case_fields.h"
#include "support/random_fields.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass::numeric {

Lattice unitLattice(glm::ivec3 dims) {
    return makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
}

std::vector<float> fill(glm::ivec3 dims, const std::function<float(glm::ivec3)>& value) {
    std::vector<float> samples;
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            for (int x = 0; x < dims.x; ++x) samples.push_back(value({x, y, z}));
        }
    }
    return samples;
}

std::vector<float> ball(glm::ivec3 dims, double radius) {
    const glm::dvec3 middle = 0.5 * glm::dvec3(dims - 1);
    return fill(
        dims, [&](glm::ivec3 i) { return static_cast<float>(radius - glm::length(glm::dvec3(i) - middle)); });
}

namespace {

const glm::ivec3 kDims(9, 9, 9);

/// 1, the iso-value, in a box of samples and 0 around it.
std::vector<float> box(glm::ivec3 low, glm::ivec3 high) {
    return fill(kDims, [=](glm::ivec3 i) {
        for (int k = 0; k < 3; ++k) {
            if (i[k] < low[k] || i[k] > high[k]) return 0.0f;
        }
        return 1.0f;
    });
}

HardCase::Answer closedBox(glm::dvec3 sides) {
    return {.closed = true,
            .components = 1,
            .eulerNumber = 2,
            .area = 2 * (sides.x * sides.y + sides.y * sides.z + sides.z * sides.x),
            .volume = sides.x * sides.y * sides.z};
}

}  // namespace

std::vector<HardCase> equalSampleCases() {
    const Lattice lattice = unitLattice(kDims);
    std::vector<HardCase> cases;
    cases.push_back({.name = "OneSampleEqualsTheIsoValue",
                     .danger = "a point turns into loose or flipped slivers",
                     .reason =
                         "inside is f >= iso, so the sample is inside and its sphere shrinks to the point: "
                         "topology of a sphere, no area, no volume",
                     .lattice = lattice,
                     .samples = box({4, 4, 4}, {4, 4, 4}),
                     .iso = 1,
                     .answer = closedBox({0, 0, 0})});
    cases.push_back({.name = "AnEdgeOfSamplesEqualsTheIsoValue",
                     .danger = "a line turns into open slivers",
                     .reason = "the closed hull of samples 2 to 6 on a line: a sphere shrunk to the line",
                     .lattice = lattice,
                     .samples = box({2, 4, 4}, {6, 4, 4}),
                     .iso = 1,
                     .answer = closedBox({4, 0, 0})});
    cases.push_back({.name = "AFaceOfSamplesEqualsTheIsoValue",
                     .danger = "a sheet without thickness loses a side",
                     .reason = "both sides of a 4 x 4 square, 16 each, and nothing between them",
                     .lattice = lattice,
                     .samples = box({2, 2, 4}, {6, 6, 4}),
                     .iso = 1,
                     .answer = closedBox({4, 4, 0})});
    cases.push_back({.name = "AWholeCellEqualsTheIsoValue",
                     .danger = "the inside of the cell is ambiguous",
                     .reason = "all crossings lie at the inside samples: the surface is the cell's own cube",
                     .lattice = lattice,
                     .samples = box({3, 3, 3}, {4, 4, 4}),
                     .iso = 1,
                     .answer = closedBox({1, 1, 1})});
    cases.push_back(
        {.name = "AWholeSlabEqualsTheIsoValue",
         .danger = "a flat region gives surface everywhere or holes",
         .reason = "samples z <= 4 are inside: the plane z = 4, 8 x 8, ending where the domain does",
         .lattice = lattice,
         .samples = fill(kDims, [](glm::ivec3 i) { return i.z <= 4 ? 1.0f : 0.0f; }),
         .iso = 1,
         .answer = {.closed = false, .components = 1, .eulerNumber = 1, .area = 64.0}});
    cases.push_back({.name = "TheWholeFieldEqualsTheIsoValue",
                     .danger = "every cell is touched",
                     .reason = "f >= iso everywhere: all is inside, and the domain's end is no surface",
                     .lattice = lattice,
                     .samples = std::vector<float>(sampleCount(kDims), 1),
                     .iso = 1,
                     .answer = {.triangles = 0}});
    cases.push_back(
        {.name = "PlateauBetweenHigherAndLower",
         .danger = "the plateau tears at its rims",
         .reason = "2 in the middle, the iso-value 1 around it, 0 outside: the plateau belongs to the "
                   "inside, so the surface is the cube around samples 2 to 6",
         .lattice = lattice,
         .samples =
             fill(kDims,
                  [](glm::ivec3 i) {
                      const int reach = std::max({std::abs(i.x - 4), std::abs(i.y - 4), std::abs(i.z - 4)});
                      return reach <= 1 ? 2.0f : reach <= 2 ? 1.0f : 0.0f;
                  }),
         .iso = 1,
         .answer = closedBox({4, 4, 4})});
    cases.push_back({.name = "RandomIntegersAtAnIntegerIsoValue",
                     .danger = "a third of all samples equal the iso-value",
                     .reason = "any pattern of inside samples gives a manifold by edge identity",
                     .lattice = unitLattice({17, 17, 17}),
                     .samples = randomIntegers({17, 17, 17}, 3, 11),
                     .iso = 1});
    cases.push_back(
        {.name = "IntegerBallAtAnIntegerIsoValue",
         .danger = "distances in whole numbers: crossings fall on samples",
         .reason = "samples with |x|^2 <= 36 are connected through their neighbours and so is the rest: "
                   "one sphere",
         .lattice = unitLattice({17, 17, 17}),
         .samples = fill({17, 17, 17},
                         [](glm::ivec3 i) {
                             const glm::ivec3 d = i - 8;
                             return 36.0f - static_cast<float>(d.x * d.x + d.y * d.y + d.z * d.z);
                         }),
         .iso = 0,
         .answer = {.closed = true, .components = 1, .eulerNumber = 2}});
    cases.push_back({.name = "IsoValueIsTheMaximum",
                     .danger = "the skipping of bricks cuts off the extreme",
                     .reason = "one sample reaches the maximum, so its sphere, a point, is the surface",
                     .lattice = unitLattice({9, 9, 9}),
                     .samples = ball(kDims, 0),
                     .iso = 0,
                     .answer = closedBox({0, 0, 0})});
    cases.push_back({.name = "IsoValueIsTheMinimum",
                     .danger = "equality at the lower end gives a skin around the domain",
                     .reason = "f >= min holds everywhere: all is inside",
                     .lattice = unitLattice({9, 9, 9}),
                     .samples = box({2, 2, 2}, {6, 6, 6}),
                     .iso = 0,
                     .answer = {.triangles = 0}});
    cases.push_back(
        {.name = "IsoValueIsTheMinimumOfAColdPool",
         .danger = "inside below is not the mirror image of inside above",
         .reason = "f <= min holds in the cube of samples alone",
         .lattice = unitLattice({9, 9, 9}),
         .samples =
             fill(kDims,
                  [](glm::ivec3 i) {
                      return std::min({i.x, i.y, i.z}) >= 2 && std::max({i.x, i.y, i.z}) <= 6 ? -1.0f : 0.0f;
                  }),
         .iso = -1,
         .below = true,
         .answer = closedBox({4, 4, 4})});
    return cases;
}

}  // namespace isoglass::numeric
