#pragma once

#include "volume/series_file.h"

#include <filesystem>

namespace isoglass {

/// Writes a whole series as RAW: `out` (.json) with the description and, beside it under the same name with
/// .raw, all samples as little-endian floats, x fastest, key frame after key frame, NaN where missing.
/// `openRaw` reads it back: the same samples, axes and times. Both files appear when both are whole.
/// Throws Error, also where the series has heights (`Lattice::heights`), which RAW cannot hold.
void writeRaw(const SeriesFile& series, const std::filesystem::path& out,
              const ImportProgress& progress = {});

}  // namespace isoglass
