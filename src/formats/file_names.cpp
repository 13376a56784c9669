#include "formats/file_names.h"

#include "base/error.h"
#include "formats/header_text.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>

namespace isoglass {

namespace {

bool isDigit(char letter) {
    return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

std::size_t digitsFrom(std::string_view text, std::size_t first) {
    std::size_t end = first;
    while (end < text.size() && isDigit(text[end])) ++end;
    return end - first;
}

/// Without endings that hold a letter: "a_2.5.nii.gz" is "a_2.5".
std::string_view withoutEndings(std::string_view name) {
    for (;;) {
        const std::size_t point = name.rfind('.');
        if (point == std::string_view::npos || point == 0) return name;
        if (std::ranges::all_of(name.substr(point + 1), isDigit)) return name;
        name = name.substr(0, point);
    }
}

std::vector<double> numbersIn(std::string_view name) {
    std::vector<double> numbers;
    name = withoutEndings(name);
    for (std::size_t i = 0; i < name.size();) {
        std::size_t length = digitsFrom(name, i);
        if (length == 0) {
            ++i;
            continue;
        }
        const std::size_t point = i + length;
        if (point < name.size() && name[point] == '.')
            if (const std::size_t decimals = digitsFrom(name, point + 1)) length += 1 + decimals;
        numbers.push_back(numberOf(name.substr(i, length)).value());
        i += length;
    }
    return numbers;
}

}  // namespace

bool naturalLess(const std::filesystem::path& a, const std::filesystem::path& b) {
    const std::string left = a.string(), right = b.string();
    std::size_t i = 0, j = 0;
    while (i < left.size() && j < right.size()) {
        const std::size_t leftDigits = digitsFrom(left, i), rightDigits = digitsFrom(right, j);
        if (leftDigits == 0 || rightDigits == 0) {
            if (left[i] != right[j]) return left[i] < right[j];
            ++i, ++j;
            continue;
        }
        const auto value = [](const std::string& text, std::size_t first, std::size_t count) {
            const std::size_t zeros = std::min(text.find_first_not_of('0', first), first + count);
            return std::string_view(text).substr(zeros, first + count - zeros);
        };
        const auto leftValue = value(left, i, leftDigits), rightValue = value(right, j, rightDigits);
        if (leftValue.size() != rightValue.size()) return leftValue.size() < rightValue.size();
        if (leftValue != rightValue) return leftValue < rightValue;
        i += leftDigits, j += rightDigits;
    }
    if (left.size() - i != right.size() - j) return left.size() - i < right.size() - j;
    return left < right;
}

std::vector<double> numbersInNames(std::span<const std::filesystem::path> files) {
    std::vector<std::vector<double>> all;
    for (const auto& file : files) {
        all.push_back(numbersIn(file.filename().string()));
        if (all.back().empty())
            throw Error("there is no number in the name", file.string(), "--times gives the times instead");
        if (all.back().size() != all.front().size())
            throw Error("the name has " + std::to_string(all.back().size()) +
                            " numbers, that of the first file " + std::to_string(all.front().size()),
                        file.string(), "--times gives the times instead");
    }
    if (all.size() == 1) return {all.front().back()};
    std::set<std::vector<double>> varying;
    for (std::size_t column = 0; column < all.front().size(); ++column) {
        std::vector<double> numbers;
        for (const auto& row : all) numbers.push_back(row[column]);
        if (std::ranges::adjacent_find(numbers, std::not_equal_to{}) != numbers.end())
            varying.insert(numbers);
    }
    if (varying.size() != 1)
        throw Error(varying.empty() ? "no number differs between the names"
                                    : "several numbers differ between the names",
                    files.front().string() + " and others", "--times gives the times instead");
    return *varying.begin();
}

}  // namespace isoglass
