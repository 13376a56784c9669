// The viewer as its users have it: a window, real keys and mouse events, pictures that it saves.

#include "app/app_test.h"
#include "app/desktop.h"
#include "app/running_program.h"
#include "render/png_file.h"
#include "threads/eventually.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <unistd.h>

#include <cmath>
#include <optional>

namespace isoglass::test {
namespace {

constexpr glm::ivec2 kSize{240, 180};
constexpr Rgba8 kBackground{0x10, 0x14, 0x18, 255};

/// An uneven shape that moves, so that every view and every moment of it looks different.
float movingBlobs(glm::dvec3 at, double time) {
    return blobs(at - glm::dvec3(0.12 * time, 0, 0), 0.3 * time);
}

/// Other programs need the processor meanwhile.
template <typename Claim>
bool soon(const Claim& claim) {
    return eventually([&] {
        if (claim()) return true;
        ::usleep(5000);
        return false;
    });
}

class ViewWindowTest : public AppTest {
  protected:
    std::optional<Desktop> desktop_;
    std::optional<RunningProgram> viewer_;
    unsigned long window_ = 0;

    void SetUp() override {
        if (!canMakeDesktop()) GTEST_SKIP() << "no Xvfb or no xdotool";
        desktop_.emplace();
        writeBlobs("blobs.vdb", movingBlobs, 4);
        std::ofstream(folder_ / "scene.json") << R"({"version": 1,
            "volumes": [{"series": "blobs.vdb", "surfaces": [
                {"iso": 0.7, "color": "#e04030"}, {"iso": 0.35, "color": "#3060e0", "opacity": 0.4}]}],
            "time": {"from": 0, "to": 3, "duration": 2.4, "fps": 25},
            "camera": {"eye": [3, -4, 2], "target": [0.1, 0, 0]},
            "image": {"size": [240, 180]}})";
    }

    void writeBlobs(const std::string& name, const AnalyticField& field, std::size_t count) const {
        SeriesDescription description = describe(makeUnitLattice(25), count);
        description.name = "blobs";
        std::vector<std::vector<float>> frames;
        for (const double time : description.time.times) {
            frames.push_back(sampleField(description.lattice, field, time));
        }
        MemorySource source(std::move(description), std::move(frames));
        writeSeries(source, folder_ / name);
    }

    void view(const std::vector<std::string>& arguments) {
        std::vector<std::string> all{"view"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        viewer_.emplace(ISOGLASS_PROGRAM, all,
                        RunOptions{.folder = folder_.path(), .environment = {"DISPLAY=" + desktop_->name()}});
        window_ = desktop_->waitForWindow("IsoGlass");
        desktop_->xdotool({"mousemove", "120", "90"});
    }

    void key(const std::string& name) const { desktop_->xdotool({"key", name}); }

    /// What `s` saves. Without a step or a mesh on its way this is what the window shows.
    Image shot() {
        const std::size_t before = viewer_->outLines().size();
        key("s");
        EXPECT_TRUE(soon([&] { return viewer_->outLines().size() > before; })) << viewer_->err();
        const std::string name = viewer_->outLines().back();
        std::filesystem::copy(folder_ / name,
                              picturesFolder() / (testName() + "-" + std::to_string(before) + ".png"),
                              std::filesystem::copy_options::overwrite_existing);
        return readPng(folder_ / name);
    }

    /// The frame as `isoglass render` makes it.
    Image rendered(int frame, const std::string& scene = "scene.json") const {
        const std::string number = std::to_string(frame);
        run({"render", scene, "-o", "rendered.png", "--frames", number + ":" + number});
        return readPng(folder_ / "rendered.png");
    }

    void drag(const std::string& button, std::initializer_list<glm::ivec2> places) const {
        std::vector<std::string> arguments;
        for (const glm::ivec2 place : places) {
            arguments.insert(arguments.end(),
                             {"mousemove", std::to_string(place.x), std::to_string(place.y)});
            if (arguments.size() == 3) arguments.insert(arguments.end(), {"mousedown", button});
        }
        arguments.insert(arguments.end(), {"mouseup", button});
        desktop_->xdotool(arguments);
    }

    /// Whether the window shows that picture, now or soon.
    bool showsSoon(const Image& image) {
        return soon([&] { return desktop_->picture(window_).pixels == image.pixels; });
    }

    int quit(const std::string& name) {
        key(name);
        return viewer_->wait();
    }

    /// Where the pictures stay, to be looked at.
    static std::filesystem::path picturesFolder() {
        std::filesystem::path folder = ISOGLASS_PICTURES_FOLDER;
        std::filesystem::create_directories(folder);
        return folder;
    }

    static std::string testName() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
};

bool lit(const Rgba8& pixel) {
    return !(pixel == kBackground);
}

int litCount(const Image& image) {
    return static_cast<int>(std::ranges::count_if(image.pixels, lit));
}

/// Mean place of what is not background.
glm::dvec2 middleOfLit(const Image& image) {
    glm::dvec2 sum(0);
    for (int y = 0; y < image.size.y; ++y) {
        for (int x = 0; x < image.size.x; ++x) {
            if (lit(image.at(x, y))) sum += glm::dvec2(x, y);
        }
    }
    return sum / static_cast<double>(litCount(image));
}

double changedShare(const Image& a, const Image& b) {
    if (a.size != b.size) return 1;
    int changed = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) changed += !(a.pixels[i] == b.pixels[i]);
    return changed / static_cast<double>(a.pixels.size());
}

TEST_F(ViewWindowTest, FirstPictureIsThatOfRenderAndIsInTheWindow) {
    view({"scene.json"});
    const Image first = shot();
    EXPECT_EQ(first.size, kSize);
    EXPECT_EQ(first.pixels, rendered(0).pixels);
    EXPECT_GT(litCount(first), 1000) << "there is something to see";
    key("x");  // takes away the notice that a picture was saved
    EXPECT_TRUE(showsSoon(first));
    EXPECT_EQ(quit("q"), 0) << viewer_->err();
}

TEST_F(ViewWindowTest, ArrowsStepKeyFramesAndDisplayedFrames) {
    view({"scene.json"});
    const Image first = shot();
    key("Right");
    const Image second = shot();
    EXPECT_GT(changedShare(first, second), 0.02);
    EXPECT_EQ(second.pixels, rendered(20).pixels) << "key frame 1 of 3 is displayed frame 20 of 60";
    key("shift+Right");
    EXPECT_EQ(shot().pixels, rendered(21).pixels);
    key("Left");
    EXPECT_EQ(shot().pixels, second.pixels);
    key("Left");
    EXPECT_EQ(shot().pixels, first.pixels);
    EXPECT_TRUE(soon([&] { return contains(desktop_->title(window_), "scene  0  (paused)"); }))
        << desktop_->title(window_);
    EXPECT_EQ(quit("Escape"), 0) << viewer_->err();
}

TEST_F(ViewWindowTest, DragsAndWheelMoveTheCameraAndHomeBringsItBack) {
    view({"scene.json"});
    const Image first = shot();
    drag("1", {{100, 90}, {140, 70}, {100, 90}});
    EXPECT_EQ(shot().pixels, first.pixels) << "a drag that comes back";
    drag("1", {{100, 90}, {160, 60}});
    const Image turned = shot();
    EXPECT_GT(changedShare(first, turned), 0.05);
    EXPECT_LT(glm::distance(middleOfLit(first), middleOfLit(turned)), 25) << "it turns about the middle";
    key("Home");
    EXPECT_EQ(shot().pixels, first.pixels);

    for (const std::string button : {"2", "3"}) {
        drag(button, {{100, 90}, {130, 100}});
        const glm::dvec2 way = middleOfLit(shot()) - middleOfLit(first);
        // Perspective and the picture's edge let the middle of the shape follow the cursor only roughly.
        EXPECT_NEAR(way.x, 30, 6) << "button " << button;
        EXPECT_NEAR(way.y, 10, 6) << "button " << button;
        key("Home");
        EXPECT_EQ(shot().pixels, first.pixels);
    }

    desktop_->xdotool({"mousemove", "120", "90", "click", "--repeat", "3", "5"});
    const Image away = shot();
    EXPECT_LT(litCount(away), 0.6 * litCount(first)) << "three steps away are (5/6)^6 = 0.33 of the area";
    key("Home");
    // What is under the cursor at the target's distance stays there, so the shape moves away from it.
    desktop_->xdotool({"mousemove", "40", "90", "click", "--repeat", "2", "4"});
    EXPECT_GT(middleOfLit(shot()).x, middleOfLit(first).x + 10);
    key("Home");
    EXPECT_EQ(shot().pixels, first.pixels);
}

TEST_F(ViewWindowTest, WireframeLeavesHolesAndGoesAway) {
    view({"scene.json"});
    // Ten steps nearer a triangle is dozens of pixels large.
    desktop_->xdotool({"mousemove", "120", "90", "click", "--repeat", "10", "4"});
    const Image first = shot();
    key("w");
    const Image wires = shot();
    EXPECT_LT(litCount(wires), 0.7 * litCount(first));
    EXPECT_GT(litCount(wires), 0.1 * litCount(first));
    key("w");
    EXPECT_EQ(shot().pixels, first.pixels);
}

TEST_F(ViewWindowTest, SpacePlaysAndPausesAndAPausedPictureStays) {
    view({"scene.json"});
    const Image first = shot();
    key("space");
    std::set<std::string> titles;
    EXPECT_TRUE(soon([&] {
        titles.insert(desktop_->title(window_));
        return titles.size() > 5;
    })) << "the moment in the title runs";
    key("space");
    const Image paused = shot();
    EXPECT_EQ(shot().pixels, paused.pixels);
    EXPECT_TRUE(soon([&] { return contains(desktop_->title(window_), "(paused)"); }));
    key("x");
    EXPECT_TRUE(showsSoon(paused));
    key("Right");
    key("Left");
    for (int i = 0; i < 4 && shot().pixels != first.pixels; ++i) key("Left");
    EXPECT_EQ(shot().pixels, first.pixels) << "the beginning is among the four key frames";
}

TEST_F(ViewWindowTest, HelpIsWrittenOverThePictureAndNotIntoIt) {
    view({"scene.json", "--size", "480x360"});
    const Image first = shot();
    key("question");
    const Image saved = shot();
    EXPECT_EQ(saved.pixels, first.pixels);
    EXPECT_TRUE(soon([&] { return changedShare(desktop_->picture(window_), first) > 0.2; }));
    writePng(picturesFolder() / "help.png", desktop_->picture(window_));
    key("question");
    EXPECT_TRUE(showsSoon(first));
}

TEST_F(ViewWindowTest, AResizedWindowShowsTheSceneInItsNewSize) {
    view({"scene.json"});
    const Image first = shot();
    desktop_->xdotool({"windowsize", "--sync", std::to_string(window_), "320", "150"});
    const Image wide = shot();
    EXPECT_EQ(wide.size, glm::ivec2(320, 150));
    run({"render", "scene.json", "-o", "wide.png", "--frames", "0:0", "--size", "320x150"});
    EXPECT_EQ(wide.pixels, readPng(folder_ / "wide.png").pixels);
    key("x");
    EXPECT_TRUE(showsSoon(wide));
    desktop_->xdotool({"windowsize", "--sync", std::to_string(window_), "240", "180"});
    EXPECT_EQ(shot().pixels, first.pixels);
}

TEST_F(ViewWindowTest, WhatHappensWhileItIsMinimisedIsShownAfterwards) {
    view({"scene.json"});
    shot();
    desktop_->setMinimised(window_, true);
    key("Right");
    desktop_->setMinimised(window_, false);
    EXPECT_EQ(shot().pixels, rendered(20).pixels);
}

TEST_F(ViewWindowTest, ADroppedSeriesOrSceneIsOpened) {
    writeBlobs("ball.vdb", growingSphere, 2);
    view({"scene.json"});
    const Image first = shot();
    EXPECT_TRUE(desktop_->drop(window_, {folder_ / "ball.vdb"}));
    EXPECT_TRUE(soon([&] { return contains(desktop_->title(window_), "ball  0"); }))
        << desktop_->title(window_) << viewer_->err();
    const Image ball = shot();
    EXPECT_EQ(ball.size, kSize) << "the window stays as it is";
    EXPECT_GT(changedShare(first, ball), 0.1);
    EXPECT_TRUE(contains(viewer_->err(), "iso-value")) << "why it shows these surfaces";
    EXPECT_TRUE(desktop_->drop(window_, {folder_ / "scene.json"}));
    EXPECT_TRUE(soon([&] { return contains(desktop_->title(window_), "scene  0"); }));
    EXPECT_EQ(shot().pixels, first.pixels);
    EXPECT_EQ(quit("q"), 0) << viewer_->err();
}

TEST_F(ViewWindowTest, ADroppedFileThatCannotBeOpenedIsSaidInTheWindowAndChangesNothing) {
    std::ofstream(folder_ / "letter.txt") << "hello";
    view({"scene.json", "--size", "480x360"});
    const Image first = shot();
    key("x");
    ASSERT_TRUE(showsSoon(first));
    desktop_->drop(window_, {folder_ / "letter.txt"});
    EXPECT_TRUE(soon([&] { return contains(viewer_->err(), "isoglass: error: "); }));
    EXPECT_TRUE(contains(viewer_->err(), "letter.txt")) << viewer_->err();
    const Rgba8 errorInk{255, 144, 112, 255};
    EXPECT_TRUE(soon([&] { return std::ranges::count(desktop_->picture(window_).pixels, errorInk) > 100; }));
    writePng(picturesFolder() / "error.png", desktop_->picture(window_));
    EXPECT_EQ(shot().pixels, first.pixels);
    desktop_->askToClose(window_);
    EXPECT_EQ(viewer_->wait(), 0);
}

TEST_F(ViewWindowTest, ABareSeriesIsShownWithReasons) {
    view({"blobs.vdb", "--size", "320x240"});
    const Image first = shot();
    EXPECT_EQ(first.size, glm::ivec2(320, 240));
    EXPECT_GT(litCount(first), 0.05 * 320 * 240);
    EXPECT_TRUE(contains(viewer_->err(), "note: iso-value")) << viewer_->err();
    EXPECT_TRUE(contains(viewer_->err(), "of the samples reach it")) << viewer_->err();
}

TEST_F(ViewWindowTest, NothingIsDoneWhileNothingChanges) {
    view({"scene.json"});
    shot();
    key("x");
    ::sleep(1);
    const double before = viewer_->cpuSeconds();
    ::sleep(2);
    // A loop that draws again and again takes seconds here; a sleeping one takes none. The kernel counts in
    // hundredths.
    EXPECT_LT(viewer_->cpuSeconds() - before, 0.1);
}

TEST_F(ViewWindowTest, WithoutADisplayItSaysSo) {
    for (const char* display : {"DISPLAY=", "DISPLAY=:54321"}) {
        const RunResult result = isoglass({"view", "scene.json"}, {.environment = {display}});
        EXPECT_EQ(result.status, 1);
        EXPECT_TRUE(contains(result.err, "isoglass: error: cannot open a window: X11:")) << result.err;
        EXPECT_TRUE(contains(result.err, "isoglass render")) << result.err;
    }
}

TEST_F(ViewWindowTest, WhatCannotBeOpenedEndsWithAnError) {
    const std::vector<std::string> environment{"DISPLAY=" + desktop_->name()};
    const RunResult result = isoglass({"view", "none.json"}, {.environment = environment});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "there is no such file (none.json)")) << result.err;
    const RunResult size = isoglass({"view", "scene.json", "--size", "0x5"}, {.environment = environment});
    EXPECT_EQ(size.status, 1);
    EXPECT_TRUE(contains(size.err, "--size")) << size.err;
}

TEST_F(ViewWindowTest, HelpOfTheCommandNamesTheKeys) {
    const RunResult result = run({"view", "--help"});
    for (const char* what : {"space", "Home", "wireframe", "save a picture", "drop a file"}) {
        EXPECT_TRUE(contains(result.out, what)) << what;
    }
}

}  // namespace
}  // namespace isoglass::test
