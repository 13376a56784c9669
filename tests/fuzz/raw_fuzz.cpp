#include "formats/raw_json.h"
#include "fuzz/source_check.h"

namespace isoglass::fuzz {

// The data is a description; the only file beside it that it can name is itself.
void run(std::span<const std::uint8_t> data) {
    const MemoryFile file(data);
    checkSource([&] { return openRaw(file.path(), {}); });
}

}  // namespace isoglass::fuzz
