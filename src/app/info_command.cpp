#include "app/commands.h"
#include "app/text.h"
#include "volume/calendar.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <limits>

namespace isoglass {

namespace {

using Json = nlohmann::ordered_json;

/// Sums over all key frames.
struct Totals {
    ValueRange range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    double samples = 0;
    double valid = 0;
    double active = 0;
    std::uint64_t bytes = 0;
    std::uint64_t bytesDense = 0;
    std::uint64_t bytesLevels = 0;
    std::size_t levels = 0;  ///< coarser ones that every key frame has in the file

    bool empty() const { return range.min > range.max; }
};

Totals addUp(const SeriesDescription& series) {
    Totals totals;
    const glm::ivec3 dims = series.lattice.dims();
    const auto perFrame = static_cast<std::uint64_t>(dims.x) * dims.y * dims.z;
    totals.levels = series.frames.front().levels.size();
    for (const FrameRecord& frame : series.frames) {
        totals.range.min = std::min(totals.range.min, frame.range.min);
        totals.range.max = std::max(totals.range.max, frame.range.max);
        totals.samples += static_cast<double>(perFrame);
        totals.valid += static_cast<double>(frame.validSamples);
        totals.active += static_cast<double>(frame.activeVoxels);
        totals.bytes += frame.bytes;
        totals.levels = std::min(totals.levels, frame.levels.size());
        for (const LevelRecord& level : frame.levels) totals.bytesLevels += level.bytes;
        totals.bytesDense += perFrame * sizeof(float) * (series.lattice.heights ? 2 : 1);
    }
    return totals;
}

Json axisJson(const Axis& axis) {
    Json json = {{"name", axis.name},
                 {"units", axis.units},
                 {"samples", axis.size()},
                 {"first", axis.coordinates.front()},
                 {"last", axis.coordinates.back()},
                 {"negated", axis.negated},
                 {"descending", axis.descending()}};
    json["period"] = axis.period ? Json(*axis.period) : Json(nullptr);
    json["coordinates"] = axis.coordinates;
    return json;
}

Json heightsJson(const Lattice& lattice) {
    if (!lattice.heights) return nullptr;
    const HeightField& heights = *lattice.heights;
    return {{"name", heights.name}, {"units", heights.units}, {"range", {heights.min, heights.max}}};
}

Json boundsJson(const Lattice& lattice) {
    const auto [low, high] = lattice.bounds();
    return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

Json seriesJson(const SeriesFile& file) {
    const SeriesDescription& series = file.description();
    const Totals totals = addUp(series);
    const glm::ivec3 dims = series.lattice.dims();
    Json json = {{"name", series.name},
                 {"long_name", series.longName},
                 {"file", file.path().string()},
                 {"dims", {dims.x, dims.y, dims.z}},
                 {"times", series.time.times},
                 {"time_units", series.time.units},
                 {"calendar", series.time.calendar}};
    json["time_period"] = series.time.period ? Json(*series.time.period) : Json(nullptr);
    json["units"] = series.units;
    json["range"] = totals.empty() ? Json(nullptr) : Json({totals.range.min, totals.range.max});
    json["missing_fraction"] = 1 - totals.valid / totals.samples;
    json["active_fraction"] = totals.active / totals.samples;
    json["bytes"] = totals.bytes;
    json["bytes_dense"] = totals.bytesDense;
    json["levels"] = totals.levels;
    json["bytes_levels"] = totals.bytesLevels;
    json["bytes_file"] = std::filesystem::file_size(file.path());
    json["stored_error"] = series.storedError;
    json["keep"] = series.keep ? Json({series.keep->min, series.keep->max}) : Json(nullptr);
    json["provenance"] = series.provenance;
    json["notes"] = series.notes;
    json["heights"] = heightsJson(series.lattice);
    json["bounds"] = boundsJson(series.lattice);
    json["axes"] = Json::array();
    for (const Axis& axis : series.lattice.axes) json["axes"].push_back(axisJson(axis));
    return json;
}

std::string percent(double share) {
    return formatNumber(std::round(share * 1000) / 10) + " %";
}

std::string timeText(const TimeAxis& axis, double time) {
    std::string text = formatNumber(time);
    if (hasDates(axis)) text += " (" + dateFromAxisTime(axis, time) + ")";
    return text;
}

void printAxis(char letter, const Axis& axis) {
    std::cout << "  " << letter << "         " << axis.name << ": " << axis.size() << " samples, "
              << formatNumber(axis.coordinates.front()) << " to " << formatNumber(axis.coordinates.back());
    if (!axis.units.empty()) std::cout << ' ' << axis.units;
    if (axis.descending()) std::cout << ", descending";
    if (axis.negated) std::cout << ", negated (the source measures downwards)";
    if (axis.period) std::cout << ", periodic (" << formatNumber(*axis.period) << ")";
    std::cout << '\n';
}

void printTimes(const TimeAxis& time) {
    std::cout << "  times     " << time.times.size() << " key frames, " << timeText(time, time.times.front());
    if (time.times.size() > 1) std::cout << " to " << timeText(time, time.times.back());
    if (!time.units.empty()) std::cout << ", " << time.units;
    if (!time.calendar.empty()) std::cout << ", calendar " << time.calendar;
    if (time.period) std::cout << ", repeats after " << formatNumber(*time.period);
    std::cout << '\n';
}

void printSeries(const SeriesFile& file) {
    const SeriesDescription& series = file.description();
    const Totals totals = addUp(series);
    const glm::ivec3 dims = series.lattice.dims();
    std::cout << file.path().string() << '\n';
    std::cout << "  grid      " << series.name;
    if (!series.longName.empty()) std::cout << " (" << series.longName << ")";
    std::cout << ", " << dims.x << " x " << dims.y << " x " << dims.z << " samples\n";
    if (totals.empty()) {
        std::cout << "  range     no valid sample\n";
    } else {
        std::cout << "  range     " << formatNumber(totals.range.min) << " to "
                  << formatNumber(totals.range.max) << (series.units.empty() ? "" : " " + series.units)
                  << '\n';
    }
    printTimes(series.time);
    for (int k = 0; k < 3; ++k) printAxis(static_cast<char>('x' + k), series.lattice.axes[k]);
    if (const auto& heights = series.lattice.heights) {
        std::cout << "  heights   " << heights->name << ": " << formatNumber(heights->min) << " to "
                  << formatNumber(heights->max) << (heights->units.empty() ? "" : " " + heights->units)
                  << ", one a sample and key frame\n";
    }
    std::cout << "  missing   " << percent(1 - totals.valid / totals.samples) << " of the samples; "
              << percent(totals.active / totals.samples) << " are stored one by one\n";
    std::cout << "  memory    " << formatBytes(totals.bytes) << " against " << formatBytes(totals.bytesDense)
              << " dense; file " << formatBytes(std::filesystem::file_size(file.path())) << '\n';
    if (totals.levels > 0) {
        std::cout << "  levels    " << totals.levels << " coarser "
                  << (totals.levels > 1 ? "ones are" : "one is") << " in the file, "
                  << formatBytes(totals.bytesLevels) << " when read\n";
    }
    if (series.storedError > 0) {
        std::cout << "  error     samples differ from the source by at most "
                  << formatNumber(series.storedError) << '\n';
    }
    if (series.keep) {
        std::cout << "  kept      iso-values from " << formatNumber(series.keep->min) << " to "
                  << formatNumber(series.keep->max) << "; other surfaces are not those of the source\n";
    }
    std::cout << "  from      " << series.provenance << '\n';
    for (const std::string& note : series.notes) std::cout << "  note      " << note << '\n';
}

}  // namespace

void runInfo(const InfoCommand& command) {
    Json all = Json::array();
    for (const auto& path : command.series) {
        const SeriesFile file(path);
        if (command.json) {
            all.push_back(seriesJson(file));
        } else {
            printSeries(file);
        }
    }
    if (command.json) std::cout << Json{{"series", all}}.dump(2) << '\n';
}

}  // namespace isoglass
