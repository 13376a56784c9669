#pragma once

#include <span>
#include <string>
#include <string_view>

namespace isoglass {

/// One kind of object in the scene file and the keys it may have.
struct FormatObject {
    /// JSON pointer of the object with `*` for the place in an array: "/volumes/*/place"; "" is the root.
    std::string_view pointer;
    std::span<const std::string_view> keys;
};

/// Every object of the scene file, version 1: those keys and no others are read.
std::span<const FormatObject> sceneFormat();

/// The keys of the object at `pointer`, which has `*` for the place in an array.
std::span<const std::string_view> sceneKeys(std::string_view pointer);

/// The one of `known` that needs the fewest letters inserted, removed or replaced to become `word`; the
/// first of several. `known` must not be empty.
std::string_view closestWord(std::string_view word, std::span<const std::string_view> known);

/// The word in double quotes.
std::string inQuotes(std::string_view word);

/// "a, b, c".
std::string listWords(std::span<const std::string_view> words);

}  // namespace isoglass
