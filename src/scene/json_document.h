#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace isoglass {

/// Parses a JSON text. Stricter than the library alone: the same key twice in an object is an error.
/// Throws Error with line and column for a syntax error, with the JSON pointer for a repeated key;
/// `name` stands for the text in messages.
nlohmann::json parseJson(std::string_view text, const std::string& name);

/// The pointer to `token` inside the value at `pointer` (RFC 6901: `~` and `/` are escaped).
std::string childPointer(const std::string& pointer, std::string_view token);

/// How messages name a place: "NAME, POINTER", or NAME alone for the root.
std::string jsonPlace(const std::string& name, const std::string& pointer);

}  // namespace isoglass
