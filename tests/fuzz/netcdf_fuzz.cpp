#include "fuzz/source_check.h"

namespace isoglass::fuzz {

void run(std::span<const std::uint8_t> data) {
    const MemoryFile file(data);
    checkSource([&] { return openNetcdf(file.path(), {}); });
}

}  // namespace isoglass::fuzz
