#pragma once

#include "volume/series_description.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace isoglass {

/// A file or sequence in some foreign format, read one key frame at a time.
///
/// Use from one thread at a time.
class FrameSource {
  public:
    virtual ~FrameSource() = default;

    /// Complete but for `frames`; known as soon as the source is open.
    virtual const SeriesDescription& description() const = 0;

    /// Reads key frame `frame` into `samples`: dims x*y*z values, x fastest, then y, then z. A missing
    /// sample (fill value, NaN, infinity, or of magnitude above kLargestValue) becomes a quiet NaN.
    virtual void read(std::size_t frame, std::span<float> samples) = 0;

    /// Reads the heights of the samples of key frame `frame`, in the same order. Called only where the
    /// description's lattice has `heights`, of which but the name and the units are known before.
    virtual void readHeights(std::size_t frame, std::span<float> heights);
};

/// Samples above this magnitude count as missing: a difference of two could not be represented.
inline constexpr float kLargestValue = 1.7e38f;

struct ImportOptions {
    /// Which variable to read, or a formula over several (see expression.h), as "EXPRESSION" or
    /// "NAME = EXPRESSION"; empty takes the only variable that has the shape.
    std::string variable;
    std::vector<double> times;  ///< replaces the times of the source, one a key frame; empty keeps them
    std::string height = {};    ///< like `variable`, the world z of the samples; empty takes the z axis
};

/// Opens a NetCDF file by the CF conventions: time units and calendar (year 0, climatologies, modulo
/// axes; dates in WRF's `Times`), `_FillValue` / `missing_value` / `valid_range`, packed data
/// (`scale_factor`, `add_offset`), ascending, descending and rectilinear axes, `positive: down`, periodic
/// longitude. WRF's staggered variables are brought to the cell centres, formulas are evaluated there. Throws
/// Error.
std::unique_ptr<FrameSource> openNetcdf(const std::filesystem::path& file, const ImportOptions& options);

/// Opens a sequence of PVM files, one key frame each, in the order given (header `PVM`, dims, bytes
/// per sample, each on a line; then the samples). Times are 0, 1, 2, ... unless `options.times` says
/// otherwise. Throws Error.
std::unique_ptr<FrameSource> openPvm(std::span<const std::filesystem::path> files,
                                     const ImportOptions& options);

}  // namespace isoglass
