#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace isoglass::test {

/// Inverts some of the last bytes of a file, where a series keeps samples of its last key frame.
inline void damageEnd(const std::filesystem::path& path) {
    constexpr int kBytes = 64;
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    char bytes[kBytes];
    file.seekg(-2 * kBytes, std::ios::end);
    file.read(bytes, kBytes);
    for (char& byte : bytes) byte = static_cast<char>(~byte);
    file.seekp(-2 * kBytes, std::ios::end);
    file.write(bytes, kBytes);
    ASSERT_TRUE(file) << path;
}

}  // namespace isoglass::test
