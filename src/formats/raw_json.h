#pragma once

#include "formats/file_source.h"

#include <span>
#include <string_view>

namespace isoglass {

/// RAW: plain numbers, described by a JSON file (data/raw.schema.json is the reference). The samples lie in
/// one file for all key frames, in one a key frame, or in one a slice, plain or gzip; relative names lie
/// beside the description. Errors have the JSON pointer. Throws Error.
std::unique_ptr<FileSource> openRaw(const std::filesystem::path& description, const std::string& variable);

/// One kind of object in a RAW description, as a JSON pointer with `*` for places in arrays, and the keys
/// that it may have.
struct RawObject {
    std::string_view pointer;
    std::span<const std::string_view> keys;
};
std::span<const RawObject> rawFormat();

}  // namespace isoglass
