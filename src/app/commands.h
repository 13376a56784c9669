#pragma once

#include "pipeline/batch.h"
#include "scene/scene.h"
#include "volume/frame_source.h"
#include "volume/series_file.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

// One function a command, called after the command line was parsed. Data goes to standard output, progress
// and notes to standard error; failures are thrown.

/// Options that every command takes.
struct CommonOptions {
    int threads = 0;                                 ///< 0 takes all cores
    std::size_t memoryBytes = std::size_t{2} << 30;  ///< budget for key frames
};

struct ImportCommand {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path out;
    ImportOptions options;
    bool timeFromName = false;  ///< the numbers in the names are the times
    SparsityOptions sparsity;
};
void runImport(const ImportCommand& command);

struct ExportCommand {
    std::filesystem::path series;
    std::filesystem::path out;  ///< a .json; the samples go into a .raw beside it
};
void runExport(const ExportCommand& command);

struct InfoCommand {
    std::vector<std::filesystem::path> series;
    bool json = false;
};
void runInfo(const InfoCommand& command);

struct RenderCommand {
    std::filesystem::path scene;
    std::string out;  ///< a .png, a .png name with {frame}, or an .mp4
    std::optional<FrameRange> frames;
    std::optional<glm::ivec2> size;
    std::optional<TransparencyMethod> method;
    bool showLevels = false;  ///< see colorByLevel
};
void runRender(const RenderCommand& command, const CommonOptions& common);

struct ViewCommand {
    std::filesystem::path file;      ///< a scene or a series
    std::optional<glm::ivec2> size;  ///< of the window; the scene's image where not given
    bool showLevels = false;         ///< see colorByLevel
};
void runView(const ViewCommand& command, const CommonOptions& common);

struct MeshCommand {
    std::filesystem::path series;
    std::filesystem::path out;
    double iso = 0;
    std::optional<double> time;  ///< in the series' own units; the first key frame's where not given
    bool insideIsBelow = false;
    bool wholeSeries = false;       ///< measures the surface over time, see `runMeshSeries`
    int steps = 1;                  ///< moments from one key frame to the next that are measured
    std::optional<glm::dvec3> eye;  ///< in the coordinates of the series; full resolution where not given
    double cellPixels = 0;          ///< with `eye`: size of a cell on the screen; this or the next
    double errorPixels = 0;         ///< with `eye`: displacement of the surface on the screen
    glm::ivec2 size{0};             ///< with `eye`: of the image
    double fovDegrees = 30;
};
void runMesh(const MeshCommand& command, const CommonOptions& common);
/// Area, enclosed volume, components, Euler number of the surface over time, as CSV.
void runMeshSeries(const MeshCommand& command, const CommonOptions& common);

struct ValidateCommand {
    std::filesystem::path file;  ///< a scene or a series
    bool json = false;
};
/// Reports everything that is wrong; false where there is an error.
bool runValidate(const ValidateCommand& command);

struct PlanCommand {
    std::filesystem::path scene;
    bool json = false;
};
void runPlan(const PlanCommand& command, const CommonOptions& common);

struct BenchCommand {
    std::vector<std::string> names;  ///< parts of names; empty runs all
    bool json = false;
    int repetitions = 9;
};
void runBench(const BenchCommand& command, const CommonOptions& common);

}  // namespace isoglass
