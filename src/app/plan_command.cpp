#include "app/commands.h"
#include "plan/frame_plan.h"
#include "scene/scene_file.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace isoglass {

namespace {

PlanInput countSurfaces(const Scene& scene) {
    PlanInput input;
    input.method = scene.transparency;
    for (const Volume& volume : scene.volumes) {
        for (const Surface& surface : volume.surfaces) {
            if (surface.opaque()) {
                ++input.opaqueSurfaces;
            } else if (surface.opacity > 0) {
                ++input.semiTransparentSurfaces;
            }
        }
    }
    return input;
}

nlohmann::ordered_json passesJson(const std::vector<PlannedPass>& passes) {
    auto json = nlohmann::ordered_json::array();
    for (const PlannedPass& pass : passes)
        json.push_back({{"pass", passName(pass.kind)}, {"reason", pass.reason}});
    return json;
}

void printPasses(const std::vector<PlannedPass>& passes) {
    for (const PlannedPass& pass : passes)
        std::cout << "  " << passName(pass.kind) << ": " << pass.reason << '\n';
}

}  // namespace

void runPlan(const PlanCommand& command) {
    const FramePlan plan = planFrame(countSurfaces(loadScene(command.scene)));
    if (command.json) {
        const nlohmann::ordered_json json = {{"passes", passesJson(plan.passes)},
                                             {"left_out", passesJson(plan.leftOut)}};
        std::cout << json.dump(2) << '\n';
        return;
    }
    std::cout << "Passes of a frame:\n";
    printPasses(plan.passes);
    std::cout << "Left out:\n";
    printPasses(plan.leftOut);
}

}  // namespace isoglass
