#include "base/error.h"
#include "numeric/table_row.h"
#include "numeric/view_fixture.h"

#include <glm/ext/matrix_transform.hpp>

namespace isoglass::numeric {
namespace {

using test::kUnlit;

constexpr glm::vec3 kRed(1, 0, 0);
constexpr glm::vec3 kBlue(0, 0, 1);

class NumericCamera : public ViewTest {};

std::size_t countPixels(const LinearImage& image, const glm::vec3& color) {
    return static_cast<std::size_t>(std::ranges::count(image.pixels, color));
}

// Unit samples and a ball of radius 12: features of 1 m at the distance of Earth's radius.
TEST_F(NumericCamera, AShiftedSceneGivesTheUnshiftedImage) {
    const glm::ivec2 size(400, 300);
    const CameraView camera{.eye = {60, 45, 50}, .target = {16, 16, 16}, .fovDegrees = 40, .size = size};
    FrameDescription near{.camera = camera, .background = glm::vec3(0.1f)};
    near.draws.push_back({.mesh = upload(ballMesh(glm::dvec3(0), 1, 12)), .color = kRed, .opacity = 0.5f});
    const LinearImage expected = renderLinear(near);
    for (const glm::dvec3 shift : {glm::dvec3(5e6, 5e6, 0), glm::dvec3(-6.4e6, 6.4e6, 6.4e6)}) {
        FrameDescription far = near;
        far.camera.eye += shift;
        far.camera.target += shift;
        far.draws[0].mesh = upload(ballMesh(shift, 1, 12));
        const LinearImage image = renderLinear(far);
        // Away from silhouettes normals of two renderings differ by float rounding alone; where a sample
        // changes sides of a silhouette, one of its eight neighbours in the expected image has another count
        // of layers, which shows as a step of at least a tenth.
        std::size_t changed = 0;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                if (test::largestDifference(image.at(x, y), expected.at(x, y)) < 1e-3) continue;
                ++changed;
                bool besideStep = false;
                for (int v = std::max(0, y - 1); v <= std::min(size.y - 1, y + 1); ++v)
                    for (int u = std::max(0, x - 1); u <= std::min(size.x - 1, x + 1); ++u)
                        besideStep |= test::largestDifference(expected.at(u, v), expected.at(x, y)) > 0.1;
                EXPECT_TRUE(besideStep) << "pixel " << x << "," << y << " lies on no silhouette";
            }
        }
        EXPECT_LE(changed, static_cast<std::size_t>(size.x) * size.y / 10000) << "shift " << shift.x;
        EXPECT_GT(countPixels(expected, expected.at(0, 0)), 1000u) << "the background shows";
        addTableRow(shift.x > 0 ? "SceneAt5000km" : "SceneAt6400km",
                    "positions in float jitter by half a metre",
                    std::to_string(changed) + " of " + std::to_string(size.x * size.y) +
                        " pixels differ from the scene at 0, all on silhouettes");
    }
}

// From inside, every ray leaves through the ball exactly once.
TEST_F(NumericCamera, InsideTheSurfaceEveryPixelSeesItOnce) {
    const MeshId ball = upload(ballMesh(glm::dvec3(0), 1, 12));
    for (const double fov : {1.0, 60.0, 170.0}) {
        FrameDescription frame{.camera = {.eye = {16.3, 15.8, 16.1},
                                          .target = {20, 17, 18},
                                          .fovDegrees = fov,
                                          .size = {64, 48}},
                               .lighting = kUnlit};
        frame.draws.push_back({.mesh = ball, .color = kRed, .opacity = 0.5f});
        const LinearImage image = renderLinear(frame);
        // One layer of opacity 1/2 over black: exactly half of the color, or twice that much from a ray that
        // meets the seam of two triangles twice.
        EXPECT_EQ(countPixels(image, 0.5f * kRed), image.pixels.size()) << fov;
    }
    addTableRow("EyeInsideTheSurface", "the near plane cuts a hole around the eye",
                "every pixel sees the one layer, at 1, 60 and 170 degrees");
}

// The eye on the surface looks inwards: again one layer in every pixel, or none where the surface at the
// eye's own place is neither before nor behind it.
TEST_F(NumericCamera, OnTheSurfaceTheImageIsFinite) {
    const SurfaceMesh mesh = ballMesh(glm::dvec3(0), 1, 12);
    const MeshId ball = upload(mesh);
    for (const std::size_t vertex : {std::size_t{0}, mesh.vertexCount() / 2}) {
        const glm::dvec3 eye(mesh.positions[vertex]);
        FrameDescription frame{.camera = {.eye = eye, .target = {16, 16, 16}, .size = {64, 48}},
                               .background = kBlue,
                               .lighting = kUnlit};
        frame.draws.push_back({.mesh = ball, .color = kRed});
        const LinearImage image = renderLinear(frame);
        ASSERT_TRUE(isFinite(image));
        // The far side fills the view, opaque.
        EXPECT_EQ(countPixels(image, kRed), image.pixels.size());
    }
    addTableRow("EyeOnTheSurface", "division by a distance of zero",
                "finite, and the far side fills the view");
}

TEST_F(NumericCamera, EyeEqualToTargetIsRefusedWithAMessage) {
    FrameDescription frame{.camera = {.eye = {1, 2, 3}, .target = {1, 2, 3}}};
    frame.draws.push_back({.mesh = upload(ballMesh(glm::dvec3(0), 1, 12))});
    try {
        renderer_.render(frame);
        FAIL() << "a view without direction was drawn";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("eye and target coincide"), std::string::npos);
    }
    addTableRow("EyeEqualToTarget", "a direction of length zero gives NaN",
                "refused: \"eye and target coincide\"");
}

// A ball of 1e-2 before the eye and one of 1e5 around both: distances from 1e-2 to 1e5.
TEST_F(NumericCamera, NearAndFarOneToTenMillion) {
    const double small = 1e-2;
    const double large = 1e5;
    FrameDescription frame{
        .camera = {.eye = {0, 0, 0}, .target = {1, 0, 0}, .fovDegrees = 40, .size = {101, 101}},
        .lighting = kUnlit};
    // 16 steps from the middle to the lattice's end; the small ball's middle lies 2 radii away.
    const double smallStep = small / 12;
    const double largeStep = large / 12;
    frame.draws.push_back(
        {.mesh = upload(ballMesh(glm::dvec3(2 * small, 0, 0) - 16 * smallStep, smallStep, small)),
         .color = kRed});
    frame.draws.push_back(
        {.mesh = upload(ballMesh(glm::dvec3(-16 * largeStep), largeStep, large)), .color = kBlue});
    const LinearImage image = renderLinear(frame);
    // The small ball is seen under asin(1/2) = 30 degrees, more than half the view's 40 / 2 to every side but
    // less than to its corners, 27.2 degrees: it fills the image but nothing else may show through it.
    EXPECT_EQ(countPixels(image, kRed), image.pixels.size());
    // From farther back it covers the middle, and the large one everything else.
    frame.camera.eye = {-2 * small, 0, 0};
    const LinearImage both = renderLinear(frame);
    EXPECT_EQ(countPixels(both, kRed) + countPixels(both, kBlue), both.pixels.size());
    // Under asin(1/4): a disk of radius tan(14.48)/tan(20) * 50.5 = 35.8 pixels; the chord error of 12
    // samples a radius, 1/(8 * 12 * 11) of it, and half a pixel along the rim change its area by below 2 %.
    const double disk = M_PI * 35.83 * 35.83;
    EXPECT_NEAR(static_cast<double>(countPixels(both, kRed)), disk, 0.02 * disk);
    addTableRow("NearToFarOneTo1e7", "near things are cut away, or far ones lose their depth order",
                "distances from 1e-2 to 1e5 in one picture, every pixel the nearest surface");
}

TEST_F(NumericCamera, FieldsOfViewOf1And170Degrees) {
    const MeshId ball = upload(ballMesh(glm::dvec3(-16), 1, 12));
    for (const double fov : {1.0, 170.0}) {
        // So far away that the ball's rim is seen under a quarter of the angle's tangent.
        const double tangent = std::tan(fov / 360 * M_PI) / 2;
        const double distance = 12 * std::sqrt(1 + 1 / (tangent * tangent));
        FrameDescription frame{.camera = {.eye = {distance, 0, 0}, .fovDegrees = fov, .size = {200, 200}},
                               .lighting = kUnlit};
        frame.draws.push_back({.mesh = ball, .color = kRed});
        const LinearImage image = renderLinear(frame);
        // A disk of half the image's height: radius 50 pixels. Chords lie inside the ball by up to 1/1056 of
        // its radius; where the eye is close, at 170 degrees, that takes 3 % of the disk's radius. Counting
        // pixels may err by 1 % of the area, a quarter of those that the rim passes through.
        const double chordRadius = 12 * (1 - 1.0 / 1056);
        const double chordTangent = chordRadius / std::sqrt(distance * distance - chordRadius * chordRadius);
        const double disk = M_PI * 50 * 50;
        const double shrunk = disk * std::pow(chordTangent / tangent, 2);
        const auto count = static_cast<double>(countPixels(image, kRed));
        EXPECT_GT(count, shrunk - 0.01 * disk) << fov;
        EXPECT_LT(count, 1.01 * disk) << fov;
    }
    addTableRow("FieldsOfView1And170", "tangents overflow, silhouettes tear",
                "the ball's disk as computed, both");
}

TEST_F(NumericCamera, WindowsOf1x1And8192x1) {
    const MeshId ball = upload(ballMesh(glm::dvec3(-16), 1, 12));
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(8192, 1), glm::ivec2(1, 8192)}) {
        for (const float opacity : {1.0f, 0.5f}) {
            // So close that the ball covers 0.8 pixels around the middle of a window that is one pixel high:
            // 12 / sqrt(30^2 - 12^2) / (2 tan 15). The middle of an even number lies between two pixels.
            FrameDescription frame{.camera = {.eye = {30, 0, 0}, .fovDegrees = 30, .size = size},
                                   .lighting = kUnlit};
            frame.draws.push_back({.mesh = ball, .color = kRed, .opacity = opacity});
            const LinearImage image = renderLinear(frame);
            ASSERT_EQ(image.pixels.size(), static_cast<std::size_t>(size.x) * size.y);
            ASSERT_TRUE(isFinite(image));
            // The middle looks at the ball: opaque, or two layers of 1/2 of which the first adds 1/2 and the
            // second the other half, or the 4-pass sum with both.
            EXPECT_EQ(image.at(size.x / 2, size.y / 2).r, 1.0f) << size.x << "x" << size.y << " " << opacity;
        }
    }
    addTableRow("WindowsOf1x1And8192x1", "an aspect of 8192 or a size of one breaks targets or projection",
                "drawn, finite, the ball where it is");
}

}  // namespace
}  // namespace isoglass::numeric
