#include "formats/data_files.h"

#include "formats/file_source.h"

#include <algorithm>
#include <cctype>

namespace isoglass {

std::vector<std::filesystem::path> numberedFiles(std::string_view pattern, std::int64_t first,
                                                 std::int64_t last, std::int64_t step,
                                                 const HeaderText& header) {
    const std::size_t percent = pattern.find('%');
    const std::size_t letter = percent == std::string_view::npos ? percent : pattern.find('d', percent);
    if (letter == std::string_view::npos) header.fail("the pattern of the data files has no %d");
    const std::string_view digits = pattern.substr(percent + 1, letter - percent - 1);
    const auto width = digits.empty() ? std::optional<std::uint64_t>(0) : countOf(digits);
    if (!width || *width > 20) header.fail("the pattern of the data files has no %d or %0Nd");
    if (step == 0 || (last - first) / step < 0 ||
        (last - first) / step >= static_cast<std::int64_t>(kLongestAxis))
        header.fail("the numbers of the data files make no sense");
    std::vector<std::string> names;
    const std::int64_t count = (last - first) / step + 1;
    for (std::int64_t i = 0; i < count; ++i) {
        std::string number = std::to_string(first + i * step);
        if (number.size() < *width)
            number.insert(0, *width - number.size(), digits.starts_with('0') ? '0' : ' ');
        names.push_back(std::string(pattern.substr(0, percent)) + number +
                        std::string(pattern.substr(letter + 1)));
    }
    return listedFiles(names, header);
}

std::vector<std::filesystem::path> listedFiles(const std::vector<std::string>& names,
                                               const HeaderText& header) {
    if (names.empty()) header.fail("it lists no data files");
    if (names.size() > kLongestAxis) header.fail("it lists too many data files");
    std::vector<std::filesystem::path> files;
    for (const std::string& name : names) {
        if (std::ranges::any_of(name, [](unsigned char letter) { return std::iscntrl(letter) != 0; }))
            header.fail("\"" + name + "\" cannot be the name of a file");
        files.push_back(std::filesystem::path(header.file()).parent_path() / name);
    }
    return files;
}

}  // namespace isoglass
