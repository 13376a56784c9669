#pragma once

#include "volume/lattice.h"
#include "volume/time_axis.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// Smallest and largest value of a set of samples; an empty set has min = +inf, max = -inf.
struct ValueRange {
    float min = std::numeric_limits<float>::infinity();
    float max = -std::numeric_limits<float>::infinity();

    friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// What is known of one coarser level of a key frame (see pyramid.h) that is stored beside it.
struct LevelRecord {
    std::uint32_t checksum = 0;  ///< as that of the key frame
    std::uint64_t bytes = 0;     ///< memory that the level takes once it is read alone, with its heights
    std::optional<std::uint32_t> heightsChecksum = {};
};

/// What is known of one key frame without reading its samples.
struct FrameRecord {
    ValueRange range;                ///< over valid samples
    std::uint64_t validSamples = 0;  ///< the others are missing
    std::uint64_t activeVoxels = 0;  ///< stored one by one, not as part of a constant tile
    std::uint32_t checksum = 0;      ///< CRC-32 of the samples as stored
    std::uint64_t bytes = 0;         ///< memory that the key frame takes once it is read, with its heights
    /// CRC-32 of the heights as stored, where the lattice has them.
    std::optional<std::uint32_t> heightsChecksum = {};
    /// Levels 1 to the top one where they are stored, else empty.
    std::vector<LevelRecord> levels = {};
};

/// Everything that describes a series but its samples. Kept as metadata in the series' file.
struct SeriesDescription {
    std::string name;      ///< variable or grid name, e.g. "TEMP"
    std::string longName;  ///< for people, e.g. "Temperature"; may be empty
    std::string units;     ///< of the samples, e.g. "degC"; may be empty
    Lattice lattice;
    TimeAxis time;
    std::vector<FrameRecord> frames;  ///< one a key frame; empty until the samples were read

    /// Inactive voxels are missing samples. Only series that IsoGlass wrote say so; elsewhere an
    /// inactive voxel has the value that the tree holds for it.
    bool inactiveIsMissing = true;
    double storedError = 0;          ///< largest |stored - source| that `--tolerance` allowed
    std::optional<ValueRange> keep;  ///< iso-values for which the surface is as in the source, if limited
    std::string provenance;          ///< where the samples come from: file name, format, source's history
    std::vector<std::string> notes;  ///< what the import did to axes and times, a sentence each
};

}  // namespace isoglass
