#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace isoglass {

/// Numbers that a value may take; the ends belong to it unless `openLow` or `openHigh` say otherwise.
struct NumberRange {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool openLow = false;
    bool openHigh = false;

    bool contains(double value) const;
    std::string describe() const;  ///< "a number above 0"
};

/// A value of a scene file that knows its place. Readers throw Error with the place, what was expected
/// and what was found. Refers to the document and to the name, which must outlive it.
class JsonNode {
  public:
    JsonNode(const nlohmann::json& value, const std::string& name) : JsonNode(value, name, "", "") {}

    const nlohmann::json& value() const { return *value_; }
    const std::string& pointer() const { return pointer_; }

    double number(const NumberRange& range = {}) const;
    int integer(int low, int high) const;
    bool boolean() const;
    const std::string& text() const;
    /// One of `words`, as its index.
    std::size_t choice(std::span<const std::string_view> words) const;
    /// `count` numbers in an array, handed to `store` in order.
    void numbers(std::size_t count, const std::function<void(std::size_t, double)>& store,
                 const NumberRange& range = {}) const;
    glm::dvec3 vector() const;

    /// Elements of an array.
    std::size_t size() const;
    JsonNode item(std::size_t index) const;

    /// Checks that this is an object without keys that the format does not know here.
    const JsonNode& object() const;
    /// The value of a key that the format knows here, if there is one; only after `object()`.
    std::optional<JsonNode> find(std::string_view key) const;
    JsonNode require(std::string_view key) const;

    [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const;
    [[noreturn]] void failExpected(const std::string& expected) const;
    /// `thing` belongs to the format but is not built yet; `instead` says what is.
    [[noreturn]] void failUnavailable(const std::string& thing, const std::string& instead) const;

  private:
    JsonNode(const nlohmann::json& value, const std::string& name, std::string pointer, std::string kind)
        : value_(&value), name_(&name), pointer_(std::move(pointer)), kind_(std::move(kind)) {}

    const nlohmann::json* value_;
    const std::string* name_;
    std::string pointer_;  ///< JSON pointer
    std::string kind_;     ///< the same with `*` for places in arrays, as in `sceneFormat()`
};

}  // namespace isoglass
