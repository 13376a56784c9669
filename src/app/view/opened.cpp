#include "app/view/opened.h"

#include "app/text.h"
#include "app/view/first_scene.h"
#include "base/error.h"
#include "meshio/mesh_format.h"
#include "scene/scene_file.h"
#include "volume/calendar.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace isoglass {

namespace {

constexpr double kSamePosition = 1e-9;
/// The camera moves while meshes are made: by less than half a picture, unless somebody hurries.
constexpr double kSeenMargin = 0.5;

/// A scene file is JSON, whatever its name.
bool isScene(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) throw Error("there is no such file", file.string());
    if (std::filesystem::is_directory(file)) {
        throw Error("this is a folder", file.string(),
                    "name a scene (.json), a series (.vdb) or a mesh in it");
    }
    std::ifstream stream(file, std::ios::binary);
    char first = 0;
    stream >> first;
    return file.extension() == ".json" || first == '{';
}

void addKeyPositions(const PlayedSeries& played, std::vector<double>& positions) {
    const TimeAxis& axis = played.file->description().time;
    const double length = played.to - played.from;
    if (!(std::abs(length) > 0)) return;
    for (const double key : axis.times) {
        double position = (key - played.from) / length;
        if (axis.period) {
            const double turn = std::abs(*axis.period / length);
            for (position -= turn * std::floor(position / turn + kSamePosition); position < 1 - kSamePosition;
                 position += turn) {
                positions.push_back(std::max(position, 0.0));
            }
        } else if (position > -kSamePosition && position < 1 + kSamePosition) {
            positions.push_back(std::clamp(position, 0.0, 1.0));
        }
    }
}

double smallestStep(const TimeAxis& axis) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < axis.times.size(); ++i) {
        smallest = std::min(smallest, axis.times[i] - axis.times[i - 1]);
    }
    return smallest;
}

}  // namespace

std::vector<double> Opened::keyPositions() const {
    std::vector<double> positions;
    for (const PlayedSeries& played : extractor->series()) addKeyPositions(played, positions);
    std::ranges::sort(positions);
    const auto same = [](double a, double b) { return b - a < kSamePosition; };
    positions.erase(std::unique(positions.begin(), positions.end(), same), positions.end());
    return positions;
}

Opened openForViewing(const std::filesystem::path& file, glm::ivec2 firstSize, const OpenOptions& options) {
    Opened opened;
    opened.name = file.stem().string();
    if (isScene(file)) {
        opened.scene = loadScene(file);
        opened.notes = opened.scene.notes;
    } else {
        FirstScene first = knownMeshFormat(file) ? makeMeshScene(file, firstSize)
                                                 : makeFirstScene(SeriesFile(file), firstSize);
        opened.scene = std::move(first.scene);
        opened.notes = std::move(first.reasons);
    }
    if (options.showLevels) colorByLevel(opened.scene);
    // Meshes of full resolution serve every view.
    SceneExtractor::Options extraction = options.scene;
    if (opened.scene.quality.wantsDetail()) extraction.seenMargin = kSeenMargin;
    extraction.motion = opened.scene.time.frameCount() > 1;
    opened.extractor = std::make_unique<SceneExtractor>(opened.scene, extraction);
    const std::vector<std::string>& more = opened.extractor->notes();
    opened.notes.insert(opened.notes.end(), more.begin(), more.end());
    return opened;
}

std::string momentText(const TimeAxis& axis, double time) {
    if (!hasDates(axis)) return formatNumber(time) + (axis.units.empty() ? "" : " ") + axis.units;
    constexpr std::size_t kMinutes = 6, kSeconds = 9;  // letters from the T on
    std::string text = dateFromAxisTime(axis, time);
    const std::size_t clock = text.find('T');
    text.resize(std::min(text.size(),
                         clock + (smallestStep(axis) * secondsPerUnit(axis) < 60 ? kSeconds : kMinutes)));
    text[clock] = ' ';
    return text;
}

}  // namespace isoglass
