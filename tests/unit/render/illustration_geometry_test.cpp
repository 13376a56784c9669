// What the geometry passes of the style "illustrative" find, against rays on the CPU.

#include "illustration_fixture.h"

#include <glm/ext/matrix_transform.hpp>

#include <tuple>

namespace isoglass::test {
namespace {

/// A place where a ray meets a surface, as the geometry passes see it.
struct Seen {
    std::tuple<std::size_t, bool> which{};  ///< surface, back face
    glm::dvec3 normal{0};                   ///< of the side that is seen
    double distance = 0;                    ///< along the view axis

    glm::dvec4 values() const { return {normal, distance}; }
};

class GeometryPasses : public IllustrationTest {
  protected:
    std::vector<Seen> trace(double x, double y) const {
        const Ray ray = pixelRay(frame_.camera, x, y);
        const ViewAxes axes = viewAxes(frame_.camera);
        std::vector<Seen> hits;
        for (std::size_t s = 0; s < surfaces_.size(); ++s) {
            const auto& [mesh, draw] = surfaces_[s];
            const glm::dmat3 normalToWorld = glm::transpose(glm::inverse(glm::dmat3(draw.worldFromSeries)));
            const bool mirrored = glm::determinant(glm::dmat3(draw.worldFromSeries)) < 0;
            for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
                std::array<glm::dvec3, 3> corner;
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec3 position =
                        mesh.origin + glm::dvec3(mesh.positions[mesh.triangles[t + k]]);
                    corner[k] = glm::dvec3(draw.worldFromSeries * glm::dvec4(position, 1));
                }
                const auto hit = intersectTriangle(ray, corner);
                if (!hit) continue;
                glm::dvec3 normal(0);
                for (int k = 0; k < 3; ++k)
                    normal +=
                        hit->barycentric[k] * glm::dvec3(mesh.normals[mesh.triangles[t + std::size_t(k)]]);
                const bool back = hit->backFace != mirrored;
                hits.push_back({{s, back},
                                glm::normalize(normalToWorld * normal) * (back ? -1.0 : 1.0),
                                hit->distance * glm::dot(ray.direction, axes.forward)});
            }
        }
        std::ranges::sort(hits, {}, &Seen::distance);
        // Both triangles beside an edge are met.
        const auto same = [](const Seen& a, const Seen& b) {
            return a.which == b.which && b.distance - a.distance < 1e-9 * a.distance;
        };
        hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
        return hits;
    }

    /// A sample may lie anywhere within 1/64 of a pixel around the middle (see TruthOptions): where the
    /// corners of that square meet other surfaces it may be either; else it is off by what they differ by,
    /// twice that where an edge runs through the square, and by the rounding of single precision.
    int expectSeen(Target target, std::size_t layer) {
        const Geometry found = unpacked(renderer_.readIntegers(target));
        int certain = 0;
        for (int y = 0; y < found.size.y; ++y) {
            for (int x = 0; x < found.size.x; ++x) {
                const auto hit = [&](double dx, double dy) {
                    const std::vector<Seen> hits = trace(x + 0.5 + dx, y + 0.5 + dy);
                    return hits.size() > layer ? hits[layer] : Seen{{surfaces_.size(), false}};
                };
                const Seen middle = hit(0, 0);
                glm::dvec4 allowed(0);
                bool sure = true;
                constexpr double kRadius = 1.0 / 64;
                for (const auto& [dx, dy] : {std::pair(-kRadius, -kRadius),
                                             {kRadius, -kRadius},
                                             {-kRadius, kRadius},
                                             {kRadius, kRadius}}) {
                    const Seen corner = hit(dx, dy);
                    sure &= corner.which == middle.which;
                    allowed = glm::max(allowed, 2.0 * glm::abs(corner.values() - middle.values()));
                }
                if (!sure) continue;
                ++certain;
                for (int k = 0; k < 4; ++k) {
                    const double rounding = k == 3 ? 0x1p-19 * middle.distance : 3 * 0x1p-15;
                    EXPECT_NEAR(found.at(x, y)[k], middle.values()[k], allowed[k] + rounding)
                        << x << ", " << y << " component " << k;
                }
            }
        }
        return certain;
    }
};

TEST_F(GeometryPasses, FindNormalAndDistanceOfTheFirstTwoSurfaces) {
    frame_.camera = {.eye = {3, -4, 2.5}, .fovDegrees = 30, .size = {48, 40}};
    add(sphere({0, 0, 0}, 1, 8));
    add(sphere({0.2f, 0.1f, 0}, 0.6f, 6), {.opacity = 0.3f});
    // Open, seen from both sides; placed, turned and mirrored.
    add(quad(0.3f, 0.9f), {.worldFromSeries = glm::scale(glm::rotate(glm::dmat4(1), 0.4, {1, 0.3, 0.2}),
                                                         glm::dvec3(-1.2, 1, 1))});
    renderer_.render(frame_);
    EXPECT_GT(expectSeen(Target::firstSurface, 0), 1500);
    EXPECT_GT(expectSeen(Target::secondSurface, 1), 1400);
}

TEST_F(GeometryPasses, MovingSurfacesAreDrawnWhereTheyAre) {
    SurfaceMesh mesh = sphere({0, 0, 0}, 0.8f, 8);
    mesh.velocities.assign(mesh.vertexCount(), {0.5f, 0, 0});
    add(std::move(mesh));
    frame_.draws[0].motion = 0.5f;
    frame_.draws[0].motionLimit = 1;
    frame_.draws[0].boundsSeries = Bounds{{-2, -2, -2}, {2, 2, 2}};
    for (glm::vec3& position : surfaces_[0].mesh.positions) position.x += 0.25f;
    renderer_.render(frame_);
    EXPECT_GT(expectSeen(Target::firstSurface, 0), 2000);
}

}  // namespace
}  // namespace isoglass::test
