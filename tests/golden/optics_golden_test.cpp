#include "gl/headless_context.h"
#include "render/renderer.h"
#include "support/golden.h"
#include "surface/extract.h"
#include "surface/vertex_values.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace isoglass::test {
namespace {

/// 160 x 120 pixels, 8 bits. One step of 8 bits is up to 0.9 % of linear light, so that two steps have not
/// changed a pixel. Drivers place silhouettes a little differently: these pictures have up to 600 such
/// pixels, 3 %, of which a sample flips in a few; the mean allows one in ten of them to change by 0.3.
constexpr ImageLimits kLimits{.threshold = 0.02, .mean = 1e-3, .changedShare = 0.01, .largest = 1};

/// Two bells that run into each other: a peanut outside, two kernels inside.
float peanut(glm::dvec3 p, double) {
    const auto bell = [&p](double x) {
        const glm::dvec3 d = p - glm::dvec3(x, 0.3 * x, 0);
        return std::exp(-glm::dot(d, d) / 0.16);
    };
    return static_cast<float>(bell(-0.4) + 0.8 * bell(0.4));
}

class OpticsGolden : public testing::Test {
  protected:
    OpticsGolden() {
        frame_.camera = {.eye = {2.4, -3.2, 1.8}, .fovDegrees = 26, .size = {160, 120}};
        frame_.background = {0.5f, 0.55f, 0.6f};
        frame_.method = TransparencyMethod::fourPass;
        frame_.samples = 4;
    }

    void TearDown() override { context_.debugLog().throwIfAny("golden picture"); }

    Extraction extract(const AnalyticField& field, float iso, const std::vector<CutPlane>& clip = {},
                       bool closed = false) const {
        const TimedField timed{makeAnalyticFrame(lattice_, field, 0.3), nullptr, 0};
        return extractSurface(lattice_, timed, {.iso = iso, .clip = clip, .closed = closed});
    }

    void add(const SurfaceMesh& mesh, SurfaceDraw draw) {
        if (mesh.empty()) return;
        draw.mesh = renderer_.meshes().upload(mesh);
        frame_.draws.push_back(draw);
    }

    /// The surface and what fills its cuts.
    void addCut(const Extraction& cut, const SurfaceDraw& draw, int rank) {
        add(cut.mesh, draw);
        SurfaceDraw cap = draw;
        cap.depthRank = rank;
        add(cut.caps, cap);
    }

    void expectGolden(const std::string& name) {
        renderer_.render(frame_);
        EXPECT_EQ(differenceFromGolden(name, renderer_.readSrgb(), kLimits), "");
    }

    void expectShell(const std::string& name, const ShellOpacity& shell) {
        add(extract(peanut, 0.6f).mesh, {.color = {0.9f, 0.1f, 0.05f}});
        add(extract(peanut, 0.15f).mesh, {.color = {0.1f, 0.25f, 0.9f}, .shell = prepareShell(shell)});
        expectGolden(name);
    }

    gl::HeadlessContext headless_;
    gl::Context& context_ = headless_.context();
    Renderer renderer_{context_};
    FrameDescription frame_{};
    Lattice lattice_ = makeUnitLattice(40);
};

using Model = ShellOpacity::Model;

TEST_F(OpticsGolden, ConstantOpacity) {
    add(extract(peanut, 0.6f).mesh, {.color = {0.9f, 0.1f, 0.05f}});
    add(extract(peanut, 0.15f).mesh, {.color = {0.1f, 0.25f, 0.9f}, .opacity = 0.4f});
    expectGolden("opacity-constant");
}

TEST_F(OpticsGolden, Slab) {
    expectShell("opacity-slab", {.model = Model::slab, .extinction = 5, .thickness = 0.05f});
}

TEST_F(OpticsGolden, SlabByGradient) {
    expectShell("opacity-slab-gradient",
                {.model = Model::slab, .extinction = 5, .isoWidth = 0.1f, .maxThickness = 0.5f});
}

TEST_F(OpticsGolden, Cosine) {
    expectShell("opacity-cosine", {.model = Model::cosine, .extinction = 10, .thickness = 0.05f});
}

TEST_F(OpticsGolden, IsoSpectrum) {
    expectShell("opacity-iso-spectrum", {.model = Model::isoSpectrum, .extinction = 10, .thickness = 0.05f});
}

TEST_F(OpticsGolden, CapsOfNestedOpaqueSurfaces) {
    const std::vector<CutPlane> planes{{{-0.3, 1, -0.2, 0}}};
    addCut(extract(peanut, 0.15f, planes), {.color = {0.1f, 0.25f, 0.9f}}, 0);
    addCut(extract(peanut, 0.35f, planes), {.color = {0.1f, 0.7f, 0.2f}}, 1);
    addCut(extract(peanut, 0.7f, planes), {.color = {0.9f, 0.1f, 0.05f}}, 2);
    expectGolden("clip-caps-opaque");
}

TEST_F(OpticsGolden, CapsOfSemiTransparentSurfaces) {
    const std::vector<CutPlane> planes{{{-0.3, 1, -0.2, 0}}, {{0, 0, -1, 0.4}}};
    addCut(extract(peanut, 0.15f, planes), {.color = {0.1f, 0.25f, 0.9f}, .opacity = 0.4f}, 0);
    addCut(extract(peanut, 0.6f, planes), {.color = {0.9f, 0.1f, 0.05f}, .opacity = 0.6f}, 1);
    expectGolden("clip-caps-semi-transparent");
}

TEST_F(OpticsGolden, ACutWithoutCaps) {
    addCut(extract(peanut, 0.15f, {{{-0.3, 1, -0.2, 0}, false}}), {.color = {0.1f, 0.25f, 0.9f}}, 0);
    expectGolden("clip-open");
}

/// The eye lies in the plane: the caps are seen edge-on, as nothing or as a line.
TEST_F(OpticsGolden, APlaneThroughTheEye) {
    const glm::dvec3 eye = frame_.camera.eye;
    const glm::dvec3 normal = glm::normalize(glm::cross(eye, glm::dvec3(0, 0, 1)));
    addCut(extract(peanut, 0.15f, {{glm::dvec4(normal, 0)}}), {.color = {0.1f, 0.25f, 0.9f}}, 0);
    expectGolden("clip-through-the-eye");
}

TEST_F(OpticsGolden, ClosedDomain) {
    frame_.camera.fovDegrees = 46;
    addCut(extract(gyroid, 0, {}, true), {.color = {0.8f, 0.6f, 0.2f}}, 0);
    expectGolden("boundary-closed");
}

TEST_F(OpticsGolden, ColorByCurvatureWithALegend) {
    SurfaceMesh mesh = extract(peanut, 0.5f).mesh;
    mesh.colorValues = meanCurvature(mesh);
    const LegendBar bar{4, -4, 4};
    add(mesh, {.colorBar = bar});
    frame_.overlays = makeLegend({bar}, frame_.camera.size, frame_.background);
    expectGolden("color-curvature");
}

TEST_F(OpticsGolden, CapsColoredByTheFieldWithALegend) {
    Extraction cut = extract(peanut, 0.15f, {{{-0.3, 1, -0.2, 0}}});
    const TimedField field{makeAnalyticFrame(lattice_, peanut, 0.3), nullptr, 0};
    cut.mesh.colorValues = sampleAtVertices(cut.mesh, lattice_, field);
    cut.caps.colorValues = sampleAtVertices(cut.caps, lattice_, field);
    const LegendBar bar{0, 0.15, 1};
    addCut(cut, {.colorBar = bar}, 0);
    frame_.overlays = makeLegend({bar}, frame_.camera.size, frame_.background);
    expectGolden("color-caps");
}

}  // namespace
}  // namespace isoglass::test
