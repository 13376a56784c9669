// What a shaded volume costs, and what its step along the ray is worth, for a scene of the style "volume":
// medians of the pass at two sizes, lit and unlit, and the difference from steps of a sixteenth of a cell. A
// line of JSON for each.
//
//     volume_study SCENE.json
#include "base/error.h"
#include "gl/headless_context.h"
#include "pass_time.h"
#include "pipeline/render_loop.h"
#include "scene/scene_file.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace isoglass {
namespace {

constexpr int kRuns = 3;

class Study {
  public:
    explicit Study(const Scene& scene) : scene_(scene), extractor_(scene, {}) {
        meshes_ = extractor_.extract(0, scene.camera.poseAt(0), scene.image.size);
        uploads_.replace(meshes_.samples, renderer_.volumes());
        renderer_.setTiming(true);
    }

    /// The volume alone, without its surfaces.
    FrameDescription frame(int side) const {
        RenderView view = sceneView(scene_);
        view.size = {side, side};
        FrameDescription frame = describeFrame(scene_, view);
        frame.overlays.clear();
        uploads_.describe(scene_, 0, frame);
        return frame;
    }

    double milliseconds(const FrameDescription& frame) {
        return passMilliseconds(renderer_, frame, PassKind::shadedVolume, kRuns);
    }

    LinearImage picture(FrameDescription frame) {
        frame.keepLinear = true;
        renderer_.render(frame);
        return renderer_.readLinear();
    }

  private:
    const Scene& scene_;
    SceneExtractor extractor_;
    SceneMeshes meshes_;
    gl::HeadlessContext context_;
    Renderer renderer_{context_.context()};
    SampleUploads uploads_;
};

void studyCost(Study& study) {
    for (const int side : {512, 1024}) {
        for (const bool lit : {false, true}) {
            FrameDescription frame = study.frame(side);
            frame.shadedDraw->style.lit = lit;
            const double time = study.milliseconds(frame);
            std::printf(R"({"pixels": %d, "lit": %s, "median_ms": %.1f, "fps": %.2f})"
                        "\n",
                        side, lit ? "true" : "false", time, 1000 / time);
        }
    }
}

/// Differences of linear light, of the largest of the three colors.
void studySteps(Study& study) {
    FrameDescription frame = study.frame(512);
    frame.shadedDraw->style.step = 1.0 / 16;
    const LinearImage right = study.picture(frame);
    for (const double step : {4.0, 2.0, 1.0, 0.5, 0.25, 0.125}) {
        frame.shadedDraw->style.step = step;
        const LinearImage found = study.picture(frame);
        double sum = 0, most = 0;
        for (std::size_t i = 0; i < right.pixels.size(); ++i) {
            const glm::vec3 off = glm::abs(found.pixels[i] - right.pixels[i]);
            const double largest = std::max({off.x, off.y, off.z});
            sum += largest;
            most = std::max(most, largest);
        }
        std::printf(R"({"step": %g, "median_ms": %.1f, "mean_off": %.5f, "most_off": %.4f})"
                    "\n",
                    step, study.milliseconds(frame), sum / static_cast<double>(right.pixels.size()), most);
    }
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    using namespace isoglass;
    try {
        if (argc != 2) throw Error("one scene file is expected", "volume_study");
        const Scene scene = loadScene(argv[1]);
        if (!scene.shaded) throw Error("the scene has no style \"volume\"", argv[1]);
        Study study(scene);
        studyCost(study);
        studySteps(study);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
