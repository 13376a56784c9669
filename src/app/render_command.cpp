#include "app/commands.h"
#include "app/progress.h"
#include "app/render_identity.h"
#include "app/render_output.h"
#include "app/stop_signal.h"
#include "app/text.h"
#include "base/error.h"
#include "pipeline/scene_extractor.h"
#include "scene/scene_file.h"

#include <algorithm>
#include <set>

namespace isoglass {

namespace {

constexpr int kLargestSide = 16384;

FrameRange chooseFrames(const RenderCommand& command, const RenderOutput& output, const Scene& scene) {
    const std::int64_t count = scene.time.frameCount();
    const bool still = output.kind == RenderOutput::Kind::still;
    FrameRange range = command.frames.value_or(FrameRange{0, still ? 0 : count - 1});
    if (range.first < 0 || range.last < range.first || range.last >= count) {
        throw Error("frames " + std::to_string(range.first) + " to " + std::to_string(range.last) +
                        " are not in the scene, which has frames 0 to " + std::to_string(count - 1),
                    "--frames");
    }
    if (still && range.first != range.last) {
        throw Error("one picture holds one frame", command.out,
                    "put {frame} in the name, or choose one frame");
    }
    return range;
}

void applyOverrides(const RenderCommand& command, Scene& scene) {
    if (command.size) {
        const glm::ivec2 size = *command.size;
        if (std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > kLargestSide) {
            throw Error("an image has 1 to " + std::to_string(kLargestSide) + " pixels a side", "--size");
        }
        scene.image.size = size;
    }
    if (command.showLevels) colorByLevel(scene);
    if (command.method) scene.transparency.method = *command.method;
    if (scene.transparency.reproducible && scene.transparency.method == TransparencyMethod::twoPass) {
        throw Error("the scene is to be reproducible, and 2-pass depends on the order of the surfaces",
                    "--method", "choose another method");
    }
}

/// Says once for each surface or volume what its pictures lack.
class Notes {
  public:
    explicit Notes(const Scene& scene) : scene_(scene) {}

    void check(const RenderedFrame& frame) {
        const std::string when = " (from frame " + std::to_string(frame.frame) + ")";
        for (std::size_t v = 0; v < frame.meshes.times.size(); ++v) {
            if (frame.meshes.times[v].where == TimeSample::Where::inside) continue;
            sayOnce("/volumes/" + std::to_string(v) + ": '" + scene_.volumes[v].name +
                        "' has no key frame at this time, the nearest one is shown",
                    when);
        }
        for (const ExtractedSurface& surface : frame.meshes.surfaces) {
            const std::string volume = "/volumes/" + std::to_string(surface.volume);
            const auto& work = frame.meshes.work[surface.volume];
            const bool mayBeElsewhere = surface.stats.leftOut;
            if (surface.mesh->empty() && !mayBeElsewhere &&
                isNeeded(work, WorkKind::extraction, surface.surface)) {
                sayOnce(volume + "/surfaces/" + std::to_string(surface.surface) + ": the surface is empty",
                        rangeText(surface.stats.range) + when);
            }
            if (surface.stats.lostCells > 0)
                sayOnce(volume + ": surfaces end where samples are missing", when);
        }
    }

  private:
    static std::string rangeText(ValueRange range) {
        if (range.min > range.max) return ", every sample is missing";
        return ", the field is from " + formatNumber(range.min) + " to " + formatNumber(range.max);
    }

    void sayOnce(const std::string& fact, const std::string& detail) {
        if (said_.insert(fact).second) printNote(fact + detail);
    }

    const Scene& scene_;
    std::set<std::string> said_;
};

/// The frames that the sink lacks, as runs without a gap.
std::vector<FrameRange> missingFrames(FrameRange range, const FrameSink& sink) {
    std::vector<FrameRange> runs;
    for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
        if (sink.has(frame)) continue;
        if (!runs.empty() && runs.back().last == frame - 1) {
            runs.back().last = frame;
        } else {
            runs.push_back({frame, frame});
        }
    }
    return runs;
}

void renderMissing(const Scene& scene, SceneExtractor& extractor, FrameRange range, FrameSink& sink) {
    const std::vector<FrameRange> runs = missingFrames(range, sink);
    std::int64_t count = 0;
    for (const FrameRange run : runs) count += run.last - run.first + 1;
    std::int64_t done = 0;
    Notes notes(scene);
    const StopScope scope;
    try {
        Progress progress("rendering", "frames", count);
        for (const FrameRange run : runs) {
            renderFrames(scene, extractor, run, [&](const RenderedFrame& frame) {
                if (stopRequested()) return false;
                notes.check(frame);
                sink.add(frame.frame, frame.image);
                progress.update(++done);
                return true;
            });
            if (stopRequested()) break;
        }
    } catch (const Error&) {
        if (const std::string kept = sink.kept(); !kept.empty()) printNote(kept);
        throw;
    }
    if (done < count) throw Stopped(sink.kept());
}

}  // namespace

void runRender(const RenderCommand& command, const CommonOptions& common) {
    const RenderOutput output = RenderOutput::fromName(command.out);
    Scene scene = loadScene(command.scene);
    applyOverrides(command, scene);
    if (output.kind == RenderOutput::Kind::video && scene.image.backgroundOpacity < 1) {
        throw Error("a video has no transparent background", command.scene.string() + ", /image/background",
                    "render to frame-{frame}.png, or choose an opaque color");
    }
    for (const std::string& note : scene.notes) printNote(note);
    const FrameRange range = chooseFrames(command, output, scene);
    SceneExtractor extractor(scene,
                             {.memoryBytes = common.memoryBytes, .threads = common.threads, .seenMargin = 0});
    for (const std::string& note : extractor.notes()) printNote(note);
    const std::unique_ptr<FrameSink> sink =
        makeSink(output, scene, range, [&] { return renderIdentity(scene, extractor); });
    renderMissing(scene, extractor, range, *sink);
    sink->finish();
}

}  // namespace isoglass
