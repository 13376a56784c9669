#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isoglass {

// For headers that are lines of text with a key and its value.

/// Without blanks and line ends at both ends.
std::string_view trimmed(std::string_view text);
std::string lowerCase(std::string_view text);
/// The words between blanks.
std::vector<std::string_view> words(std::string_view text);

/// The whole text as a number, independent of the locale; nothing where it is none.
std::optional<double> numberOf(std::string_view text);
std::optional<std::uint64_t> countOf(std::string_view text);

/// Key and value pairs of a header in the order of the file, with precise errors.
class HeaderText {
  public:
    /// `format` and `file` are for messages.
    HeaderText(std::string format, std::string file) : format_(std::move(format)), file_(std::move(file)) {}

    /// Throws Error where the key is there already.
    void add(std::string key, std::string value);

    /// The value of the first of `keys` that is there.
    std::optional<std::string_view> find(std::initializer_list<std::string_view> keys) const;
    std::string_view require(std::initializer_list<std::string_view> keys) const;

    /// The value as exactly `count` numbers.
    std::optional<std::vector<double>> numbers(std::initializer_list<std::string_view> keys,
                                               std::size_t count) const;
    std::vector<std::uint64_t> requireCounts(std::initializer_list<std::string_view> keys,
                                             std::size_t count) const;

    const std::string& file() const { return file_; }
    [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const;

  private:
    std::string format_;
    std::string file_;
    std::vector<std::pair<std::string, std::string>> fields_;
};

}  // namespace isoglass
