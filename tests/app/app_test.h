#pragma once

#include "app/run_program.h"
#include "unit/mesh_io/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace isoglass::test {

/// Runs the built program in a folder of its own.
class AppTest : public testing::Test {
  protected:
    ScratchFolder folder_;

    RunResult isoglass(const std::vector<std::string>& arguments, RunOptions options = {}) const {
        options.folder = folder_.path();
        return runProgram(ISOGLASS_PROGRAM, arguments, options);
    }

    /// The same, for runs that must succeed.
    RunResult run(const std::vector<std::string>& arguments, RunOptions options = {}) const {
        RunResult result = isoglass(arguments, std::move(options));
        EXPECT_EQ(result.status, 0) << result.err;
        return result;
    }

    StartedProgram start(const std::vector<std::string>& arguments, RunOptions options = {}) const {
        options.folder = folder_.path();
        return StartedProgram(ISOGLASS_PROGRAM, arguments, options);
    }

    /// ocean.vdb: twelve months of temperature.
    void importOcean() const { run({"import", ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc", "-o", "ocean.vdb"}); }

    /// scene.json: the ocean, ten displayed frames, one opaque surface and two semi-transparent ones.
    /// `more` is put in as it is: further keys, with a comma at the end.
    void writeScene(const std::string& more = "", const std::string& name = "scene.json") const {
        std::ofstream(folder_ / name) << R"({"version": 1, )" << more << R"(
            "volumes": [{"name": "ocean", "series": "ocean.vdb", "place": {"scale": [1, 1, 0.18]},
                         "surfaces": [{"iso": 25, "color": "#e04030", "opacity": 1},
                                      {"iso": 20, "color": "#f0c040", "opacity": 0.4},
                                      {"iso": 10, "color": "#3060d0", "opacity": 0.3}]}],
            "time": {"from": "0000-01-16T06:00:00", "to": "0001-01-15T11:49:12", "duration": 0.4, "fps": 25},
            "camera": {"eye": [150, -400, 165], "target": [203, -6, -52], "fov": 28.5},
            "image": {"size": [96, 64]}})";
    }

    std::string bytesOf(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            names.insert(entry.path().filename().string());
        }
        return names;
    }
};

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace isoglass::test
