#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace isoglass {

/// The bytes of a file's samples, by their place. Use from one thread at a time.
class Payload {
  public:
    virtual ~Payload() = default;
    /// Fills `bytes` from `offset` on; all of it must lie in the payload. Throws Error.
    virtual void read(std::uint64_t offset, std::span<std::byte> bytes) = 0;
};

/// Where the samples lie in a file.
struct PayloadPlace {
    std::uint64_t start = 0;  ///< bytes of the file before them, not compressed
    bool compressed = false;  ///< gzip or zlib, from `start` on
    std::uint64_t skip = 0;   ///< bytes before the samples once decompressed; 0 where not compressed
    std::uint64_t size = 0;   ///< bytes of the samples, decompressed
    /// The samples end the file, and `start` is where they then begin.
    bool atEnd = false;
};

/// Opens the payload of a file and checks that its size is exactly `place.size`: at once where it is not
/// compressed, else that it can be (deflate shrinks by less than 1032) and, when the last byte is read, that
/// the stream ends there with the right checksum. Reading backwards starts a compressed one anew.
/// Throws Error.
std::unique_ptr<Payload> openPayload(const std::filesystem::path& file, const PayloadPlace& place);

/// True where the file begins as gzip does.
bool isGzip(const std::filesystem::path& file);

/// The first bytes of a file, `limit` at most, decompressed where it is gzip. Throws Error where the file
/// cannot be read or decompressed.
std::string readStart(const std::filesystem::path& file, std::size_t limit);

}  // namespace isoglass
