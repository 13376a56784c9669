#pragma once

#include "formats/file_source.h"
#include "formats/payload.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace isoglass {

/// Number types of stored samples.
enum class SampleType { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

/// Names of the types in the order of the enumeration: "u8", "i8", ...
std::span<const std::string_view> sampleTypeNames();
std::size_t bytesPerSample(SampleType type);

/// How an array of numbers lies in a payload.
struct RawLayout {
    SampleType type = SampleType::u8;
    bool bigEndian = false;
    /// Lengths along the axes of the array, fastest first: three, and one of time where there is one.
    std::vector<std::uint64_t> lengths;
    /// Which axis of the array is x, y, z.
    std::array<std::size_t, 3> axes{0, 1, 2};
    /// Which axis of the array counts the key frames.
    std::optional<std::size_t> time;
    /// Sample = slope * stored + intercept.
    double slope = 1;
    double intercept = 0;
    std::optional<double> missing;  ///< stored number that stands for a missing sample

    std::uint64_t samples() const;
    std::uint64_t bytes() const { return samples() * bytesPerSample(type); }
    std::uint64_t frames() const { return time ? lengths[*time] : 1; }
};

/// Checks the lengths of the axes (see `requireVolume`) and the number of key frames, 1 to `kLongestAxis`.
/// Returns the lengths of the axes of space in the order of the array. Throws Error.
std::array<std::uint64_t, 3> requireSizes(const RawLayout& layout, const std::string& place);

/// A file of plain numbers, described.
struct RawFile {
    SeriesDescription description;  ///< with one time a key frame
    bool knowsTimes = false;
    RawLayout layout;
    /// The payload is that of these files one after the other, each with an equal share.
    std::vector<std::filesystem::path> files;
    PayloadPlace place;  ///< in every file; `size` is the whole, and is set by `openRawFile`
};

/// Checks sizes and opens the payload. Throws Error.
std::unique_ptr<FileSource> openRawFile(RawFile file);

}  // namespace isoglass
