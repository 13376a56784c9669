#include "formats/raw_export.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <fstream>
#include <string>
#include <vector>

namespace isoglass {

namespace {

using Json = nlohmann::ordered_json;

/// All samples of a key frame, x fastest.
void copySamples(const KeyFrame& frame, std::span<float> samples) {
    const glm::ivec3 dims = frame.dims();
    const glm::ivec3 bricks = frame.brickDims();
    std::size_t i = 0;
    for (int z = 0; z < dims.z; ++z)
        for (int y = 0; y < dims.y; ++y)
            for (int bx = 0; bx < bricks.x; ++bx) {
                const int first = bx * kBrickSize;
                const int last = std::min(first + kBrickSize, dims.x);
                const BrickView& brick = frame.brick(frame.linear({bx, y / kBrickSize, z / kBrickSize}));
                const bool plain = !brick.missing && !brick.samples;
                for (int x = first; x < last; ++x)
                    samples[i++] = plain ? brick.constant : frame.sample({x, y, z});
            }
}

Json describe(const SeriesDescription& series, const std::string& samplesName) {
    const glm::ivec3 dims = series.lattice.dims();
    Json json = {{"format", "isoglass-raw"},
                 {"version", 1},
                 {"name", series.name},
                 {"long_name", series.longName},
                 {"units", series.units},
                 {"files", samplesName},
                 {"gzip", false},
                 {"type", "f32"},
                 {"endian", "little"},
                 {"dims", {dims.x, dims.y, dims.z, series.time.times.size()}}};
    json["axes"] = Json::array();
    for (const Axis& axis : series.lattice.axes) {
        Json entry = {{"name", axis.name}, {"units", axis.units}, {"negated", axis.negated}};
        if (axis.period) entry["period"] = *axis.period;
        entry["coordinates"] = axis.coordinates;
        json["axes"].push_back(entry);
    }
    Json time = {{"units", series.time.units}, {"calendar", series.time.calendar}};
    if (series.time.period) time["period"] = *series.time.period;
    time["times"] = series.time.times;
    json["time"] = time;
    return json;
}

/// A line for each key of the root: tables of coordinates stay on one.
std::string text(const Json& json) {
    std::string lines;
    for (const auto& [key, value] : json.items())
        lines += (lines.empty() ? "{\n  " : ",\n  ") + Json(key).dump() + ": " +
                 value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return lines + "\n}\n";
}

void close(std::ofstream& stream, const std::filesystem::path& path) {
    stream.close();
    if (!stream)
        throw Error("cannot write the whole file", path.string(), "free some space, or choose another place");
}

}  // namespace

void writeRaw(const SeriesFile& series, const std::filesystem::path& out, const ImportProgress& progress) {
    const SeriesDescription& description = series.description();
    if (description.lattice.heights)
        throw Error("the series has heights of its own for every sample, which RAW cannot hold",
                    series.path().string(), "import it again without --height");
    static_assert(std::endian::native == std::endian::little);
    std::filesystem::path samplesPath = out;
    samplesPath.replace_extension(".raw");
    AtomicFile descriptionFile(out), samplesFile(samplesPath);
    const glm::ivec3 dims = description.lattice.dims();
    std::vector<float> samples(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    std::ofstream payload(samplesFile.temporaryPath(), std::ios::binary);
    const std::size_t frames = description.time.times.size();
    for (std::size_t frame = 0; frame < frames; ++frame) {
        copySamples(*series.read(frame), samples);
        payload.write(reinterpret_cast<const char*>(samples.data()),
                      static_cast<std::streamsize>(samples.size() * sizeof(float)));
        if (progress) progress(frame + 1, frames);
    }
    close(payload, samplesPath);
    std::ofstream header(descriptionFile.temporaryPath());
    header << text(describe(description, samplesPath.filename().string()));
    close(header, out);
    samplesFile.commit();
    descriptionFile.commit();
}

}  // namespace isoglass
