#pragma once

#include "render/image.h"

#include <filesystem>

namespace isoglass {

/// Writes an 8-bit RGBA PNG marked as sRGB. A regular file appears under its name only when it is whole;
/// a device or pipe is written as it is. Throws Error where the folder is missing or the disk is full.
void writePng(const std::filesystem::path& path, const Image& image);

/// Reads any PNG as 8-bit RGBA. Throws Error where the file is missing or damaged.
Image readPng(const std::filesystem::path& path);

}  // namespace isoglass
