#pragma once

#include "volume/netcdf_file.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace isoglass {

/// Reads parts of a numeric variable as samples: missing values become NaN, packed ones are unpacked.
///
/// Missing are values equal to `_FillValue` (where absent, and the type is longer than a byte, the
/// library's default fill value) or to one of `missing_value`, compared in the type that the file stores;
/// values outside `valid_range`, `valid_min`, `valid_max`; NaN, infinity and magnitudes above
/// kLargestValue. The valid range counts in stored values, but in unpacked ones where its type is that of
/// `scale_factor` or `add_offset` and wider than the stored type (NUG, appendix A). `_Unsigned` makes a
/// signed integer type unsigned. Unpacking is value * scale_factor + add_offset in double precision.
class SampleReader {
  public:
    virtual ~SampleReader() = default;
    /// Reads the box of `count` values from `start` (one entry a dimension, slowest first) into `samples`,
    /// in the order of the file. Throws Error.
    virtual void read(const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
                      std::span<float> samples) = 0;
};

/// `file` must outlive the reader.
std::unique_ptr<SampleReader> makeSampleReader(const NetcdfFile& file, const NetcdfVariable& variable);

}  // namespace isoglass
