#pragma once

#include "volume/frame_source.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <span>

namespace isoglass {

/// Runs a source in a process of its own, for libraries that trust what they read: where a damaged file
/// makes one crash, ask for absurd memory or never end, that process dies and an Error says so.
///
/// `open` runs in the child, a fork of this process without its other threads: it must not wait for any of
/// them. The child reads the first key frame at once, so that a description that came is one whose samples
/// could be read. It gets as much address space as the machine has memory on top of what it began with, and
/// processor time by the size of `files`: 10 seconds and one for each MB. What the library prints is
/// dropped.
///
/// Throws Error: what `open` or `read` threw, or that the reader failed.
std::unique_ptr<FrameSource> openIsolated(std::span<const std::filesystem::path> files,
                                          const std::function<std::unique_ptr<FrameSource>()>& open);

}  // namespace isoglass
