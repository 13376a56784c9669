#include "volume/checksum.h"

#include "basis/parallel.h"

#include <zlib.h>

#include <array>
#include <cstring>
#include <vector>

namespace isoglass {

namespace {

constexpr std::size_t kBricksPerBlock = 64;

uLong addBytes(uLong crc, const void* data, std::size_t size) {
    return crc32(crc, static_cast<const Bytef*>(data), static_cast<uInt>(size));
}

uLong addBrick(uLong crc, const BrickView& brick) {
    const std::uint8_t kind = brick.missing ? 0 : !brick.samples ? 1 : brick.valid ? 2 : 3;
    crc = addBytes(crc, &kind, 1);
    switch (kind) {
        case 0:
            return crc;
        case 1:
            return addBytes(crc, &brick.constant, sizeof brick.constant);
        case 2: {
            std::array<float, kBrickSamples> samples;
            for (int i = 0; i < kBrickSamples; ++i) {
                const bool valid = brick.valid[i / 64] >> (i % 64) & 1;
                samples[i] = valid ? brick.samples[i] : 0.0f;
            }
            crc = addBytes(crc, brick.valid, kBrickSize * sizeof *brick.valid);
            return addBytes(crc, samples.data(), sizeof samples);
        }
        default:
            return addBytes(crc, brick.samples, kBrickSamples * sizeof *brick.samples);
    }
}

}  // namespace

std::uint32_t checksum(const KeyFrame& frame) {
    const std::size_t blocks = (frame.brickCount() + kBricksPerBlock - 1) / kBricksPerBlock;
    std::vector<std::uint32_t> blockSums(blocks);
    parallelFor(frame.brickCount(), kBricksPerBlock, 0, [&](std::size_t begin, std::size_t end) {
        uLong crc = crc32(0, nullptr, 0);
        for (std::size_t i = begin; i < end; ++i) crc = addBrick(crc, frame.brick(i));
        blockSums[begin / kBricksPerBlock] = static_cast<std::uint32_t>(crc);
    });
    return static_cast<std::uint32_t>(
        addBytes(crc32(0, nullptr, 0), blockSums.data(), blocks * sizeof(std::uint32_t)));
}

}  // namespace isoglass
