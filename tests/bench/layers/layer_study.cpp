// What the style "layers" costs, for a scene that has it: Table 2 of Nagy and Klein (pictures of 256^2 and
// 512^2 pixels), one layer against eight on whole rays and on rays that end early, and the step along the ray
// against what it misses. Medians of the pass; a line of JSON for each.
//
//     layer_study SCENE.json
#include "base/error.h"
#include "gl/headless_context.h"
#include "pass_time.h"
#include "pipeline/render_loop.h"
#include "scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace isoglass {
namespace {

constexpr int kRuns = 5;
constexpr int kMostCounted = 8;

class Study {
  public:
    explicit Study(const Scene& scene) : scene_(scene), extractor_(scene, {}) {
        const SceneMeshes meshes = extractor_.extract(0, scene.camera.poseAt(0), scene.image.size);
        uploads_.replace(meshes.samples, renderer_.volumes());
        renderer_.setTiming(true);
    }

    FrameDescription frame(int side) const {
        RenderView view = sceneView(scene_);
        view.size = {side, side};
        FrameDescription frame = describeFrame(scene_, view);
        frame.overlays.clear();
        uploads_.describe(scene_, 0, frame);
        return frame;
    }

    double milliseconds(const FrameDescription& frame) {
        return passMilliseconds(renderer_, frame, PassKind::layers, kRuns);
    }

    LinearImage measure(FrameDescription frame) {
        frame.layerDraw->output = LayerDraw::Output::measure;
        frame.layerDraw->wholeRay = true;
        frame.keepLinear = true;
        renderer_.render(frame);
        return renderer_.readLinear();
    }

  private:
    const Scene& scene_;
    SceneExtractor extractor_;
    gl::HeadlessContext context_;
    Renderer renderer_{context_.context()};
    SampleUploads uploads_;
};

void studyCounts(Study& study) {
    for (const int side : {256, 512}) {
        for (const bool wholeRay : {false, true}) {
            for (const int count : {1, 3, kMostCounted}) {
                FrameDescription frame = study.frame(side);
                frame.layerDraw->style.show = LayerStyle::Show::blend;
                frame.layerDraw->style.count = count;
                frame.layerDraw->wholeRay = wholeRay;
                const double time = study.milliseconds(frame);
                std::printf(R"({"pixels": %d, "layers": %d, "whole_ray": %s, "median_ms": %.2f, "fps": %.1f})"
                            "\n",
                            side, count, wholeRay ? "true" : "false", time, 1000 / time);
            }
        }
    }
}

/// Against a sixteenth of a cell: rays that count another number of layers, and how far the first one is off
/// on the others, in thousandths of the distance.
void studySteps(Study& study) {
    constexpr int kSide = 512;
    FrameDescription frame = study.frame(kSide);
    frame.layerDraw->style.count = 1;
    frame.layerDraw->style.step = 1.0 / 16;
    const LinearImage right = study.measure(frame);
    for (const double step : {4.0, 2.0, 1.0, 0.5, 0.25, 0.125}) {
        frame.layerDraw->style.step = step;
        const LinearImage found = study.measure(frame);
        double others = 0, rays = 0, off = 0, same = 0;
        for (std::size_t i = 0; i < right.pixels.size(); ++i) {
            if (right.pixels[i].g == 0 && found.pixels[i].g == 0) continue;
            ++rays;
            if (right.pixels[i].g != found.pixels[i].g) {
                ++others;
                continue;
            }
            ++same;
            off += std::abs(found.pixels[i].r - right.pixels[i].r) / right.pixels[i].r;
        }
        FrameDescription timed = frame;
        timed.layerDraw->style.count = 3;
        std::printf(
            R"({"step": %g, "median_ms": %.2f, "other_count_percent": %.3f, "mean_off_permille": %.5f})"
            "\n",
            step, study.milliseconds(timed), 100 * others / std::max(rays, 1.0),
            1000 * off / std::max(same, 1.0));
    }
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    using namespace isoglass;
    try {
        if (argc != 2) throw Error("one scene file is expected", "layer_study");
        const Scene scene = loadScene(argv[1]);
        if (!scene.layers) throw Error("the scene has no style \"layers\"", argv[1]);
        Study study(scene);
        studyCounts(study);
        studySteps(study);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
