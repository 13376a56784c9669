#include "numeric/case_fields.h"
#include "support/random_fields.h"

#include <limits>

namespace isoglass::numeric {

namespace {

const glm::ivec3 kDims(17, 17, 17);

std::vector<float> negated(std::vector<float> samples) {
    for (float& sample : samples) sample = -sample;
    return samples;
}

}  // namespace

std::vector<HardCase> timeCases() {
    std::vector<HardCase> cases;
    cases.push_back({.name = "EqualKeyFrames",
                     .danger = "a still surface trembles between equal key frames",
                     .reason = "a + s (a - a) = a for every s: the ball stays what it is",
                     .lattice = unitLattice(kDims),
                     .samples = ball(kDims, 6),
                     .later = ball(kDims, 6),
                     .fraction = 1.0f / 3,
                     .answer = {.closed = true, .components = 1, .eulerNumber = 2}});
    cases.push_back({.name = "SignFlipBetweenKeyFrames",
                     .danger = "halfway the whole field equals the iso-value",
                     .reason = "a + (-a - a)/2 = 0 exactly, and f >= 0 is inside: no surface at that moment",
                     .lattice = unitLattice(kDims),
                     .samples = ball(kDims, 6),
                     .later = negated(ball(kDims, 6)),
                     .fraction = 0.5f,
                     .answer = {.triangles = 0}});
    cases.push_back({.name = "SignFlipJustBeforeHalfway",
                     .danger = "a field about to vanish loses its digits",
                     .reason = "a (1 - 2s) has the crossings of a: the ball",
                     .lattice = unitLattice(kDims),
                     .samples = ball(kDims, 6),
                     .later = negated(ball(kDims, 6)),
                     .fraction = 0.5f - 0x1p-10f,
                     .answer = {.closed = true, .components = 1, .eulerNumber = 2}});
    cases.push_back(
        {.name = "SignFlipAtTheEndsOfTheFloatRange",
         .danger = "the difference of two key frames overflows",
         .reason = "1.7e38 - -1.7e38 is still a float: a quarter of the way all signs are those of a",
         .lattice = unitLattice({9, 9, 9}),
         .samples = fill({9, 9, 9}, [](glm::ivec3 i) { return i.z < 4 ? 1.7e38f : -1.7e38f; }),
         .later = fill({9, 9, 9}, [](glm::ivec3 i) { return i.z < 4 ? -1.7e38f : 1.7e38f; }),
         .fraction = 0.25f,
         .answer = {.closed = false, .components = 1, .eulerNumber = 1, .area = 64.0}});
    std::vector<float> a = ball(kDims, 6);
    std::vector<float> b = ball(kDims, 7);
    removeSamples(a, 5, 1);
    removeSamples(b, 5, 2);
    cases.push_back({.name = "HolesThatDifferBetweenKeyFrames",
                     .danger = "a sample known at one time only is used at another",
                     .reason = "between two key frames a sample is known where both know it",
                     .lattice = unitLattice(kDims),
                     .samples = a,
                     .later = b,
                     .fraction = 0.5f,
                     .answer = {.closed = false, .loses = true}});
    cases.push_back({.name = "RandomKeyFramesAlmostAtTheSecond",
                     .danger = "a fraction of 1 - 2^-24 is rounded to the key frame or beyond it",
                     .reason = "the samples are those of a + s (b - a) in float",
                     .lattice = unitLattice({12, 11, 10}),
                     .samples = randomIntegers({12, 11, 10}, 3, 7),
                     .iso = 1,
                     .later = randomIntegers({12, 11, 10}, 3, 8),
                     .fraction = 1 - 0x1p-24f});
    return cases;
}

}  // namespace isoglass::numeric
