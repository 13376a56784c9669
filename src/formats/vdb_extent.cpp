#include "formats/vdb_extent.h"

#include "base/error.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

namespace isoglass {

namespace {

constexpr std::uint64_t kMagic = 0x56444220;
constexpr std::uint32_t kLeastVersion = 222;  ///< from here on the header has had one form
constexpr std::uint64_t kIdentifierBytes = 36;

/// Walks through a file of little-endian numbers and never beyond its end.
class VdbCursor {
  public:
    explicit VdbCursor(const std::filesystem::path& path)
        : path_(path), stream_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

    std::uint64_t size() const { return size_; }
    std::uint64_t place() const { return place_; }

    template <typename Number>
    Number read() {
        std::array<unsigned char, sizeof(Number)> bytes{};
        require(bytes.size());
        stream_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
        if (!stream_) throw Error("cannot be read", path_.string());
        place_ += bytes.size();
        Number number = 0;
        for (std::size_t i = bytes.size(); i-- > 0;) number = static_cast<Number>(number << 8 | bytes[i]);
        return number;
    }

    void skip(std::uint64_t bytes) {
        require(bytes);
        moveTo(place_ + bytes);
    }
    void skipText() { skip(read<std::uint32_t>()); }
    void moveTo(std::uint64_t place) {
        place_ = place;
        stream_.seekg(static_cast<std::streamoff>(place));
    }

    [[noreturn]] void failAt(std::uint64_t end) const {
        throw Error("the file was cut off: it has " + std::to_string(size_) + " bytes and needs " +
                        std::to_string(end) + " or more",
                    path_.string(), "copy it again from where it came");
    }

  private:
    void require(std::uint64_t bytes) const {
        if (bytes > size_ - place_) failAt(place_ + bytes);
    }

    const std::filesystem::path& path_;
    std::ifstream stream_;
    std::uint64_t size_;
    std::uint64_t place_ = 0;
};

/// Whether the header is one whose grids can be found; the cursor then stands at the number of grids.
bool readHeader(VdbCursor& file) {
    if (file.size() < sizeof kMagic || file.read<std::uint64_t>() != kMagic) return false;
    if (file.read<std::uint32_t>() < kLeastVersion) return false;
    file.skip(2 * sizeof(std::uint32_t));  // version of the library
    const bool hasOffsets = file.read<std::uint8_t>() != 0;
    file.skip(kIdentifierBytes);
    const auto entries = file.read<std::uint32_t>();
    for (std::uint32_t i = 0; i < entries; ++i) {
        file.skipText();  // name
        file.skipText();  // type
        file.skipText();  // value, which has its size in front, too
    }
    return hasOffsets;
}

}  // namespace

void requireWholeVdb(const std::filesystem::path& path) {
    VdbCursor file(path);
    if (!readHeader(file)) return;
    const auto grids = file.read<std::uint32_t>();
    for (std::uint32_t i = 0; i < grids; ++i) {
        file.skipText();  // name
        file.skipText();  // type
        file.skipText();  // the grid that it is an instance of
        const auto begin = file.read<std::uint64_t>();
        const auto blocks = file.read<std::uint64_t>();
        const auto end = file.read<std::uint64_t>();
        if (begin < file.place() || begin > blocks || blocks > end)
            throw Error("grid " + std::to_string(i + 1) + " does not lie where it should", path.string(),
                        "the file may be damaged");
        if (end > file.size()) file.failAt(end);
        file.moveTo(end);
    }
}

}  // namespace isoglass
