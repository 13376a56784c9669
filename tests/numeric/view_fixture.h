#pragma once

#include "surface/extract.h"
#include "unit/render/render_fixture.h"
#include "volume/analytic.h"
#include "volume/series_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace isoglass::numeric {

/// Drawing of extracted surfaces, for views that are hard.
class ViewTest : public test::RenderTest {
  protected:
    /// A ball of radius `radius` around the middle of a lattice of 33 samples and `step` from `origin`.
    static SurfaceMesh ballMesh(glm::dvec3 origin, double step, double radius) {
        const Lattice lattice = makeUniformLattice(glm::ivec3(33), origin, glm::dvec3(step));
        const glm::dvec3 middle = origin + 16 * step;
        const auto field = [&](glm::dvec3 p, double) {
            return static_cast<float>(radius - glm::length(p - middle));
        };
        return extractSurface(lattice, {makeAnalyticFrame(lattice, field, 0), nullptr, 0}, {}).mesh;
    }

    MeshId upload(const SurfaceMesh& mesh) { return renderer_.meshes().upload(mesh); }

    static bool isFinite(const LinearImage& image) {
        return std::ranges::all_of(image.pixels, [](const glm::vec3& p) {
            return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b);
        });
    }
};

}  // namespace isoglass::numeric
