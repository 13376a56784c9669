#include "scene/json_node.h"

#include "base/error.h"
#include "scene/json_document.h"
#include "scene/scene_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace isoglass {

namespace {

std::string numeral(double value) {
    std::array<char, 32> text;
    const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
    return std::string(text.data(), result.ptr);
}

std::string brief(const nlohmann::json& value) {
    constexpr std::size_t kLongest = 40;
    if (value.is_object()) return value.empty() ? "an empty object" : "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    std::string text = value.dump(-1, ' ', true);
    if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
    return text;
}

}  // namespace

bool NumberRange::contains(double value) const {
    return (openLow ? value > low : value >= low) && (openHigh ? value < high : value <= high);
}

std::string NumberRange::describe() const {
    std::string text = "a number";
    if (std::isfinite(low)) text += (openLow ? " above " : " of at least ") + numeral(low);
    if (std::isfinite(low) && std::isfinite(high)) text += " and";
    if (std::isfinite(high)) text += (openHigh ? " below " : " of at most ") + numeral(high);
    return text;
}

double JsonNode::number(const NumberRange& range) const {
    if (!value_->is_number()) failExpected(range.describe());
    const auto number = value_->get<double>();
    if (!std::isfinite(number) || !range.contains(number)) failExpected(range.describe());
    return number;
}

int JsonNode::integer(int low, int high) const {
    const std::string expected = "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    if (!value_->is_number()) failExpected(expected);
    const auto number = value_->get<double>();
    if (!(number >= low && number <= high) || number != std::floor(number)) failExpected(expected);
    return static_cast<int>(number);
}

bool JsonNode::boolean() const {
    if (!value_->is_boolean()) failExpected("true or false");
    return value_->get<bool>();
}

const std::string& JsonNode::text() const {
    if (!value_->is_string()) failExpected("a text");
    return value_->get_ref<const std::string&>();
}

std::size_t JsonNode::choice(std::span<const std::string_view> words) const {
    if (!value_->is_string()) failExpected("one of " + listWords(words));
    const std::string& word = text();
    const auto found = std::ranges::find(words, word);
    if (found == words.end()) {
        fail("expected one of " + listWords(words) + ", found " + brief(*value_),
             "did you mean " + inQuotes(closestWord(word, words)) + "?");
    }
    return static_cast<std::size_t>(found - words.begin());
}

void JsonNode::numbers(std::size_t count, const std::function<void(std::size_t, double)>& store,
                       const NumberRange& range) const {
    if (!value_->is_array() || value_->size() != count) {
        failExpected("an array of " + std::to_string(count) + " numbers");
    }
    for (std::size_t i = 0; i < count; ++i) store(i, item(i).number(range));
}

glm::dvec3 JsonNode::vector() const {
    glm::dvec3 vector;
    numbers(3, [&](std::size_t i, double value) { vector[static_cast<int>(i)] = value; });
    return vector;
}

std::size_t JsonNode::size() const {
    if (!value_->is_array()) failExpected("an array");
    return value_->size();
}

JsonNode JsonNode::item(std::size_t index) const {
    return {value_->at(index), *name_, childPointer(pointer_, std::to_string(index)), kind_ + "/*"};
}

const JsonNode& JsonNode::object() const {
    if (!value_->is_object()) failExpected("an object");
    const auto known = sceneKeys(kind_);
    for (const auto& [key, value] : value_->items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        throw Error(
            "unknown key " + inQuotes(key), jsonPlace(*name_, childPointer(pointer_, key)),
            "did you mean " + inQuotes(closestWord(key, known)) + "? Known here: " + listWords(known));
    }
    return *this;
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
    if (std::ranges::find(sceneKeys(kind_), key) == sceneKeys(kind_).end()) {
        throw std::logic_error("the scene format has no key " + kind_ + "/" + std::string(key));
    }
    const auto found = value_->find(key);
    if (found == value_->end()) return std::nullopt;
    return JsonNode(*found, *name_, childPointer(pointer_, key), kind_ + "/" + std::string(key));
}

JsonNode JsonNode::require(std::string_view key) const {
    auto node = find(key);
    if (!node) {
        throw Error("the key " + inQuotes(key) + " is missing",
                    jsonPlace(*name_, childPointer(pointer_, key)));
    }
    return *std::move(node);
}

void JsonNode::fail(const std::string& what, const std::string& hint) const {
    throw Error(what, jsonPlace(*name_, pointer_), hint);
}

void JsonNode::failExpected(const std::string& expected) const {
    fail("expected " + expected + ", found " + brief(*value_));
}

void JsonNode::failUnavailable(const std::string& thing, const std::string& instead) const {
    fail(thing + " is not available in this version", instead);
}

}  // namespace isoglass
