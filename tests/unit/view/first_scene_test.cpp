#include "app/view/first_scene.h"

#include "base/error.h"
#include "render/camera.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isoglass {
namespace {

TEST(SuggestIsoValues, TakesSharesOfTheSamples) {
    std::vector<float> samples(1001);
    std::iota(samples.begin(), samples.end(), 0.0f);
    std::ranges::reverse(samples);
    const IsoSuggestion suggestion = suggestIsoValues(samples);
    ASSERT_EQ(suggestion.values.size(), 2u);
    EXPECT_FALSE(suggestion.background);
    EXPECT_EQ(suggestion.values[0].iso, 800);
    EXPECT_NEAR(suggestion.values[0].share, 201.0 / 1001, 1e-15);
    EXPECT_EQ(suggestion.values[1].iso, 300);
    EXPECT_NEAR(suggestion.values[1].share, 701.0 / 1001, 1e-15);
}

TEST(SuggestIsoValues, LeavesOutABackground) {
    std::vector<float> samples(5000, 0.0f);
    for (int i = 1; i <= 1001; ++i) samples.push_back(static_cast<float>(i));
    const IsoSuggestion suggestion = suggestIsoValues(samples);
    EXPECT_EQ(suggestion.background, 0.0);
    ASSERT_EQ(suggestion.values.size(), 2u);
    EXPECT_EQ(suggestion.values[0].iso, 801);
    EXPECT_EQ(suggestion.values[1].iso, 301);
}

TEST(SuggestIsoValues, AMaskIsCutInTheMiddle) {
    const std::vector<float> mask{0, 0, 0, 1, 0, 1};
    const IsoSuggestion suggestion = suggestIsoValues(mask);
    ASSERT_EQ(suggestion.values.size(), 1u);
    EXPECT_EQ(suggestion.values[0].iso, 0.5);
    EXPECT_EQ(suggestion.values[0].share, 1);
}

TEST(SuggestIsoValues, NeverTheLowestSampleForThereEverythingIsInside) {
    // Half the samples are the lowest, but they are not counted as background: another value is as frequent.
    std::vector<float> samples(400, 1.0f);
    samples.insert(samples.end(), 500, 2.0f);
    samples.insert(samples.end(), 100, 3.0f);
    for (const SuggestedIso& value : suggestIsoValues(samples).values) EXPECT_GT(value.iso, 1);
}

TEST(SuggestIsoValues, NothingWhereAllSamplesAreTheSame) {
    EXPECT_TRUE(suggestIsoValues({}).values.empty());
    EXPECT_TRUE(suggestIsoValues({4, 4, 4}).values.empty());
}

class FirstSceneTest : public testing::Test {
  protected:
    ScratchFolder folder_;

    SeriesFile write(SeriesDescription description, const AnalyticField& field) const {
        std::vector<std::vector<float>> frames;
        for (const double time : description.time.times) {
            frames.push_back(sampleField(description.lattice, field, time));
        }
        test::MemorySource source(std::move(description), std::move(frames));
        const auto path = folder_ / "series.vdb";
        writeSeries(source, path);
        return SeriesFile(path);
    }
};

TEST_F(FirstSceneTest, ShowsTheWholeDomainAndEveryKeyFrame) {
    const SeriesFile file = write(test::describe(makeUnitLattice(17), 11),
                                  [](glm::dvec3 at, double time) { return blobs(at, time / 20); });
    const FirstScene first = makeFirstScene(file, {400, 300});
    const Scene& scene = first.scene;
    ASSERT_EQ(scene.volumes.size(), 1u);
    EXPECT_EQ(scene.volumes[0].series, file.path());
    ASSERT_EQ(scene.volumes[0].surfaces.size(), 2u);
    EXPECT_TRUE(scene.volumes[0].surfaces[0].opaque());
    EXPECT_FALSE(scene.volumes[0].surfaces[1].opaque());
    EXPECT_LT(scene.volumes[0].surfaces[1].iso, scene.volumes[0].surfaces[0].iso);
    EXPECT_EQ(std::get<double>(scene.time.from), 0);
    EXPECT_EQ(std::get<double>(scene.time.to), 10);
    EXPECT_EQ(scene.time.duration, 5) << "half a second for each of 10 steps";
    EXPECT_EQ(scene.image.size, glm::ivec2(400, 300));
    EXPECT_EQ(scene.camera.pose.target, glm::dvec3(0));
    EXPECT_EQ(first.reasons.size(), 2u) << "a reason for each surface";
}

TEST_F(FirstSceneTest, HeightInOtherUnitsIsScaledAndSaid) {
    SeriesDescription description = test::describe(makeUniformLattice({9, 9, 9}, {0, 0, 0}, {5, 5, 1000}), 1);
    description.lattice.axes[0].units = description.lattice.axes[1].units = "degrees";
    description.lattice.axes[2].units = "m";
    const SeriesFile file =
        write(description, [](glm::dvec3 at, double) { return static_cast<float>(at.x + at.z); });
    const FirstScene first = makeFirstScene(file, {400, 300});
    EXPECT_DOUBLE_EQ(first.scene.volumes[0].place.scale.z, 40.0 / 3 / 8000);
    EXPECT_EQ(first.scene.volumes[0].place.scale.x, 1);
    EXPECT_EQ(first.scene.time.duration, 0) << "one key frame is a still";
    ASSERT_FALSE(first.reasons.empty());
    EXPECT_NE(first.reasons[0].find("height is scaled"), std::string::npos);
}

TEST_F(FirstSceneTest, AConstantMiddleIsNotWhatSurfacesAreChosenFrom) {
    const SeriesFile file = write(test::describe(makeUnitLattice(9), 3), [](glm::dvec3 at, double time) {
        return time == 1 ? 0.0f : static_cast<float>(at.x * (time + 1));
    });
    const FirstScene first = makeFirstScene(file, {400, 300});
    EXPECT_GT(first.scene.volumes[0].surfaces[0].iso, 1) << "only key frame 2 reaches that";
}

TEST_F(FirstSceneTest, AConstantSeriesIsRefusedWithAHint) {
    const SeriesFile file =
        write(test::describe(makeUnitLattice(9), 1), [](glm::dvec3, double) { return 3.0f; });
    EXPECT_THROW(makeFirstScene(file, {400, 300}), Error);
}

}  // namespace
}  // namespace isoglass
