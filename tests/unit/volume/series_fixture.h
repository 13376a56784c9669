#pragma once

#include "support/random_fields.h"
#include "unit/mesh_io/scratch_folder.h"
#include "volume/series_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace isoglass::test {

/// Key frames from memory.
class MemorySource final : public FrameSource {
  public:
    MemorySource(SeriesDescription description, std::vector<std::vector<float>> frames)
        : description_(std::move(description)), frames_(std::move(frames)) {}

    const SeriesDescription& description() const override { return description_; }
    void read(std::size_t frame, std::span<float> samples) override {
        ASSERT_EQ(samples.size(), frames_[frame].size());
        std::ranges::copy(frames_[frame], samples.begin());
    }

    const std::vector<float>& frame(std::size_t i) const { return frames_[i]; }

  private:
    SeriesDescription description_;
    std::vector<std::vector<float>> frames_;
};

/// A description of key frames at times 0, 1, 2, ...
inline SeriesDescription describe(const Lattice& lattice, std::size_t frames) {
    SeriesDescription series;
    series.name = "field";
    series.lattice = lattice;
    for (std::size_t i = 0; i < frames; ++i) series.time.times.push_back(static_cast<double>(i));
    return series;
}

inline std::uint32_t bitsOf(float value) {
    return std::bit_cast<std::uint32_t>(value);
}

/// Index of the first sample whose bits differ, missing ones (any NaN) being equal; -1 where none does.
inline std::ptrdiff_t firstDifference(const KeyFrame& frame, const std::vector<float>& samples) {
    const glm::ivec3 dims = frame.dims();
    std::ptrdiff_t i = 0;
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            for (int x = 0; x < dims.x; ++x, ++i) {
                const float found = frame.sample({x, y, z});
                const float wanted = samples[static_cast<std::size_t>(i)];
                if (std::isnan(wanted) ? !std::isnan(found) : bitsOf(found) != bitsOf(wanted)) return i;
            }
        }
    }
    return -1;
}

inline std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace isoglass::test
