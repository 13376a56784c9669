#include "app/cosine_fits.h"

#include "app/text.h"
#include "optics/shell_transmittance.h"

#include <iostream>

namespace isoglass {

namespace {

/// Calls `use(volume, surface, fit)` for every cosine opacity of the scene.
template <typename Use>
void forEachFit(const Scene& scene, Use use) {
    for (const Volume& volume : scene.volumes) {
        for (const Surface& surface : volume.surfaces) {
            if (surface.shell && surface.shell->model == ShellOpacity::Model::cosine)
                use(volume, surface, prepareShell(*surface.shell).fit);
        }
    }
}

}  // namespace

nlohmann::ordered_json cosineFitsJson(const Scene& scene) {
    auto json = nlohmann::ordered_json::array();
    forEachFit(scene, [&json](const Volume& volume, const Surface& surface, const CosineFit& fit) {
        json.push_back({{"volume", volume.name},
                        {"iso", surface.iso},
                        {"power", fit.power},
                        {"offset", fit.offset},
                        {"residual_rms", fit.rms},
                        {"residual_max", fit.largest}});
    });
    return json;
}

void printCosineFits(const Scene& scene) {
    bool first = true;
    forEachFit(scene, [&first](const Volume& volume, const Surface& surface, const CosineFit& fit) {
        if (first) std::cout << "Cosine opacities, fitted to their shell up to the inner radius:\n";
        first = false;
        std::cout << "  " << volume.name << " at " << formatNumber(surface.iso) << ": transmittance cos^"
                  << formatNumber(fit.power) << " - " << formatNumber(fit.offset) << ", residual rms "
                  << formatNumber(fit.rms) << ", largest " << formatNumber(fit.largest) << '\n';
    });
}

}  // namespace isoglass
