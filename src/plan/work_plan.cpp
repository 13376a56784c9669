#include "plan/work_plan.h"

#include <algorithm>

namespace isoglass {
namespace {

PlannedWork planExtraction(const VolumeState& volume, std::size_t surface) {
    PlannedWork work{WorkKind::extraction, surface, false, ""};
    if (volume.layered && surface == 0) {
        work.reason = "its layers are found in the samples";
    } else if (volume.clippedAway) {
        work.reason = "a clip plane takes the whole volume away";
    } else if (!(volume.surfaceOpacities[surface] > 0)) {
        work.reason = "its opacity is 0";
    } else {
        work.needed = true;
        work.reason = "the surface is visible";
    }
    return work;
}

PlannedWork planSamples(const VolumeState& volume) {
    if (!volume.layered && !volume.shaded)
        return {WorkKind::samples, 0, false, "no ray goes through the volume"};
    if (volume.clippedAway) return {WorkKind::samples, 0, false, "a clip plane takes the whole volume away"};
    return {WorkKind::samples, 0, true,
            volume.layered ? "rays look for layers in them" : "rays gather their light"};
}

}  // namespace

std::string_view workName(WorkKind kind) {
    switch (kind) {
        case WorkKind::firstKeyFrame:
            return "first key frame";
        case WorkKind::secondKeyFrame:
            return "second key frame";
        case WorkKind::extraction:
            return "extraction";
        case WorkKind::samples:
            return "samples";
    }
    return {};
}

std::vector<PlannedWork> planVolume(const VolumeState& volume) {
    std::vector<PlannedWork> uses;
    for (std::size_t i = 0; i < volume.surfaceOpacities.size(); ++i) {
        uses.push_back(planExtraction(volume, i));
    }
    uses.push_back(planSamples(volume));
    const bool any = std::ranges::any_of(uses, &PlannedWork::needed);
    const std::string nothing = "nothing of the volume is shown";
    std::vector<PlannedWork> plan;
    plan.push_back({WorkKind::firstKeyFrame, 0, any, any ? "what is shown comes from it" : nothing});
    const bool second = any && !volume.onKeyFrame;
    plan.push_back({WorkKind::secondKeyFrame, 0, second,
                    second ? "the time lies between two key frames"
                    : any  ? "the time is that of a key frame"
                           : nothing});
    plan.insert(plan.end(), uses.begin(), uses.end());
    return plan;
}

bool isNeeded(const std::vector<PlannedWork>& plan, WorkKind kind, std::size_t surface) {
    return std::ranges::any_of(plan, [&](const PlannedWork& work) {
        return work.needed && work.kind == kind && work.surface == surface;
    });
}

}  // namespace isoglass
