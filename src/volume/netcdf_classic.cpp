#include "volume/netcdf_classic.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

namespace isoglass {

namespace {

/// The header ends early or contradicts itself.
struct HeaderIsWrong {};

/// The library copies longer ones over the end of the buffers that it asks its callers for.
constexpr std::uint64_t kLongestName = 256;

enum class Tag : std::uint64_t { none = 0, dimension = 10, variable = 11, attribute = 12 };

/// External size of nc_type 1 .. 11: byte, char, short, int, float, double, then those of CDF-5.
constexpr std::array<std::uint64_t, 12> kTypeBytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};

/// Where the values of a variable lie: `slabBytes` of them from `begin`, for each record if it has any.
struct Extent {
    std::uint64_t begin;
    std::uint64_t slabBytes;
    bool record;
};

class HeaderReader {
  public:
    explicit HeaderReader(const std::filesystem::path& path)
        : fileBytes_(std::filesystem::file_size(path)), file_(path, std::ios::binary) {}

    std::optional<std::uint64_t> promisedSize() {
        std::array<char, 4> magic{};
        file_.read(magic.data(), magic.size());
        version_ = magic[3];
        if (!file_ || magic[0] != 'C' || magic[1] != 'D' || magic[2] != 'F') return std::nullopt;
        if (version_ != 1 && version_ != 2 && version_ != 5) return std::nullopt;

        const std::uint64_t records = size();
        const std::uint64_t streaming = version_ == 5 ? ~std::uint64_t{0} : 0xffffffffu;
        const std::vector<std::uint64_t> lengths = dimensionList();
        skipAttributes();
        return endOf(variableList(lengths), records == streaming ? 0 : records);
    }

  private:
    std::uint64_t bigEndian(int bytes) {
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) {
            const int byte = file_.get();
            if (byte < 0) throw HeaderIsWrong{};
            value = value << 8 | static_cast<std::uint64_t>(byte);
        }
        return value;
    }

    std::uint64_t size() { return bigEndian(version_ == 5 ? 8 : 4); }

    /// A number of things that take at least a byte each: more than the file has are not believed.
    std::uint64_t count() {
        const std::uint64_t value = size();
        if (value > fileBytes_) throw HeaderIsWrong{};
        return value;
    }

    std::uint64_t listLength(Tag expected) {
        const auto tag = static_cast<Tag>(bigEndian(4));
        const std::uint64_t length = count();
        if (tag != expected && (tag != Tag::none || length > 0)) throw HeaderIsWrong{};
        return length;
    }

    void skip(std::uint64_t bytes) {
        const std::uint64_t padded = (bytes + 3) / 4 * 4;
        if (padded > fileBytes_) throw HeaderIsWrong{};
        file_.seekg(static_cast<std::streamoff>(padded), std::ios::cur);
    }

    void skipName() {
        const std::uint64_t length = size();
        if (length > kLongestName) throw HeaderIsWrong{};
        skip(length);
    }

    std::uint64_t typeBytes() {
        const std::uint64_t type = bigEndian(4);
        if (type == 0 || type >= kTypeBytes.size()) throw HeaderIsWrong{};
        return kTypeBytes[type];
    }

    std::vector<std::uint64_t> dimensionList() {
        std::vector<std::uint64_t> lengths;
        for (std::uint64_t left = listLength(Tag::dimension); left > 0; --left) {
            skipName();
            lengths.push_back(size());
        }
        return lengths;
    }

    void skipAttributes() {
        for (std::uint64_t left = listLength(Tag::attribute); left > 0; --left) {
            skipName();
            const std::uint64_t bytes = typeBytes();
            skip(count() * bytes);
        }
    }

    std::vector<Extent> variableList(const std::vector<std::uint64_t>& lengths) {
        std::vector<Extent> extents;
        for (std::uint64_t left = listLength(Tag::variable); left > 0; --left) {
            skipName();
            Extent extent{0, 1, false};
            for (std::uint64_t axis = 0, axes = count(); axis < axes; ++axis) {
                const std::uint64_t dimension = size();
                if (dimension >= lengths.size()) throw HeaderIsWrong{};
                if (lengths[dimension] == 0)
                    extent.record = true;
                else if (__builtin_mul_overflow(extent.slabBytes, lengths[dimension], &extent.slabBytes))
                    throw HeaderIsWrong{};
            }
            skipAttributes();
            if (__builtin_mul_overflow(extent.slabBytes, typeBytes(), &extent.slabBytes)) throw HeaderIsWrong{};
            size();
            extent.begin = bigEndian(version_ == 1 ? 4 : 8);
            extents.push_back(extent);
        }
        return extents;
    }

    static std::uint64_t endOf(const std::vector<Extent>& extents, std::uint64_t records) {
        const auto recordVariables = std::ranges::count_if(extents, &Extent::record);
        std::uint64_t recordBytes = 0;
        for (const Extent& extent : extents)
            // A lone record variable is packed without padding between its records.
            if (extent.record)
                recordBytes += recordVariables == 1 ? extent.slabBytes : (extent.slabBytes + 3) / 4 * 4;
        std::uint64_t end = 0;
        for (const Extent& extent : extents) {
            if (extent.record && records == 0) continue;
            std::uint64_t skipped = 0;
            if (extent.record && __builtin_mul_overflow(records - 1, recordBytes, &skipped))
                throw HeaderIsWrong{};
            std::uint64_t variableEnd = 0;
            if (__builtin_add_overflow(extent.begin, extent.slabBytes, &variableEnd) ||
                __builtin_add_overflow(variableEnd, skipped, &variableEnd))
                throw HeaderIsWrong{};
            end = std::max(end, variableEnd);
        }
        return end;
    }

    std::uint64_t fileBytes_;
    std::ifstream file_;
    int version_ = 0;
};

}  // namespace

std::optional<std::uint64_t> classicNetcdfSize(const std::filesystem::path& path) try {
    return HeaderReader(path).promisedSize();
} catch (const HeaderIsWrong&) {
    throw Error("its header ends early or contradicts itself", path.string(), "the file may be damaged");
}

}  // namespace isoglass
