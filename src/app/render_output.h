#pragma once

#include "app/render_journal.h"
#include "pipeline/batch.h"
#include "render/image.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace isoglass {

/// Where `render` puts frames, by the name that the user gave.
struct RenderOutput {
    enum class Kind { still, sequence, video };

    Kind kind;
    std::string name;

    /// Tells the kind by the name and asks whether files can be made there, before any work is done. Throws
    /// Error with the place.
    static RenderOutput fromName(const std::string& name);

    /// The picture of a frame: `{frame}` is five digits or more.
    std::filesystem::path fileOf(std::int64_t frame) const;
};

/// Takes rendered frames. Use from one thread.
class FrameSink {
  public:
    virtual ~FrameSink() = default;
    /// An earlier run left the frame, whole and the same: it need not be rendered.
    virtual bool has(std::int64_t) const { return false; }
    virtual void add(std::int64_t frame, const Image& image) = 0;
    /// All frames are there.
    virtual void finish() {}
    /// What stays where the run ends now, and what the same command would do, for people; empty for nothing.
    virtual std::string kept() const { return {}; }
};

/// \name What sinks say alike
///@{
std::string rangeText(FrameRange range);  ///< "0-99"
std::string keptText(std::int64_t frames, FrameRange range);
void noteKept(std::int64_t frames, FrameRange range);
void noteForeign(const RenderJournal& journal);
///@}

/// `identity` is asked for only where frames of an earlier run may be kept. Prints notes on those.
std::unique_ptr<FrameSink> makeSink(const RenderOutput& output, const Scene& scene, FrameRange range,
                                    const std::function<std::uint64_t()>& identity);

}  // namespace isoglass
