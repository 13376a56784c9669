#include "formats/medical_images.h"
#include "fuzz/source_check.h"

namespace isoglass::fuzz {

void run(std::span<const std::uint8_t> data) {
    const MemoryFile file(data);
    checkSource([&] { return openMetaImage(file.path(), {}); });
}

}  // namespace isoglass::fuzz
