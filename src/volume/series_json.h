#pragma once

#include "volume/series_description.h"

#include <string>
#include <string_view>

namespace isoglass {

/// Text form of a description, as kept in the metadata of a series' file.
std::string toJson(const SeriesDescription& description);

/// `text` as `toJson` keeps it: bytes that are not UTF-8 become replacement characters.
std::string asUtf8(const std::string& text);

/// Inverse of `toJson`. Throws Error, with `where` naming the file, where the text is damaged or its
/// parts contradict each other.
SeriesDescription seriesFromJson(std::string_view text, const std::string& where);

}  // namespace isoglass
