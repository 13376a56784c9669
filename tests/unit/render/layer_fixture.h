#pragma once

#include "render_fixture.h"
#include "support/layer_reference.h"
#include "support/random_fields.h"

#include <functional>
#include <optional>

namespace isoglass::test {

/// Frames that show nothing but a volume that rays go through.
class VolumeTest : public RenderTest {
  protected:
    VolumeSamples first_;
    VolumeSamples second_;
    FrameDescription frame_;

    void SetUp() override {
        frame_.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 30, .size = {48, 40}};
        frame_.lighting = kUnlit;
    }

    /// What of the frame goes through the volume.
    virtual VolumeDraw& volume() = 0;

    /// Even samples over [-1,1]^3.
    void setLattice(glm::ivec3 dims) {
        for (int k = 0; k < 3; ++k) {
            auto& axis = volume().axes[static_cast<std::size_t>(k)];
            axis.clear();
            for (int i = 0; i < dims[k]; ++i) axis.push_back(-1 + 2.0 * i / (dims[k] - 1));
        }
    }

    glm::ivec3 dims() {
        const auto& axes = volume().axes;
        return {static_cast<int>(axes[0].size()), static_cast<int>(axes[1].size()),
                static_cast<int>(axes[2].size())};
    }

    VolumeSamples sampled(const std::function<double(const glm::dvec3&)>& field) {
        const auto& axes = volume().axes;
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
        volume().first = renderer_.volumes().upload(first_);
        volume().second = renderer_.volumes().upload(second_);
    }

    void forEachPixel(const std::function<void(int x, int y, std::size_t at)>& act) const {
        const glm::ivec2 size = frame_.camera.size;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x)
                act(x, y, static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + x);
        }
    }
};

/// The layers of one volume.
class LayerTest : public VolumeTest {
  protected:
    void SetUp() override {
        VolumeTest::SetUp();
        frame_.layerDraw.emplace();
        draw().style.step = 0.5;
    }

    LayerDraw& draw() { return *frame_.layerDraw; }
    VolumeDraw& volume() override { return draw(); }

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
};

}  // namespace isoglass::test
