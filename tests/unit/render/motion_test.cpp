#include "surface/motion.h"

#include "render_fixture.h"

namespace isoglass::test {
namespace {

constexpr TransparencyMethod kEveryMethod[] = {TransparencyMethod::twoPass, TransparencyMethod::threePass,
                                               TransparencyMethod::fourPass, TransparencyMethod::peel,
                                               TransparencyMethod::exact};

/// A half transparent sphere that grows and slides along x, in a box that holds it wherever it moves.
class MotionTest : public RenderTest {
  protected:
    SurfaceMesh still() const { return sphere({0, 0, 0}, 1, 12); }

    SurfaceMesh moving() const {
        SurfaceMesh mesh = still();
        for (const glm::vec3& normal : mesh.normals) mesh.velocities.push_back(normal + glm::vec3(1, 0, 0));
        return mesh;
    }

    LinearImage picture(const SurfaceMesh& mesh, TransparencyMethod method, float motion, float limit) {
        FrameDescription frame{.camera = fromAbove(10, {64, 64}), .background = {0.1f, 0.3f, 0.7f}};
        frame.method = method;
        show(frame, {{mesh,
                      {.color = {1, 0.5f, 0.25f},
                       .opacity = 0.5f,
                       .boundsSeries = Bounds{glm::dvec3(-3), glm::dvec3(3)},
                       .motion = motion,
                       .motionLimit = limit}}});
        return renderLinear(frame);
    }
};

TEST_F(MotionTest, PicturesOfMeshesThatDoNotMoveKeepTheirBytes) {
    for (const TransparencyMethod method : kEveryMethod) {
        const LinearImage expected = picture(still(), method, 0, 0);
        EXPECT_EQ(picture(still(), method, 0.25f, 3), expected) << "no velocities";
        EXPECT_EQ(picture(moving(), method, 0, 3), expected) << "no motion";
        EXPECT_NE(picture(moving(), method, 0.25f, 3), expected);
    }
}

// A quarter of a velocity is exact, so the sum is rounded once, here as there: every pass of a method sees
// the vertices where displacement() puts them.
TEST_F(MotionTest, PicturesAreThoseOfTheMovedMesh) {
    SurfaceMesh moved = still();
    const SurfaceMesh mesh = moving();
    for (std::size_t i = 0; i < moved.vertexCount(); ++i)
        moved.positions[i] += displacement(mesh.velocities[i], 0.25f, 3);
    for (const TransparencyMethod method : kEveryMethod)
        EXPECT_EQ(picture(mesh, method, 0.25f, 3), picture(moved, method, 0, 0));
}

TEST_F(MotionTest, StopsAtTheLimit) {
    SurfaceMesh far = still();
    far.velocities.assign(far.vertexCount(), {8, 0, 0});
    SurfaceMesh moved = still();
    for (glm::vec3& position : moved.positions) position.x += 0.5f;
    const TransparencyMethod method = TransparencyMethod::exact;
    EXPECT_EQ(picture(far, method, 0.25f, 0.5f), picture(moved, method, 0, 0));
}

}  // namespace
}  // namespace isoglass::test
