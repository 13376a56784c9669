#include "render/png_file.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

namespace isoglass {
namespace {

/// libpng's description of an image; frees what it holds.
struct Png : png_image {
    Png() : png_image{} {
        version = PNG_IMAGE_VERSION;
        format = PNG_FORMAT_RGBA;
    }
    ~Png() { png_image_free(this); }
    Png(const Png&) = delete;
    Png& operator=(const Png&) = delete;
};

std::vector<std::byte> encode(const std::filesystem::path& path, const Image& image) {
    Png png;
    png.width = static_cast<png_uint_32>(image.size.x);
    png.height = static_cast<png_uint_32>(image.size.y);
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::vector<std::byte> encoded(bytes);
    if (!png_image_write_to_memory(&png, encoded.data(), &bytes, 0, image.pixels.data(), 0, nullptr)) {
        throw Error(std::string("cannot encode the image: ") + png.message, path.string());
    }
    encoded.resize(bytes);
    return encoded;
}

void writeBytes(const std::filesystem::path& path, const std::filesystem::path& namedPath,
                const std::vector<std::byte>& bytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    bool written = file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    int reason = errno;
    if (file != nullptr && std::fclose(file) != 0 && written) {
        written = false;
        reason = errno;
    }
    if (!written) {
        throw Error(std::string("cannot write the image: ") + std::strerror(reason), namedPath.string(),
                    "free some space, or choose another place");
    }
}

}  // namespace

void writePng(const std::filesystem::path& path, const Image& image) {
    const std::vector<std::byte> bytes = encode(path, image);
    if (isSpecialFile(path)) return writeBytes(path, path, bytes);
    AtomicFile file(path);
    writeBytes(file.temporaryPath(), path, bytes);
    file.commit();
}

Image readPng(const std::filesystem::path& path) {
    Png png;
    const auto fail = [&] { throw Error(std::string("cannot read the PNG: ") + png.message, path.string()); };
    if (!png_image_begin_read_from_file(&png, path.c_str())) fail();
    png.format = PNG_FORMAT_RGBA;
    Image image{{static_cast<int>(png.width), static_cast<int>(png.height)}, {}};
    image.pixels.resize(static_cast<std::size_t>(png.width) * png.height);
    if (!png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr)) fail();
    return image;
}

}  // namespace isoglass
