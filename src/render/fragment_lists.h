#pragma once

#include "gl/objects.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace isoglass {

/// The nodes of all per-pixel fragment lists: storage block `FragmentLists` of
/// shaders/lib/fragment_lists.glsl. Starts small and grows to what a frame needs, up to a limit.
class FragmentLists {
  public:
    static constexpr unsigned kBinding = 0;
    static constexpr std::size_t kNodeBytes = 24;
    static constexpr std::size_t kHeaderBytes = 8;
    static constexpr std::size_t kDefaultLimitBytes = std::size_t{512} << 20;

    /// Most bytes of GPU memory; the driver's limit of a block holds as well. At least one node fits.
    void setLimit(std::size_t bytes);

    /// Empties the lists and binds them.
    void begin();
    /// Nodes that shaders asked for since `begin`, also those that found no room. Waits for the GPU.
    std::uint32_t asked() const;
    std::uint32_t capacity() const { return capacity_; }
    /// Makes room for `nodes`, as far as the limit allows; false where it stays as it is.
    bool grow(std::uint32_t nodes);

  private:
    std::uint32_t largestCapacity() const;
    void allocate(std::uint32_t nodes);

    std::size_t limitBytes_ = kDefaultLimitBytes;
    std::uint32_t capacity_ = 0;
    std::optional<gl::Buffer> buffer_;
};

}  // namespace isoglass
