#include "render/fragment_lists.h"

#include <algorithm>
#include <array>
#include <span>

namespace isoglass {
namespace {

constexpr std::uint32_t kFirstCapacity = 1u << 18;

}  // namespace

void FragmentLists::setLimit(std::size_t bytes) {
    limitBytes_ = bytes;
    buffer_.reset();
    capacity_ = 0;
}

std::uint32_t FragmentLists::largestCapacity() const {
    GLint64 largestBlock = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largestBlock);
    const std::size_t bytes = std::min(limitBytes_, static_cast<std::size_t>(largestBlock));
    const std::size_t nodes = (std::max(bytes, kHeaderBytes) - kHeaderBytes) / kNodeBytes;
    return static_cast<std::uint32_t>(std::clamp<std::size_t>(nodes, 1, 0xfffffffe));
}

void FragmentLists::allocate(std::uint32_t nodes) {
    capacity_ = nodes;
    buffer_ = gl::Buffer::updatable(kHeaderBytes + nodes * kNodeBytes);
}

void FragmentLists::begin() {
    if (!buffer_) allocate(std::min(kFirstCapacity, largestCapacity()));
    const std::array<std::uint32_t, 2> header{0, capacity_};
    buffer_->write(0, std::as_bytes(std::span(header)));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBinding, buffer_->name());
}

std::uint32_t FragmentLists::asked() const {
    std::uint32_t count = 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    buffer_->read(0, std::as_writable_bytes(std::span(&count, 1)));
    return count;
}

bool FragmentLists::grow(std::uint32_t nodes) {
    // A quarter more, so that a turning camera does not ask again and again.
    const std::uint64_t wanted = nodes + std::uint64_t{nodes} / 4;
    const auto capacity = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, largestCapacity()));
    if (capacity < nodes || capacity <= capacity_) return false;
    allocate(capacity);
    return true;
}

}  // namespace isoglass
