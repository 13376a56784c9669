#pragma once

#include "render_fixture.h"
#include "support/illustration_reference.h"

#include <functional>

namespace isoglass::test {

/// Colours that tell the stages apart.
inline constexpr glm::vec3 kPaper(0.9f, 0.8f, 0.7f), kFront(0, 0, 0.1f), kBack(0.5f, 0, 0),
    kSecondary(0, 0.6f, 0.2f);

class IllustrationTest : public RenderTest {
  protected:
    FrameDescription frame_;
    std::vector<TruthSurface> surfaces_;

    void SetUp() override {
        frame_.camera = fromAbove(5, {60, 48});
        style() = {.paper = kPaper, .front = kFront, .back = kBack};
    }

    IllustrativeStyle& style() {
        if (!frame_.illustration) frame_.illustration.emplace();
        return *frame_.illustration;
    }

    void add(SurfaceMesh mesh, SurfaceDraw draw = {}) {
        surfaces_.push_back({std::move(mesh), draw});
        show(frame_, {surfaces_.back()});
    }
    void addSecondary(SurfaceMesh mesh) { add(std::move(mesh), {.color = kSecondary, .secondary = true}); }

    double pixelSize() const {
        return 2 * std::tan(frame_.camera.fovDegrees * M_PI / 360) / frame_.camera.size.y;
    }

    /// Towards the light, in the world.
    glm::dvec3 light() {
        const ViewAxes axes = viewAxes(frame_.camera);
        const glm::dvec3 l(style().light);
        return glm::normalize(l.x * axes.right + l.y * axes.up - l.z * axes.forward);
    }

    void forEachPixel(const std::function<void(int x, int y)>& act) const {
        for (int y = 0; y < frame_.camera.size.y; ++y) {
            for (int x = 0; x < frame_.camera.size.x; ++x) act(x, y);
        }
    }

    static int count(const LinearImage& image, const glm::vec3& color) {
        return static_cast<int>(std::ranges::count(image.pixels, color));
    }
};

}  // namespace isoglass::test
