#include "vtkio/appended_data.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

// The XML file formats of VTK: raw data follow the underscore in <AppendedData>. Each array begins with its
// size in bytes, or, compressed, with the number of blocks, their size and that of the last where it is
// smaller.

namespace isoglass {

namespace {

constexpr std::size_t kHeaderLimit = std::size_t{1} << 24;

/// Value of an attribute of a tag; empty where it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
    const std::size_t place = tag.find(" " + std::string(name) + "=\"");
    if (place == std::string_view::npos) return {};
    tag.remove_prefix(place + name.size() + 3);
    return tag.substr(0, tag.find('"'));
}

/// What stands before the appended data.
struct XmlHeader {
    std::string text;
    std::uint64_t data = 0;  ///< offset in the file of the first byte after the underscore
};

/// Nothing where the file has no raw appended data.
std::optional<XmlHeader> readHeader(std::ifstream& stream) {
    XmlHeader header;
    header.text.resize(kHeaderLimit);
    stream.read(header.text.data(), static_cast<std::streamsize>(kHeaderLimit));
    header.text.resize(static_cast<std::size_t>(stream.gcount()));
    stream.clear();
    const std::size_t section = header.text.find("<AppendedData");
    if (section == std::string::npos) return std::nullopt;
    const std::size_t end = header.text.find('>', section);
    const std::size_t underscore = header.text.find('_', end);
    const std::string_view text(header.text);
    if (underscore == std::string::npos ||
        attribute(text.substr(section, end - section), "encoding") != "raw")
        return std::nullopt;
    header.data = underscore + 1;
    header.text.resize(section);
    return header;
}

/// Offset of the array in the appended data; nothing where it is not there, or there several times.
std::optional<std::uint64_t> offsetOf(std::string_view text, const std::string& array) {
    std::optional<std::uint64_t> found;
    for (std::size_t at = 0; (at = text.find("<DataArray", at)) != std::string_view::npos; ++at) {
        const std::string_view tag = text.substr(at, text.find('>', at) - at);
        if (attribute(tag, "Name") != array) continue;
        const std::string_view digits = attribute(tag, "offset");
        std::uint64_t offset = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), offset);
        if (found || error != std::errc{} || end == digits.data()) return std::nullopt;
        found = offset;
    }
    return found;
}

/// Unsigned words of the file's type from `offset` on; zeros beyond its end.
template <std::size_t count>
std::array<std::uint64_t, count> readWords(std::ifstream& stream, std::uint64_t offset,
                                           std::string_view root) {
    const std::size_t width = attribute(root, "header_type") == "UInt64" ? 8 : 4;
    const bool bigEndian = attribute(root, "byte_order") == "BigEndian";
    std::array<unsigned char, count * 8> bytes{};
    stream.seekg(static_cast<std::streamoff>(offset));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count * width));
    stream.clear();
    std::array<std::uint64_t, count> words{};
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < width; ++k)
            words[i] = words[i] << 8 | bytes[i * width + (bigEndian ? k : width - 1 - k)];
    return words;
}

}  // namespace

void requireAppendedSize(const std::filesystem::path& file, const std::string& array, std::uint64_t bytes) {
    std::ifstream stream(file, std::ios::binary);
    const auto header = readHeader(stream);
    const auto offset = header ? offsetOf(header->text, array) : std::nullopt;
    if (!offset) return;
    const std::string_view text(header->text);
    const std::size_t rootAt = std::min(text.find("<VTKFile"), text.size());
    const std::string_view root = text.substr(rootAt, text.find('>', rootAt) - rootAt);
    std::uint64_t announced = 0;
    if (attribute(root, "compressor").empty()) {
        announced = readWords<1>(stream, header->data + *offset, root)[0];
    } else {
        const auto [blocks, size, last] = readWords<3>(stream, header->data + *offset, root);
        announced = last == 0 ? blocks * size : (blocks - 1) * size + last;
    }
    if (announced != bytes)
        throw Error("array \"" + array + "\" has " + std::to_string(announced) + " bytes instead of " +
                        std::to_string(bytes),
                    file.string(), "the file may be cut off or damaged");
}

}  // namespace isoglass
