#include "formats/header_text.h"

#include "base/error.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace isoglass {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

template <typename Number>
std::optional<Number> parsed(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return lower;
}

std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> found;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        const std::size_t end = std::min(text.size(), text.find_first_of(kBlanks));
        found.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return found;
}

std::optional<double> numberOf(std::string_view text) {
    return parsed<double>(text);
}

std::optional<std::uint64_t> countOf(std::string_view text) {
    return parsed<std::uint64_t>(text);
}

void HeaderText::add(std::string key, std::string value) {
    if (find({key})) fail("the field \"" + key + "\" appears twice");
    fields_.emplace_back(std::move(key), std::move(value));
}

std::optional<std::string_view> HeaderText::find(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, value] : fields_)
        if (std::ranges::find(keys, key) != keys.end()) return value;
    return std::nullopt;
}

std::string_view HeaderText::require(std::initializer_list<std::string_view> keys) const {
    const auto value = find(keys);
    if (!value) fail("the field \"" + std::string(*keys.begin()) + "\" is missing");
    return *value;
}

std::optional<std::vector<double>> HeaderText::numbers(std::initializer_list<std::string_view> keys,
                                                       std::size_t count) const {
    const auto value = find(keys);
    if (!value) return std::nullopt;
    std::vector<double> found;
    for (const std::string_view word : words(*value))
        if (const auto number = numberOf(word)) found.push_back(*number);
    if (found.size() != count || words(*value).size() != count)
        fail("\"" + std::string(*keys.begin()) + "\" is not " + std::to_string(count) + " numbers");
    return found;
}

std::vector<std::uint64_t> HeaderText::requireCounts(std::initializer_list<std::string_view> keys,
                                                     std::size_t count) const {
    std::vector<std::uint64_t> found;
    const std::vector<std::string_view> all = words(require(keys));
    for (const std::string_view word : all)
        if (const auto number = countOf(word)) found.push_back(*number);
    if (found.size() != count || all.size() != count)
        fail("\"" + std::string(*keys.begin()) + "\" is not " + std::to_string(count) + " whole numbers");
    return found;
}

void HeaderText::fail(const std::string& what, const std::string& hint) const {
    // It may quote what is no text.
    std::string printable = what;
    std::ranges::replace_if(
        printable, [](unsigned char letter) { return std::iscntrl(letter) != 0; }, '?');
    throw Error(format_ + " header: " + printable, file_, hint);
}

}  // namespace isoglass
