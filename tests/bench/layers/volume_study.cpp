// What a shaded volume costs, and what its step along the ray is worth, for a scene of the style "volume":
// medians of the pass at two sizes, lit and unlit, and clipped by solids, and the difference from steps of a
// sixteenth of a cell. A line of JSON for each.
//
//     volume_study SCENE.json
#include "base/error.h"
#include "gl/headless_context.h"
#include "pass_time.h"
#include "pipeline/render_loop.h"
#include "scene/scene_file.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
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

/// A solid in the volume's middle, of 0.35 of its size either way.
SolidClip middleSolid(const VolumeDraw& volume, SolidShape shape, Keep keep) {
    glm::dvec3 middle, reach;
    for (int k = 0; k < 3; ++k) {
        const std::vector<double>& axis = volume.axes[static_cast<std::size_t>(k)];
        middle[k] = 0.5 * (axis.front() + axis.back());
        reach[k] = 0.35 * std::abs(axis.back() - axis.front());
    }
    return {shape, keep, glm::scale(glm::translate(glm::dmat4(1), middle), reach)};
}

/// Each solid that clips against no clipping, in turn. Probing leaves less to go through, cutting bares what
/// lay behind.
void studyClip(Study& study) {
    constexpr std::array kShapes{"box", "sphere", "cylinder"};
    for (const int side : {512, 1024}) {
        FrameDescription frame = study.frame(side);
        const double whole = study.milliseconds(frame);
        for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
            for (const Keep keep : {Keep::inside, Keep::outside}) {
                frame.shadedDraw->solids = {middleSolid(*frame.shadedDraw, SolidShape(shape), keep)};
                const double time = study.milliseconds(frame);
                std::printf(R"({"pixels": %d, "solid": "%s", "keep": "%s", "median_ms": %.1f, )"
                            R"("whole_ms": %.1f, "rate": %.2f})"
                            "\n",
                            side, kShapes[shape], keep == Keep::inside ? "inside" : "outside", time, whole,
                            whole / time);
            }
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
        studyClip(study);
        studySteps(study);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
