// What the style "illustrative" costs against lit surfaces: Tables 1 and 2 of J. Fischer, D. Bartz and W.
// Strasser, "Illustrative Display of Hidden Iso-Surface Structures", 2005; and how steady it is in motion.
// Medians of whole frames without extraction, the passes one after the other; a line of JSON for each.
//
//     illustration_study meshes FOLDER      writes gyroid.ply, gearbox.off and shaft.off
//     illustration_study SCENE.json...      scenes of that style
#include "base/error.h"
#include "gl/headless_context.h"
#include "meshio/mesh_file.h"
#include "pipeline/render_loop.h"
#include "scene/scene_file.h"
#include "study_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace isoglass {
namespace {

constexpr int kRuns = 9;
/// On the timeline: clouds have not formed at its beginning.
constexpr double kMiddle = 0.5;

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + values.size() / 2);
    return values[values.size() / 2];
}

class Study {
  public:
    explicit Study(const Scene& scene) : scene_(scene), extractor_(scene, {}) {
        renderer_.setTiming(true);
        moveTo(kMiddle);
    }

    /// Meshes of that place on the timeline.
    void moveTo(double position) {
        position_ = position;
        const double seconds = position * static_cast<double>(scene_.time.frameCount()) / scene_.time.fps;
        meshes_ = extractor_.extract(position, scene_.camera.poseAt(seconds), scene_.image.size);
        ids_ = uploads_.replace(meshes_.meshes(), renderer_.meshes());
    }

    FrameDescription frame(glm::ivec2 size, bool illustrative) const {
        RenderView view = sceneView(scene_);
        view.camera =
            scene_.camera.poseAt(position_ * static_cast<double>(scene_.time.frameCount()) / scene_.time.fps);
        view.size = size;
        if (!illustrative) view.illustration.reset();
        FrameDescription frame = describeFrame(scene_, view);
        frame.samples = 1;
        frame.draws = surfaceDraws(scene_, meshes_);
        for (std::size_t i = 0; i < frame.draws.size(); ++i) {
            frame.draws[i].mesh = ids_[i];
            frame.draws[i].opacity = 1;
            frame.draws[i].shell.reset();
        }
        return frame;
    }

    std::size_t vertices() const {
        std::size_t count = 0;
        for (const auto& mesh : meshes_.meshes()) count += mesh->vertexCount();
        return count;
    }

    /// Of each pass and, as "", of the frame. Lit and illustrative frames take turns.
    std::array<std::map<std::string, double>, 2> milliseconds(glm::ivec2 size) {
        std::array<std::map<std::string, std::vector<double>>, 2> times;
        for (int run = -1; run < kRuns; ++run) {
            for (const bool illustrative : {false, true}) {
                renderer_.render(frame(size, illustrative));
                if (run < 0) continue;
                double sum = 0;
                for (const PassTiming& timing : renderer_.timings()) {
                    times[illustrative][timing.label].push_back(timing.milliseconds);
                    sum += timing.milliseconds;
                }
                times[illustrative][""].push_back(sum);
            }
        }
        std::array<std::map<std::string, double>, 2> medians;
        for (std::size_t i = 0; i < 2; ++i) {
            for (const auto& [label, values] : times[i]) medians[i][label] = median(values);
        }
        return medians;
    }

    Image picture(const FrameDescription& frame) {
        renderer_.render(frame);
        return renderer_.readSrgb();
    }

  private:
    const Scene& scene_;
    SceneExtractor extractor_;
    SceneMeshes meshes_;
    double position_ = 0;
    gl::HeadlessContext context_;
    Renderer renderer_{context_.context()};
    MeshUploads uploads_;
    std::vector<MeshId> ids_;
};

void studyCost(Study& study, const std::string& name) {
    for (const glm::ivec2 size : {glm::ivec2(1024, 768), {800, 600}, {640, 480}}) {
        const auto [lit, drawn] = study.milliseconds(size);
        std::printf(R"({"scene": "%s", "vertices": %zu, "width": %d, "height": %d, "lit_ms": %.2f, )"
                    R"("illustrative_ms": %.2f, "ratio": %.2f, "passes": {)",
                    name.c_str(), study.vertices(), size.x, size.y, lit.at(""), drawn.at(""),
                    lit.at("") / drawn.at(""));
        const char* comma = "";
        for (const auto& [label, time] : drawn) {
            if (label.empty()) continue;
            std::printf(R"(%s"%s": %.2f)", comma, label.c_str(), time);
            comma = ", ";
        }
        std::printf("}}\n");
    }
}

/// Pixels of lines and hatching that come or go while `show(0)` becomes `show(1)` in so many steps.
template <typename Show>
std::size_t changes(int steps, Show show) {
    std::size_t changed = 0;
    Image before = show(0.0);
    for (int i = 1; i <= steps; ++i) {
        Image now = show(static_cast<double>(i) / steps);
        for (std::size_t p = 0; p < now.pixels.size(); ++p) changed += now.pixels[p] != before.pixels[p];
        before = std::move(now);
    }
    return changed;
}

/// What motion explains comes and goes as often however many steps the motion is cut into; flicker doubles
/// with the number of steps. One turn of 3 degrees about the target, and one key interval of playback where
/// there is one.
void studySteadiness(Study& study, const Scene& scene, const std::string& name) {
    constexpr glm::ivec2 kSize(512, 384);
    const auto turned = [&](double share) {
        FrameDescription frame = study.frame(kSize, true);
        const glm::dvec3 from = frame.camera.eye - frame.camera.target;
        const double angle = share * 3 * M_PI / 180;
        frame.camera.eye =
            frame.camera.target + glm::dvec3(std::cos(angle) * from.x - std::sin(angle) * from.y,
                                             std::sin(angle) * from.x + std::cos(angle) * from.y, from.z);
        // Secondary geometry changes its shade smoothly, in every pixel and step.
        std::erase_if(frame.draws, &SurfaceDraw::secondary);
        return study.picture(frame);
    };
    const auto played = [&](double share) {
        study.moveTo(kMiddle + 0.1 * share);
        FrameDescription frame = study.frame(kSize, true);
        std::erase_if(frame.draws, &SurfaceDraw::secondary);
        return study.picture(frame);
    };
    const double pixels = kSize.x * kSize.y;
    const auto print = [&](const char* motion, auto show) {
        const double coarse = static_cast<double>(changes(32, show)),
                     fine = static_cast<double>(changes(64, show));
        std::printf(R"({"scene": "%s", "motion": "%s", "changed_percent_a_step_of_32": %.3f, )"
                    R"("changed_percent_a_step_of_64": %.3f, "all_64_against_all_32": %.3f})"
                    "\n",
                    name.c_str(), motion, 100 * coarse / pixels / 32, 100 * fine / pixels / 64,
                    fine / coarse);
    };
    print("turning by 3 degrees", turned);
    if (scene.time.frameCount() > 1) print("a tenth of the playback", played);
}

void writeMeshes(const std::filesystem::path& folder) {
    const auto write = [&](const char* name, const SurfaceMesh& mesh) { writeMesh(folder / name, mesh); };
    write("gyroid.ply", makeGyroid());
    write("gearbox.off", makeGearbox());
    write("shaft.off", makeShaft());
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    using namespace isoglass;
    try {
        if (argc < 2) throw Error("scene files, or \"meshes FOLDER\", are expected", "illustration_study");
        if (argc == 3 && std::string(argv[1]) == "meshes") {
            writeMeshes(argv[2]);
            return 0;
        }
        for (int i = 1; i < argc; ++i) {
            const Scene scene = loadScene(argv[i]);
            if (!scene.illustrative) throw Error("the scene has no style \"illustrative\"", argv[i]);
            Study study(scene);
            const std::string name = std::filesystem::path(argv[i]).stem().stem().string();
            studyCost(study, name);
            studySteadiness(study, scene, name);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
