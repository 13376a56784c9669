#include "fuzz/source_check.h"

#include <array>

namespace isoglass::fuzz {

void run(std::span<const std::uint8_t> data) {
    const MemoryFile file(data);
    const std::array<std::filesystem::path, 1> files{file.path()};
    checkSource([&] { return openPvm(files, {}); });
}

}  // namespace isoglass::fuzz
