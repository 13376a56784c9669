#include "volume/series_seal.h"

#include "base/error.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace isoglass {

namespace {

constexpr std::array<char, 8> kSealMagic = {'I', 's', 'o', 'G', 'l', 'a', 's', 's'};
constexpr std::array<char, 4> kOpenVdbMagic = {' ', 'B', 'D', 'V'};
constexpr std::uint64_t kBlockBytes = 1 << 20;

/// The last bytes of the file.
struct Seal {
    std::array<char, 8> magic = kSealMagic;
    std::uint64_t sealedBytes = 0;  ///< all before the seal
    std::uint64_t crc32 = 0;        ///< of those
};

/// CRC-32 of the first `bytes` of the file; fails the stream where it is shorter.
std::uint64_t checksumOf(std::ifstream& file, std::uint64_t bytes) {
    std::vector<char> block(std::min(bytes, kBlockBytes));
    uLong crc = crc32(0, nullptr, 0);
    file.seekg(0);
    while (bytes > 0 && file) {
        const std::uint64_t size = std::min(bytes, kBlockBytes);
        file.read(block.data(), static_cast<std::streamsize>(size));
        crc = crc32(crc, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(size));
        bytes -= size;
    }
    return crc;
}

}  // namespace

void sealFile(const std::filesystem::path& path, const std::filesystem::path& finalPath) {
    std::ifstream sealed(path, std::ios::binary);
    Seal seal;
    seal.sealedBytes = std::filesystem::file_size(path);
    seal.crc32 = checksumOf(sealed, seal.sealedBytes);
    std::ofstream file(path, std::ios::binary | std::ios::app);
    file.write(reinterpret_cast<const char*>(&seal), sizeof seal);
    file.close();
    if (!sealed || !file)
        throw Error("cannot write the whole file", finalPath.string(),
                    "free some space, or choose another place");
}

void checkSeal(const std::filesystem::path& path) {
    const std::string where = path.string();
    std::ifstream file(path, std::ios::binary);
    std::array<char, kOpenVdbMagic.size()> start{};
    if (!file.read(start.data(), start.size()) || start != kOpenVdbMagic)
        throw Error("not a readable OpenVDB file", where, "make one with 'isoglass import'");
    const std::uint64_t size = std::filesystem::file_size(path);
    Seal seal;
    file.seekg(static_cast<std::streamoff>(size - std::min<std::uint64_t>(size, sizeof seal)));
    file.read(reinterpret_cast<char*>(&seal), sizeof seal);
    if (!file || seal.magic != kSealMagic)
        throw Error("this OpenVDB file holds no IsoGlass series, or was cut short", where,
                    "make one with 'isoglass import'");
    if (seal.sealedBytes != size - sizeof seal || checksumOf(file, seal.sealedBytes) != seal.crc32 || !file)
        throw Error("the file is damaged: its checksum is not the one that it ends with", where,
                    "import the series again");
}

}  // namespace isoglass
