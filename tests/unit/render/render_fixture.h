#pragma once

#include "gl/headless_context.h"
#include "render/renderer.h"
#include "support/ground_truth.h"
#include "support/image_compare.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace isoglass::test {

/// A context for each test. Whatever OpenGL complains of fails the test.
class GlTest : public testing::Test {
  protected:
    gl::HeadlessContext headless_;
    gl::Context& context_ = headless_.context();

    void TearDown() override {
        for (const std::string& message : context_.debugLog().take()) {
            ADD_FAILURE() << "OpenGL on " << context_.rendererName() << ": " << message;
        }
    }
};

class RenderTest : public GlTest {
  protected:
    Renderer renderer_{context_};

    LinearImage renderLinear(const FrameDescription& frame) {
        renderer_.render(frame);
        return renderer_.readLinear();
    }

    /// Uploads the surfaces and appends them to the frame.
    void show(FrameDescription& frame, const std::vector<TruthSurface>& surfaces) {
        for (const TruthSurface& surface : surfaces) {
            frame.draws.push_back(surface.draw);
            frame.draws.back().mesh = renderer_.meshes().upload(surface.mesh);
        }
    }
};

/// Surfaces show their color as it is.
inline constexpr Lighting kUnlit{.ambient = 1, .diffuse = 0, .specular = 0, .shininess = 1};

/// A square in the plane z = `z`, twice `half` wide, seen from above its front unless `facingDown`.
inline SurfaceMesh quad(float z, float half, bool facingDown = false) {
    SurfaceMesh mesh;
    mesh.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    mesh.normals.assign(4, {0, 0, facingDown ? -1.0f : 1.0f});
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    if (facingDown) mesh.triangles = {0, 2, 1, 0, 3, 2};
    return mesh;
}

/// A sphere of `rings` x 2 `rings` patches around the z axis, wound outwards, its normals those of the
/// sphere.
inline SurfaceMesh sphere(const glm::vec3& center, float radius, int rings) {
    SurfaceMesh mesh;
    const int sectors = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j < sectors; ++j) {
            const double theta = M_PI * i / rings;
            const double phi = 2 * M_PI * j / sectors;
            const glm::vec3 normal(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                   std::cos(theta));
            mesh.positions.push_back(center + radius * normal);
            mesh.normals.push_back(normal);
        }
    }
    const auto vertex = [sectors](int i, int j) {
        return static_cast<std::uint32_t>(i * sectors + j % sectors);
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < sectors; ++j) {
            const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                                d = vertex(i, j + 1);
            if (i + 1 < rings) mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
            if (i > 0) mesh.triangles.insert(mesh.triangles.end(), {a, c, d});
        }
    }
    return mesh;
}

/// A camera on the z axis that looks down on the plane z = 0, x to the right and y up.
inline CameraView fromAbove(double distance, glm::ivec2 size = {32, 32}) {
    return {.eye = {0, 0, distance}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fovDegrees = 30, .size = size};
}

inline double largestDifference(const glm::vec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = glm::abs(glm::dvec3(a) - b);
    return std::max({d.x, d.y, d.z});
}

}  // namespace isoglass::test
