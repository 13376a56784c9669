#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

// Dense samples (x fastest) that no formula describes, the same on every machine: the standard fixes
// what mt19937 gives, and only its plain numbers are used.

namespace isoglass {

inline std::size_t sampleCount(glm::ivec3 dims) {
    return static_cast<std::size_t>(dims.x) * dims.y * dims.z;
}

inline std::size_t sampleAt(glm::ivec3 dims, glm::ivec3 i) {
    return (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
}

/// Multiples of 2^-22 in [-1, 1).
inline std::vector<float> randomFloats(glm::ivec3 dims, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> samples(sampleCount(dims));
    for (float& sample : samples) sample = static_cast<float>(random() >> 9) * 0x1p-22f - 1;
    return samples;
}

/// 0 .. count-1.
inline std::vector<float> randomIntegers(glm::ivec3 dims, std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> samples(sampleCount(dims));
    for (float& sample : samples) sample = static_cast<float>(random() % count);
    return samples;
}

/// Makes about `percent` of the samples missing.
inline void removeSamples(std::vector<float>& samples, std::uint32_t percent, std::uint32_t seed) {
    std::mt19937 random(seed);
    for (float& sample : samples) {
        if (random() % 100 < percent) sample = std::numeric_limits<float>::quiet_NaN();
    }
}

}  // namespace isoglass
