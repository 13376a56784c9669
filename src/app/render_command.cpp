#include "app/commands.h"
#include "app/progress.h"
#include "app/text.h"
#include "app/video.h"
#include "base/error.h"
#include "pipeline/scene_extractor.h"
#include "render/png_file.h"
#include "scene/scene_file.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>

namespace isoglass {

namespace {

constexpr std::string_view kFrameMark = "{frame}";
constexpr int kLargestSide = 16384;

/// Where frames go.
class Sink {
  public:
    virtual ~Sink() = default;
    virtual void add(std::int64_t frame, const Image& image) = 0;
    virtual void finish() {}
};

class StillSink final : public Sink {
  public:
    explicit StillSink(std::filesystem::path file) : file_(std::move(file)) {}
    void add(std::int64_t, const Image& image) override { writePng(file_, image); }

  private:
    std::filesystem::path file_;
};

class SequenceSink final : public Sink {
  public:
    explicit SequenceSink(std::string pattern) : pattern_(std::move(pattern)) {}
    void add(std::int64_t frame, const Image& image) override {
        std::ostringstream digits;
        digits << std::setw(5) << std::setfill('0') << frame;
        std::string name = pattern_;
        writePng(name.replace(name.find(kFrameMark), kFrameMark.size(), digits.str()), image);
    }

  private:
    std::string pattern_;
};

class VideoSink final : public Sink {
  public:
    VideoSink(const std::filesystem::path& file, glm::ivec2 size, double fps) : video_(file, size, fps) {}
    void add(std::int64_t, const Image& image) override { video_.add(image); }
    void finish() override { video_.finish(); }

  private:
    VideoWriter video_;
};

bool isStill(const std::string& out) {
    return out.find(kFrameMark) == std::string::npos && std::filesystem::path(out).extension() == ".png";
}

std::unique_ptr<Sink> makeSink(const std::string& out, const Scene& scene) {
    const std::string extension = std::filesystem::path(out).extension();
    if (isStill(out)) return std::make_unique<StillSink>(out);
    if (extension == ".png") return std::make_unique<SequenceSink>(out);
    if (extension == ".mp4") return std::make_unique<VideoSink>(out, scene.image.size, scene.time.fps);
    throw Error("cannot tell what to write", out,
                "end the name in .png (with {frame} for a sequence) or .mp4");
}

FrameRange chooseFrames(const RenderCommand& command, const Scene& scene) {
    const std::int64_t count = scene.time.frameCount();
    FrameRange range = command.frames.value_or(FrameRange{0, isStill(command.out) ? 0 : count - 1});
    if (range.first < 0 || range.last < range.first || range.last >= count) {
        throw Error("frames " + std::to_string(range.first) + " to " + std::to_string(range.last) +
                        " are not in the scene, which has frames 0 to " + std::to_string(count - 1),
                    "--frames");
    }
    if (isStill(command.out) && range.first != range.last) {
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
    if (command.method) scene.transparency = *command.method;
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
            if (surface.mesh->empty()) {
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

}  // namespace

void runRender(const RenderCommand& command, const CommonOptions& common) {
    Scene scene = loadScene(command.scene);
    applyOverrides(command, scene);
    for (const std::string& note : scene.notes) printNote(note);
    const FrameRange range = chooseFrames(command, scene);
    SceneExtractor extractor(scene, {.memoryBytes = common.memoryBytes, .threads = common.threads});
    const std::unique_ptr<Sink> sink = makeSink(command.out, scene);
    Notes notes(scene);
    const std::int64_t count = range.last - range.first + 1;
    Progress progress("rendering", "frames", count);
    renderFrames(scene, extractor, range, [&](const RenderedFrame& frame) {
        notes.check(frame);
        sink->add(frame.frame, frame.image);
        progress.update(frame.frame - range.first + 1);
        return true;
    });
    sink->finish();
}

}  // namespace isoglass
