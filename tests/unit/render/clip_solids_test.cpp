// Volumes clipped by boxes, spheres and cylinders against the exact intervals of each ray, in double
// precision.

#include "base/error.h"
#include "clip_reference.h"
#include "layer_fixture.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace isoglass::test {
namespace {

constexpr glm::vec3 kColor(0.8f, 0.4f, 0.2f), kBackground(0.1f, 0.2f, 0.3f);
/// Light ends where less than half a step of 8 bits comes through; ways are sums of up to 256 numbers of
/// single precision.
constexpr double kEarly = 0.5 / (255 * 12.92), kRounding = 256 * 0x1p-23;
/// Places in a solid's coordinates, up to 16 large, are off by up to 2^-19 of them; the way that a ray has in
/// a ball of radius R, 2 R sqrt(1 - d^2), is then off by 2 R sqrt(2^-18 * 16), a unit is 1/2 long and lets
/// half of the light through.
constexpr double kGrazing = 2 * std::sqrt(0x1p-14) / 0.5 * M_LN2;

/// An even medium, so that light tells how long the visible way is.
class ClipSolids : public VolumeTest {
  protected:
    void SetUp() override {
        VolumeTest::SetUp();
        frame_.background = kBackground;
        frame_.shadedDraw.emplace();
        frame_.shadedDraw->style = {
            .colors = {{0, kColor}}, .opacities = {{0, 0.5f}}, .unit = 0.5, .lit = false};
        setLattice({17, 9, 23});
        upload(sampled([](const glm::dvec3&) { return 1; }));
    }

    VolumeDraw& volume() override { return *frame_.shadedDraw; }
    std::vector<SolidClip>& solids() { return volume().solids; }
    Ray rayOf(int x, int y) const { return pixelRay(frame_.camera, x + 0.5, y + 0.5); }

    /// Compares every pixel; returns the largest number of parts that a ray has.
    std::size_t expectExact(const std::string& what) {
        const LinearImage image = renderLinear(frame_);
        std::size_t most = 0;
        double largest = 0;
        forEachPixel([&](int x, int y, std::size_t at) {
            const std::vector<Interval> parts = visibleParts(solids(), rayOf(x, y));
            double way = 0;
            for (const Interval& part : parts) way += part.end - part.begin;
            const glm::dvec3 right =
                glm::mix(glm::dvec3(kColor), glm::dvec3(kBackground), std::exp2(-way / 0.5));
            largest = std::max(largest, largestDifference(image.pixels[at], right));
            most = std::max(most, parts.size());
        });
        EXPECT_LT(largest, kEarly + kRounding + kGrazing) << what;
        return most;
    }

    /// What comes through at each pixel.
    std::vector<double> transmittance() {
        std::vector<double> through;
        for (const glm::vec3& pixel : renderLinear(frame_).pixels)
            through.push_back((pixel.x - double{kColor.x}) / (double{kBackground.x} - double{kColor.x}));
        return through;
    }
};

constexpr SolidShape kShapes[] = {SolidShape::box, SolidShape::sphere, SolidShape::cylinder};

TEST_F(ClipSolids, EveryShapeKeepsAndCutsWhatIsInIt) {
    for (const SolidShape shape : kShapes) {
        for (const Keep keep : {Keep::inside, Keep::outside}) {
            const std::string what =
                std::to_string(static_cast<int>(shape)) + (keep == Keep::inside ? " inside" : " outside");
            solids() = {{shape, keep, placed({0.2, -0.1, 0.1}, glm::dvec3(0.6))}};
            expectExact(what);
            solids() = {{shape, keep, placed({0.1, 0.3, -0.2}, {0.9, -0.3, 0.5}, 130)}};
            expectExact(what + ", turned, stretched and mirrored");
            solids() = {{shape, keep, placed({0.7, 0.8, 0.9}, glm::dvec3(0.7), 20)}};
            expectExact(what + ", reaching out of the volume");
        }
    }
}

TEST_F(ClipSolids, TheCameraMayBeAnywhere) {
    for (const SolidShape shape : kShapes) {
        for (const Keep keep : {Keep::inside, Keep::outside}) {
            solids() = {{shape, keep, placed({0, 0.1, 0}, glm::dvec3(0.5), 35)}};
            frame_.camera.eye = {0.1, 0.2, 0.15};
            frame_.camera.target = {-1, 0.3, 0.2};
            expectExact("in the solid");
            frame_.camera.eye = {-0.9, 0.8, 0.7};
            frame_.camera.target = {-3, 3, 2};
            expectExact("solid behind the camera");
            solids() = {{shape, keep, placed({0, 0, 0}, glm::dvec3(10))}};
            frame_.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 30, .size = {48, 40}};
            expectExact("solid larger than the view");
        }
    }
}

/// Faces in the domain's faces, and close to rays along them; a ray in a face may go either way.
TEST_F(ClipSolids, TouchingFacesAreExact) {
    frame_.camera = {.eye = {0, -5, 0}, .fovDegrees = 30, .size = {40, 40}};
    for (const Keep keep : {Keep::inside, Keep::outside}) {
        solids() = {{SolidShape::box, keep, placed({0, 0, 0}, glm::dvec3(1))}};
        expectExact("the domain");
        solids() = {{SolidShape::box, keep, placed({-0.5, 0, 0}, {0.5, 1, 1})}};
        expectExact("half of the domain");
        solids() = {{SolidShape::box, Keep::outside, placed({0, -0.5, 0}, {0.5, 0.25, 0.5})},
                    {SolidShape::box, Keep::outside, placed({0, 0, 0}, {0.5, 0.25, 0.5})}};
        expectExact("two that touch");
    }
}

/// A comb of five teeth: a concave object, six intervals on a ray; in any order.
TEST_F(ClipSolids, SeveralSolidsClipTogether) {
    frame_.camera = {.eye = {5, 1.2, 1.5}, .fovDegrees = 24, .size = {48, 40}};
    solids() = {{SolidShape::sphere, Keep::inside, placed({0, 0, 0}, glm::dvec3(1.2))}};
    for (const double x : {0.8, -0.8, 0.0, 0.4, -0.4})
        solids().push_back({SolidShape::box, Keep::outside, placed({x, 0, 0}, {0.1, 0.9, 0.9})});
    EXPECT_EQ(expectExact("comb"), 6u);
    // Some overlap, one lies in another.
    solids() = {{SolidShape::sphere, Keep::outside, placed({0.3, 0, 0}, glm::dvec3(0.4))},
                {SolidShape::cylinder, Keep::outside, placed({0.1, 0, 0}, {0.2, 0.2, 2}, 70)},
                {SolidShape::box, Keep::outside, placed({-0.3, 0.1, 0}, glm::dvec3(0.4), 15)},
                {SolidShape::sphere, Keep::outside, placed({0.3, 0, 0}, glm::dvec3(0.2))},
                {SolidShape::box, Keep::inside, placed({0, 0, 0}, glm::dvec3(0.9), 10)}};
    EXPECT_GE(expectExact("overlapping"), 2u);
}

/// What probing and cutting let through makes, together, what the whole volume does.
TEST_F(ClipSolids, ProbingAndCuttingAreComplementary) {
    const std::vector<double> whole = transmittance();
    for (const SolidShape shape : kShapes) {
        const glm::dmat4 place = placed({0.1, 0.2, -0.1}, {0.7, 0.5, 0.6}, 50);
        solids() = {{shape, Keep::inside, place}};
        const std::vector<double> probed = transmittance();
        solids() = {{shape, Keep::outside, place}};
        const std::vector<double> cut = transmittance();
        for (std::size_t i = 0; i < whole.size(); ++i) {
            // Three pictures of single precision, whose contrast is 0.7, and rays that end early.
            EXPECT_NEAR(probed[i] * cut[i], whole[i], kEarly + 8 * kRounding / 0.7) << i;
        }
    }
}

/// Steps begin at every cut: with the step the picture converges.
TEST_F(ClipSolids, ConvergesAsTheStepGoesToZero) {
    VolumeStyle& style = frame_.shadedDraw->style;
    setLattice({17, 17, 17});
    upload(sampled([](const glm::dvec3& p) { return glm::dot(p, {0.5, 0.3, 0.2}); }));
    style.colors = {{-1, {1, 0, 0}}, {1, {0, 0, 1}}};
    style.opacities = {{-1, 0.1f}, {1, 0.4f}};
    solids() = {{SolidShape::sphere, Keep::outside, placed({0.3, 0.3, 0.3}, glm::dvec3(0.6))},
                {SolidShape::cylinder, Keep::inside, placed({0, 0, 0}, {0.9, 0.8, 0.9}, 30)}};
    const auto picture = [&](double step) {
        style.step = step;
        return renderLinear(frame_);
    };
    double before = kInfinity;
    LinearImage coarse = picture(2);
    for (const double step : {1.0, 0.5, 0.25, 0.125}) {
        const LinearImage fine = picture(step);
        double sum = 0;
        for (std::size_t i = 0; i < fine.pixels.size(); ++i)
            sum += largestDifference(fine.pixels[i], glm::dvec3(coarse.pixels[i]));
        EXPECT_LT(sum, 0.5 * before) << step;
        before = sum;
        coarse = fine;
    }
}

TEST_F(ClipSolids, FollowThePlacementOfTheVolume) {
    solids() = {{SolidShape::cylinder, Keep::outside, placed({0.2, 0.1, 0}, {0.4, 0.3, 0.7}, 40)}};
    const LinearImage right = renderLinear(frame_);
    // Descending axes, a hundred thousand away: the same samples, the same picture.
    const glm::dvec3 away(1e5, -2e5, 3e5);
    for (auto& axis : volume().axes) std::ranges::reverse(axis);
    volume().worldFromSeries = glm::translate(glm::dmat4(1), away);
    frame_.camera.eye += away;
    frame_.camera.target += away;
    const LinearImage moved = renderLinear(frame_);
    // The camera's own place is rounded to 2^-35 there.
    for (std::size_t i = 0; i < right.pixels.size(); ++i)
        EXPECT_LE(largestDifference(moved.pixels[i], glm::dvec3(right.pixels[i])), kRounding + kGrazing) << i;
}

TEST_F(ClipSolids, TooManyAreRefused) {
    solids().assign(kMostSolids, {});
    EXPECT_NO_THROW(renderer_.render(frame_));
    solids().assign(kMostSolids + 1, {});
    EXPECT_THROW(renderer_.render(frame_), Error);
}

/// The surface x = 0 of a field that is linear: a ray meets it once, where solids leave it.
TEST_F(LayerTest, SolidsClipLayers) {
    setLattice({21, 17, 19});
    upload(sampled([](const glm::dvec3& p) { return p.x; }));
    draw().style.count = 1;
    volume().solids = {{SolidShape::sphere, Keep::outside, placed({0.1, 0.3, 0.2}, glm::dvec3(0.5))},
                       {SolidShape::box, Keep::inside, placed({0, 0, 0}, {0.5, 0.8, 0.8}, 20)}};
    const LinearImage image = measure();
    int met = 0, hidden = 0;
    forEachPixel([&](int x, int y, std::size_t at) {
        const Ray ray = pixelRay(frame_.camera, x + 0.5, y + 0.5);
        const double t = -ray.origin.x / ray.direction.x;
        const std::vector<Interval> parts = visibleParts(volume().solids, ray);
        // The rounding of places, many times over; at the boundaries either answer is right.
        constexpr double kSafe = 1e-3;
        const bool close = std::ranges::any_of(parts, [&](const Interval& part) {
            return std::min(std::abs(t - part.begin), std::abs(t - part.end)) < kSafe;
        });
        if (close) return;
        const bool visible = std::ranges::any_of(parts, [&](const Interval& part) { return part.holds(t); });
        EXPECT_EQ(image.pixels[at].y, visible ? 1 : 0) << x << ", " << y;
        (visible ? met : hidden) += 1;
    });
    EXPECT_GT(met, 50);
    EXPECT_GT(hidden, 50);
}

}  // namespace
}  // namespace isoglass::test
