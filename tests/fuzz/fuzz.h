#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

namespace isoglass::fuzz {

/// One execution: `data` is whatever the fuzzer made up. Each target defines it.
void run(std::span<const std::uint8_t> data);

/// Ends the program with a message; what a target demands holds in every build.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: broken promise: %s\n", what);
    std::abort();
}

inline std::string_view asText(std::span<const std::uint8_t> data) {
    return {reinterpret_cast<const char*>(data.data()), data.size()};
}

/// A file without a disk, for readers that want a path.
class MemoryFile {
  public:
    explicit MemoryFile(std::span<const std::uint8_t> data) : descriptor_(memfd_create("fuzz", 0)) {
        require(descriptor_ >= 0, "a file in memory can be made");
        require(write(descriptor_, data.data(), data.size()) == static_cast<ssize_t>(data.size()),
                "a file in memory can be written");
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

/// Takes numbers off the front of the data; zeros when there is no more.
class Bytes {
  public:
    explicit Bytes(std::span<const std::uint8_t> data) : data_(data) {}

    std::uint8_t next() {
        if (data_.empty()) return 0;
        const std::uint8_t byte = data_.front();
        data_ = data_.subspan(1);
        return byte;
    }
    std::uint32_t word() {
        std::uint32_t value = 0;
        for (int i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(next()) << 8 * i;
        return value;
    }

  private:
    std::span<const std::uint8_t> data_;
};

}  // namespace isoglass::fuzz
