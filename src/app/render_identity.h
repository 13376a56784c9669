#pragma once

#include "pipeline/scene_extractor.h"
#include "scene/scene.h"

#include <cstdint>
#include <string_view>

namespace isoglass {

/// A 64-bit FNV-1a digest of texts: tells accidents apart, not attacks.
class Digest {
  public:
    /// Adds a text and its end, so that no two sequences of texts read alike.
    void add(std::string_view text);
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 14695981039346656037u;
};

/// The same number only where frames would be the same pictures: the scene with what the command line
/// changed, the samples of its series (by their descriptions, which hold a checksum of every key frame), the
/// bytes of other files that it names, this program, and the OpenGL driver. Makes a context for a moment.
/// Threads, memory and the range of frames do not count: pictures do not depend on them.
std::uint64_t renderIdentity(const Scene& scene, const SceneExtractor& extractor);

}  // namespace isoglass
