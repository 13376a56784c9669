#pragma once

#include "render_fixture.h"
#include "support/layer_reference.h"
#include "support/random_fields.h"

#include <functional>
#include <optional>

namespace isoglass::test {

/// Frames that show nothing but the layers of one volume.
class LayerTest : public RenderTest {
  protected:
    VolumeSamples first_;
    VolumeSamples second_;
    FrameDescription frame_;

    void SetUp() override {
        frame_.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 30, .size = {48, 40}};
        frame_.lighting = kUnlit;
        frame_.layerDraw.emplace();
        draw().style.step = 0.5;
    }

    LayerDraw& draw() { return *frame_.layerDraw; }

    /// Even samples over [-1,1]^3.
    void setLattice(glm::ivec3 dims) {
        for (int k = 0; k < 3; ++k) {
            auto& axis = draw().axes[static_cast<std::size_t>(k)];
            axis.clear();
            for (int i = 0; i < dims[k]; ++i) axis.push_back(-1 + 2.0 * i / (dims[k] - 1));
        }
    }

    glm::ivec3 dims() const {
        const auto& axes = frame_.layerDraw->axes;
        return {static_cast<int>(axes[0].size()), static_cast<int>(axes[1].size()),
                static_cast<int>(axes[2].size())};
    }

    VolumeSamples sampled(const std::function<double(const glm::dvec3&)>& field) const {
        const auto& axes = frame_.layerDraw->axes;
        std::vector<float> values;
        for (const double z : axes[2]) {
            for (const double y : axes[1]) {
                for (const double x : axes[0]) values.push_back(static_cast<float>(field({x, y, z})));
            }
        }
        return makeVolumeSamples(dims(), std::move(values));
    }

    void upload(VolumeSamples first, std::optional<VolumeSamples> second = {}) {
        first_ = std::move(first);
        second_ = second ? std::move(*second) : first_;
        draw().first = renderer_.volumes().upload(first_);
        draw().second = renderer_.volumes().upload(second_);
    }

    /// Red: depth of layer `count`; green: layers of the whole ray.
    LinearImage measure() {
        FrameDescription frame = frame_;
        frame.layerDraw->output = LayerDraw::Output::measure;
        frame.layerDraw->wholeRay = true;
        return renderLinear(frame);
    }

    LayerHits reference(int x, int y) const {
        return LayerReference(*frame_.layerDraw, first_, second_).march(frame_.camera, x + 0.5, y + 0.5);
    }

    void forEachPixel(const std::function<void(int x, int y, std::size_t at)>& act) const {
        const glm::ivec2 size = frame_.camera.size;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x)
                act(x, y, static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + x);
        }
    }
};

}  // namespace isoglass::test
