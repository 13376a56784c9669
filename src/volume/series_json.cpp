#include "volume/series_json.h"

#include "base/error.h"
#include "volume/lattice_check.h"
#include "volume/pyramid.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace isoglass {

namespace {

using Json = nlohmann::json;

/// Programs that know nothing of heights must not show a series that has them in the wrong place.
constexpr int kVersion = 1;
constexpr int kVersionWithHeights = 2;
/// A lattice with more samples along an axis than this is taken for a damaged file: brick and sample
/// numbers are 32-bit integers.
constexpr std::size_t kMostSamplesPerAxis = 1u << 20;

Json axisToJson(const Axis& axis) {
    Json json = {{"name", axis.name},
                 {"units", axis.units},
                 {"coordinates", axis.coordinates},
                 {"negated", axis.negated}};
    if (axis.period) json["period"] = *axis.period;
    return json;
}

void checkMonotonic(const std::vector<double>& values, const std::string& what) {
    if (values.empty()) throw std::invalid_argument(what + " is empty");
    if (values.size() > kMostSamplesPerAxis) throw std::invalid_argument(what + " is too long");
    const bool descending = values.back() < values.front();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool ordered = i == 0 || (descending ? values[i] < values[i - 1] : values[i] > values[i - 1]);
        if (!std::isfinite(values[i]) || !ordered) {
            throw std::invalid_argument(what + " is not strictly monotonic at index " + std::to_string(i));
        }
    }
}

/// What repeats must do so after its last value.
void checkPeriod(std::optional<double> period, const std::vector<double>& values, const std::string& what) {
    if (!period) return;
    if (!std::isfinite(*period) || *period <= std::abs(values.back() - values.front())) {
        throw std::invalid_argument("the period of " + what + " is not longer than what it spans");
    }
}

Axis axisFromJson(const Json& json) {
    Axis axis;
    axis.name = json.at("name");
    axis.units = json.at("units");
    axis.coordinates = json.at("coordinates").get<std::vector<double>>();
    axis.negated = json.at("negated");
    if (json.contains("period")) axis.period = json["period"].get<double>();
    checkMonotonic(axis.coordinates, "axis " + axis.name);
    checkPeriod(axis.period, axis.coordinates, "axis " + axis.name);
    return axis;
}

Json rangeToJson(ValueRange range) {
    // A frame without a valid sample has an infinite range, which JSON cannot hold.
    if (range.min > range.max) return nullptr;
    return {range.min, range.max};
}

ValueRange rangeFromJson(const Json& json) {
    if (json.is_null())
        return {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    return {json.at(0).get<float>(), json.at(1).get<float>()};
}

Json timeToJson(const TimeAxis& time) {
    Json json = {{"times", time.times}, {"units", time.units}, {"calendar", time.calendar}};
    if (time.period) json["period"] = *time.period;
    return json;
}

TimeAxis timeFromJson(const Json& json) {
    TimeAxis time;
    time.times = json.at("times").get<std::vector<double>>();
    time.units = json.at("units");
    time.calendar = json.at("calendar");
    if (json.contains("period")) time.period = json["period"].get<double>();
    checkMonotonic(time.times, "the time axis");
    if (time.times.back() < time.times.front()) throw std::invalid_argument("the times decrease");
    checkPeriod(time.period, time.times, "the time axis");
    return time;
}

Json levelToJson(const LevelRecord& level) {
    Json json = {{"crc32", level.checksum}, {"bytes", level.bytes}};
    if (level.heightsChecksum) json["heights_crc32"] = *level.heightsChecksum;
    return json;
}

LevelRecord levelFromJson(const Json& json) {
    LevelRecord level{json.at("crc32"), json.at("bytes")};
    if (json.contains("heights_crc32")) level.heightsChecksum = json["heights_crc32"].get<std::uint32_t>();
    return level;
}

Json frameToJson(const FrameRecord& frame) {
    Json json = {{"range", rangeToJson(frame.range)},
                 {"valid", frame.validSamples},
                 {"active", frame.activeVoxels},
                 {"crc32", frame.checksum},
                 {"bytes", frame.bytes}};
    if (frame.heightsChecksum) json["heights_crc32"] = *frame.heightsChecksum;
    for (const LevelRecord& level : frame.levels) json["levels"].push_back(levelToJson(level));
    return json;
}

FrameRecord frameFromJson(const Json& json) {
    FrameRecord frame{rangeFromJson(json.at("range")), json.at("valid"), json.at("active"), json.at("crc32"),
                      json.at("bytes")};
    if (json.contains("heights_crc32")) frame.heightsChecksum = json["heights_crc32"].get<std::uint32_t>();
    if (json.contains("levels")) {
        for (const Json& level : json["levels"]) frame.levels.push_back(levelFromJson(level));
    }
    return frame;
}

Json heightsToJson(const HeightField& heights) {
    return {{"name", heights.name}, {"units", heights.units}, {"range", {heights.min, heights.max}}};
}

HeightField heightsFromJson(const Json& json) {
    HeightField heights{json.at("name"), json.at("units"), json.at("range").at(0), json.at("range").at(1)};
    if (!(heights.min <= heights.max)) throw std::invalid_argument("the range of heights is empty");
    return heights;
}

/// Throws where levels contradict the rest.
void checkLevels(const SeriesDescription& series) {
    const auto all = static_cast<std::size_t>(topLevel(series.lattice.cells()));
    for (const FrameRecord& frame : series.frames) {
        if (!frame.levels.empty() && frame.levels.size() != all)
            throw std::invalid_argument("a key frame has " + std::to_string(frame.levels.size()) +
                                        " coarser levels instead of " + std::to_string(all));
    }
}

/// Throws where heights contradict the rest.
void checkHeights(const SeriesDescription& series) {
    const bool expected = series.lattice.heights.has_value();
    const auto agrees = [&](const auto& record) { return record.heightsChecksum.has_value() == expected; };
    for (const FrameRecord& frame : series.frames) {
        if (!agrees(frame) || !std::ranges::all_of(frame.levels, agrees))
            throw std::invalid_argument("key frames and lattice do not agree on heights");
    }
    if (expected && series.lattice.axes[2].period) throw std::invalid_argument("heights cannot be periodic");
}

SeriesDescription parse(std::string_view text) {
    const Json json = Json::parse(text);
    const bool heights = json.at("version") == kVersionWithHeights;
    if (!heights && json["version"] != kVersion) throw std::invalid_argument("its version is unknown");
    SeriesDescription series;
    series.name = json.at("name");
    series.longName = json.at("long_name");
    series.units = json.at("units");
    for (int k = 0; k < 3; ++k) series.lattice.axes[k] = axisFromJson(json.at("axes").at(k));
    if (heights) series.lattice.heights = heightsFromJson(json.at("heights"));
    requireUsable(series.lattice, "axes");
    series.time = timeFromJson(json.at("time"));
    for (const Json& frame : json.at("frames")) series.frames.push_back(frameFromJson(frame));
    if (series.frames.size() != series.time.times.size()) {
        throw std::invalid_argument("it has " + std::to_string(series.time.times.size()) + " times but " +
                                    std::to_string(series.frames.size()) + " key frames");
    }
    checkHeights(series);
    checkLevels(series);
    series.inactiveIsMissing = json.at("inactive_is_missing");
    series.storedError = json.at("stored_error");
    if (json.contains("keep")) series.keep = rangeFromJson(json["keep"]);
    series.provenance = json.at("provenance");
    series.notes = json.at("notes").get<std::vector<std::string>>();
    return series;
}

}  // namespace

std::string asUtf8(const std::string& text) {
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string toJson(const SeriesDescription& series) {
    Json json = {{"version", series.lattice.heights ? kVersionWithHeights : kVersion},
                 {"name", series.name},
                 {"long_name", series.longName},
                 {"units", series.units},
                 {"time", timeToJson(series.time)},
                 {"inactive_is_missing", series.inactiveIsMissing},
                 {"stored_error", series.storedError},
                 {"provenance", series.provenance},
                 {"notes", series.notes}};
    for (const Axis& axis : series.lattice.axes) json["axes"].push_back(axisToJson(axis));
    if (series.lattice.heights) json["heights"] = heightsToJson(*series.lattice.heights);
    for (const FrameRecord& frame : series.frames) json["frames"].push_back(frameToJson(frame));
    if (series.keep) json["keep"] = rangeToJson(*series.keep);
    // Text from foreign files may not be UTF-8; it must not make the series unwritable.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SeriesDescription seriesFromJson(std::string_view text, const std::string& where) {
    try {
        return parse(text);
    } catch (const std::exception& failure) {
        throw Error(std::string("the description of the series is damaged: ") + failure.what(), where,
                    "import the series again");
    }
}

}  // namespace isoglass
