#include "formats/medical_images.h"
#include "mesh/mesh_check.h"
#include "surface/extract.h"
#include "unit/formats/small_files.h"
#include "volume/series_file.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isoglass {

namespace {

using test::expectWorldValues;
using test::failsWith;
using test::hasNote;
using test::SmallArray;
using test::write;

/// All 48 ways in which the axes of an array may lie along those of the world.
std::vector<AffinePlace> axisAlignedPlaces() {
    std::vector<AffinePlace> places;
    std::array<int, 3> order{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            AffinePlace place{{3, -2, 1}, {}};
            for (int i = 0; i < 3; ++i) {
                place.steps[static_cast<std::size_t>(i)] = glm::dvec3(0);
                // Steps of 1, 2 and 4: whole, so that every value is.
                place.steps[static_cast<std::size_t>(i)][order[static_cast<std::size_t>(i)]] =
                    (signs >> i & 1 ? -1 : 1) * (1 << i);
            }
            places.push_back(place);
        }
    } while (std::ranges::next_permutation(order).found);
    return places;
}

TEST(Orientation, EverySampleOfEveryFormatIsWhereTheFileSaysItIs) {
    const ScratchFolder folder;
    for (const AffinePlace& place : axisAlignedPlaces()) {
        const SmallArray array{.place = place};
        write(folder / "a.nii", test::niftiBytes(array));
        expectWorldValues(*openNifti(folder / "a.nii", ""));
        write(folder / "a.nrrd", test::nrrdBytes(array, test::nrrdDirections(array) + "space: RAS\n"));
        expectWorldValues(*openNrrd(folder / "a.nrrd", ""));
        write(folder / "a.mha", test::metaImageBytes(array));
        expectWorldValues(*openMetaImage(folder / "a.mha", ""));
    }
}

/// A ball of radius 3 that is heavier on one side: f falls away from its middle.
double ball(const glm::dvec3& p) {
    return 3 - glm::length(p - glm::dvec3(0.2, 0.1, -0.3)) + 0.2 * p.x;
}

// Whatever the file's axes, the volume inside is positive: the triangles turn outwards.
TEST(Orientation, TrianglesTurnOutwardsForEveryOrderAndDirectionOfTheAxes) {
    constexpr int kSide = 11;
    for (AffinePlace place : axisAlignedPlaces()) {
        for (glm::dvec3& step : place.steps) step = glm::normalize(step);
        place.origin = -5.0 * (place.steps[0] + place.steps[1] + place.steps[2]);
        const OrientedAxes axes = orient(place, {kSide, kSide, kSide}, "test");
        std::vector<float> samples;
        for (const double z : axes.lattice.axes[2].coordinates)
            for (const double y : axes.lattice.axes[1].coordinates)
                for (const double x : axes.lattice.axes[0].coordinates)
                    samples.push_back(static_cast<float>(ball({x, y, z})));
        const Extraction result = extractSurface(
            axes.lattice, {.a = makeKeyFrame(axes.lattice, samples), .b = {}, .fraction = 0}, {.iso = 0});
        ASSERT_TRUE(checkTopology(result.mesh).isOrientedManifold());
        ASSERT_TRUE(checkTopology(result.mesh).isClosed());
        // A ball of radius 3 holds 113; the tilt of f and the chords change it by much less than a half.
        EXPECT_GT(measure(result.mesh).volume, 60);
        EXPECT_LT(measure(result.mesh).volume, 170);
    }
}

TEST(Orientation, MirroredArraysStayMirrored) {
    // Steps (1,0,0), (0,-2,0), (0,0,4): a left-handed array, as many scanners write.
    const OrientedAxes axes =
        orient({{0, 0, 0}, {glm::dvec3{1, 0, 0}, {0, -2, 0}, {0, 0, 4}}}, {5, 4, 3}, "test");
    EXPECT_TRUE(axes.lattice.mirrored());
    EXPECT_TRUE(axes.lattice.axes[1].descending());
    EXPECT_TRUE(axes.notes.empty());
}

TEST(Orientation, ReorderedAxesAreNoted) {
    const OrientedAxes axes =
        orient({{0, 0, 0}, {glm::dvec3{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, {5, 4, 3}, "test");
    EXPECT_EQ(axes.axes, (std::array<std::size_t, 3>{2, 0, 1}));
    ASSERT_EQ(axes.notes.size(), 1u);
    EXPECT_NE(axes.notes[0].find("axes 3, 1, 2"), std::string::npos) << axes.notes[0];
}

/// The numbers in the brackets after `key` in a note.
std::vector<double> numbersAfter(const std::string& note, const std::string& key) {
    std::istringstream text(note.substr(note.find('[', note.find(key)) + 1));
    std::vector<double> numbers;
    for (double number; text >> number; text.ignore()) numbers.push_back(number);
    return numbers;
}

TEST(Orientation, PlaceOfAnObliqueVolumeBringsEverySampleHome) {
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1), glm::radians(25.0), glm::normalize(glm::dvec3(1, -2, 0.5)));
    const AffinePlace place{
        {10, 20, -5}, {glm::dvec3(turn[1]) * 2.0, glm::dvec3(turn[0]) * -1.0, glm::dvec3(turn[2]) * 4.0}};
    const std::array<std::uint64_t, 3> lengths{5, 4, 3};
    const OrientedAxes axes = orient(place, lengths, "test");
    const std::string& note = axes.notes.back();
    const auto translate = numbersAfter(note, "translate"), rotate = numbersAfter(note, "rotate");
    ASSERT_EQ(translate.size(), 3u) << note;
    ASSERT_EQ(rotate.size(), 4u) << note;
    const glm::dmat4 scene =
        glm::rotate(glm::dmat4(1), glm::radians(rotate[3]), {rotate[0], rotate[1], rotate[2]});
    for (std::size_t i = 0; i < 3; ++i) {
        glm::dvec3 index(0);
        index[static_cast<int>(i)] = static_cast<double>(lengths[i] - 1);
        const glm::dvec3 wanted =
            place.origin + index.x * place.steps[0] + index.y * place.steps[1] + index.z * place.steps[2];
        glm::dvec3 kept;
        for (int world = 0; world < 3; ++world)
            kept[world] =
                axes.lattice.axes[static_cast<std::size_t>(world)].coordinate(static_cast<std::size_t>(
                    index[static_cast<int>(axes.axes[static_cast<std::size_t>(world)])]));
        const glm::dvec3 placed =
            glm::dvec3(scene * glm::dvec4(kept, 1)) + glm::dvec3(translate[0], translate[1], translate[2]);
        // The note has nine digits of numbers below 30.
        EXPECT_LT(glm::length(placed - wanted), 1e-6) << note;
    }
}

TEST(Orientation, WhatAxesCannotHoldIsRefused) {
    const double nan = std::nan("");
    EXPECT_TRUE(failsWith(
        [] {
            orient({{0, 0, 0}, {glm::dvec3{1, 0, 0}, {0.5, 1, 0}, {0, 0, 1}}}, {5, 4, 3}, "f");
        },
        {"sheared", "f"}));
    EXPECT_TRUE(failsWith(
        [] {
            orient({{0, 0, 0}, {glm::dvec3{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {5, 4, 3}, "f");
        },
        {"makes no sense", "f"}));
    EXPECT_TRUE(failsWith(
        [&] {
            orient({{nan, 0, 0}, {glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {5, 4, 3}, "f");
        },
        {"makes no sense", "f"}));
    EXPECT_TRUE(failsWith(
        [] {
            orient({{1e30, 0, 0}, {glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {5, 4, 3}, "f");
        },
        {"lost beside the origin", "f"}));
}

}  // namespace

}  // namespace isoglass
