#include "numeric/case_fields.h"
#include "support/random_fields.h"

#include <cmath>
#include <limits>

namespace isoglass::numeric {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const glm::ivec3 kDims(17, 17, 17);

/// A ball of radius 6 whose samples with x, y and z above the middle are `hole`.
std::vector<float> ballWithHole(float hole) {
    std::vector<float> samples = ball(kDims, 6);
    const auto inHole = fill(kDims, [](glm::ivec3 i) { return i.x > 8 && i.y > 8 && i.z > 8 ? 1.0f : 0.0f; });
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (inHole[k] == 1) samples[k] = hole;
    }
    return samples;
}

/// A ball of radius 6 times a factor, which leaves the places of crossings as they are.
HardCase scaledBall(std::string name, std::string danger, float factor) {
    std::vector<float> samples = fill(kDims, [](glm::ivec3 i) {
        const glm::ivec3 d = i - 8;
        return 36.5f - static_cast<float>(d.x * d.x + d.y * d.y + d.z * d.z);
    });
    for (float& sample : samples) sample *= factor;
    return {.name = std::move(name),
            .danger = std::move(danger),
            .reason = "a factor moves no crossing of 0: the same sphere as without it",
            .lattice = unitLattice(kDims),
            .samples = samples,
            .answer = {.closed = true, .components = 1, .eulerNumber = 2}};
}

std::vector<float> randomSigns(float magnitude) {
    std::vector<float> samples = randomFloats({9, 10, 11}, 3);
    for (float& sample : samples) sample = std::copysign(magnitude, sample);
    return samples;
}

std::vector<float> neighbouringFloats() {
    std::vector<float> samples = randomFloats({9, 10, 11}, 4);
    for (float& sample : samples) sample = sample < 0 ? std::nextafter(1.0f, 0.0f) : 1.0f;
    return samples;
}

}  // namespace

std::vector<HardCase> specialValueCases() {
    std::vector<HardCase> cases;
    const auto addHole = [&](const char* name, const char* danger, float hole) {
        cases.push_back({.name = name,
                         .danger = danger,
                         .reason =
                             "cells that touch a missing sample have no surface: one eighth of the sphere is "
                             "cut out along cell faces, a disk is left",
                         .lattice = unitLattice(kDims),
                         .samples = ballWithHole(hole),
                         .answer = {.closed = false, .components = 1, .eulerNumber = 1, .loses = true}});
    };
    addHole("NanRegion", "NaN reaches vertices and normals", kNan);
    addHole("InfiniteRegion", "infinity minus infinity reaches vertices", kInfinity);
    addHole("MinusInfiniteRegion", "a cliff to minus infinity is taken for a surface", -kInfinity);
    addHole("FillValue", "a fill value of 9.97e36 times 1e2 is taken for a sample", 3e38f);
    std::vector<float> holes = randomFloats({14, 15, 16}, 8);
    removeSamples(holes, 25, 9);
    cases.push_back({.name = "RandomHoles",
                     .danger = "fans of two cells meet in one vertex beside holes",
                     .reason = "such an edge has a vertex for each of its two cells",
                     .lattice = unitLattice({14, 15, 16}),
                     .samples = holes,
                     .answer = {.closed = false, .loses = true}});

    cases.push_back(
        scaledBall("DenormalRange", "samples flush to zero, differences divide by zero", 0x1p-140f));
    cases.push_back(scaledBall("RangeOf1e30", "squares and products overflow", 0x1p100f));
    cases.push_back(scaledBall("RangeOf1eMinus30", "squares and products underflow", 0x1p-100f));
    cases.push_back({.name = "EndsOfTheFloatRange",
                     .danger = "differences of two samples overflow",
                     .reason = "samples of +-1.7e38 are the largest that count: random signs, as any others",
                     .lattice = unitLattice({9, 10, 11}),
                     .samples = randomSigns(1.7e38f)});
    cases.push_back({.name = "SmallestDenormals",
                     .danger = "half the difference of two samples is no float",
                     .reason = "samples of +-2^-149: every crossing lies in the middle of its edge",
                     .lattice = unitLattice({9, 10, 11}),
                     .samples = randomSigns(0x1p-149f)});
    cases.push_back({.name = "NearlyEqualEnds",
                     .danger = "the crossing leaves its edge when its ends differ by one rounding",
                     .reason =
                         "samples 1 and the float below it at the iso-value 1: every crossing lies exactly "
                         "on the sample that is 1",
                     .lattice = unitLattice({9, 10, 11}),
                     .samples = neighbouringFloats(),
                     .iso = 1});
    std::vector<float> outlier = ball(kDims, 6);
    outlier[sampleAt(kDims, {2, 2, 2})] = 1e30f;
    cases.push_back({.name = "OneOutlierOf1e30",
                     .danger = "a range of 1e30 swallows the smooth field's digits",
                     .reason = "the outlier is far outside the ball: a second sphere around its sample",
                     .lattice = unitLattice(kDims),
                     .samples = outlier,
                     .answer = {.closed = true, .components = 2, .eulerNumber = 4}});
    cases.push_back(
        {.name = "GradientZeroAtEveryCrossing",
         .danger = "every cell is ambiguous, and normals vanish",
         .reason = "alternating samples have central differences of 0 inside the domain: normals take "
                   "the direction of their edge",
         .lattice = unitLattice({10, 10, 10}),
         .samples =
             fill({10, 10, 10}, [](glm::ivec3 i) { return i.x % 2 ^ i.y % 2 ^ i.z % 2 ? 1.0f : -1.0f; })});
    return cases;
}

}  // namespace isoglass::numeric
