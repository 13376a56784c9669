#include "app/commands.h"
#include "app/cosine_fits.h"
#include "app/text.h"
#include "gl/headless_context.h"
#include "pipeline/render_loop.h"
#include "scene/scene_file.h"
#include "scene/transparency.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <optional>

namespace isoglass {

namespace {

using Json = nlohmann::ordered_json;

/// A frame's plan, and what its passes took.
struct MeasuredPlan {
    FramePlan plan;
    std::vector<PassTiming> timings;
    std::string renderer;
};

/// The second drawing is measured: the first one compiles shaders and makes targets.
MeasuredPlan measure(const Scene& scene, const SceneMeshes& meshes) {
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    FrameDescription frame = describeFrame(scene, sceneView(scene));
    frame.draws = surfaceDraws(scene, meshes);
    MeshUploads uploads;
    const std::vector<MeshId> ids = uploads.replace(meshes.meshes(), renderer.meshes());
    for (std::size_t i = 0; i < frame.draws.size(); ++i) frame.draws[i].mesh = ids[i];
    SampleUploads samples;
    samples.replace(meshes.samples, renderer.volumes());
    samples.describe(scene, 0, frame);
    renderer.render(frame);
    renderer.setTiming(true);
    renderer.render(frame);
    return {renderer.plan(), renderer.timings(), context.context().rendererName()};
}

std::string clockName(PassTiming::How how) {
    return how == PassTiming::How::gpuTimer ? "GPU timer query" : "serial wall clock";
}

std::optional<double> milliseconds(const MeasuredPlan& measured, const PlannedPass& pass) {
    for (const PassTiming& timing : measured.timings) {
        if (timing.label == passLabel(pass)) return timing.milliseconds;
    }
    return std::nullopt;
}

std::string workLabel(const Scene& scene, std::size_t volume, const PlannedWork& work) {
    std::string label(workName(work.kind));
    if (work.kind == WorkKind::extraction) {
        label += " of iso-value " + formatNumber(scene.volumes[volume].surfaces[work.surface].iso);
    }
    return label;
}

Json workJson(const Scene& scene, const std::vector<std::vector<PlannedWork>>& works, bool needed) {
    Json list = Json::array();
    for (std::size_t v = 0; v < works.size(); ++v) {
        for (const PlannedWork& work : works[v]) {
            if (work.needed != needed) continue;
            list.push_back({{"volume", scene.volumes[v].name},
                            {"work", workLabel(scene, v, work)},
                            {"reason", work.reason}});
        }
    }
    return list;
}

Json planJson(const Scene& scene, const std::vector<std::vector<PlannedWork>>& works,
              const MeasuredPlan& measured) {
    const FramePlan& plan = measured.plan;
    Json passes = Json::array();
    for (const PlannedPass& pass : plan.passes) {
        passes.push_back({{"pass", passLabel(pass)}, {"reason", pass.reason}});
        if (const auto time = milliseconds(measured, pass)) passes.back()["milliseconds"] = *time;
    }
    Json leftOut = Json::array();
    for (const PlannedPass& pass : plan.leftOut) {
        leftOut.push_back({{"pass", passLabel(pass)}, {"reason", pass.reason}});
    }
    return {{"method", transparencyMethodName(plan.method)},
            {"method_reason", plan.methodReason},
            {"samples", plan.supersample * plan.supersample * plan.subframes},
            {"subframes", plan.subframes},
            {"renderer", measured.renderer},
            {"clock", clockName(measured.timings.front().how)},
            {"work", workJson(scene, works, true)},
            {"passes", std::move(passes)},
            {"work_left_out", workJson(scene, works, false)},
            {"left_out", std::move(leftOut)},
            {"cosine_fits", cosineFitsJson(scene)}};
}

void printWork(const Json& list) {
    for (const Json& item : list) {
        std::cout << "  " << item["volume"].get<std::string>() << ", " << item["work"].get<std::string>()
                  << ": " << item["reason"].get<std::string>() << '\n';
    }
}

void printPasses(const Json& list) {
    for (const Json& item : list) {
        std::cout << "  " << item["pass"].get<std::string>() << ": " << item["reason"].get<std::string>();
        if (item.contains("milliseconds")) {
            std::cout << " (" << formatNumber(std::round(item["milliseconds"].get<double>() * 100) / 100)
                      << " ms)";
        }
        std::cout << '\n';
    }
}

void print(const Json& plan) {
    std::cout << "Method: " << plan["method"].get<std::string>() << ", "
              << plan["method_reason"].get<std::string>() << '\n'
              << "Before the passes:\n";
    printWork(plan["work"]);
    std::cout << "Passes of a frame, each "
              << (plan["subframes"] > 1 ? plan["subframes"].dump() + " times but the presentation, "
                                        : std::string())
              << "timed by " << plan["clock"].get<std::string>() << " on "
              << plan["renderer"].get<std::string>() << ":\n";
    printPasses(plan["passes"]);
    std::cout << "Left out:\n";
    printWork(plan["work_left_out"]);
    printPasses(plan["left_out"]);
}

}  // namespace

void runPlan(const PlanCommand& command, const CommonOptions& common) {
    const Scene scene = loadScene(command.scene);
    SceneExtractor extractor(scene,
                             {.memoryBytes = common.memoryBytes, .threads = common.threads, .seenMargin = 0});
    for (const std::string& note : extractor.notes()) printNote(note);
    const SceneMeshes meshes = extractor.extract(0, scene.camera.poseAt(0), scene.image.size);
    const Json plan = planJson(scene, meshes.work, measure(scene, meshes));
    if (command.json) {
        std::cout << plan.dump(2) << '\n';
    } else {
        print(plan);
        printCosineFits(scene);
    }
}

}  // namespace isoglass
