#include "app/commands.h"
#include "app/progress.h"
#include "app/text.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/mesh_check.h"
#include "surface/enclosed_volume.h"
#include "surface/extract.h"
#include "volume/calendar.h"

#include <array>
#include <charconv>
#include <fstream>
#include <iostream>
#include <sstream>

namespace isoglass {

namespace {

/// The shortest numeral that reads back as the same double.
std::string numeral(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// A field of a CSV file (RFC 4180).
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return quoted + '"';
}

/// Units of world coordinates along x, y, z; the third may come from heights.
std::array<std::string, 3> worldUnits(const Lattice& lattice) {
    std::array<std::string, 3> units;
    for (std::size_t k = 0; k < 3; ++k) units[k] = lattice.axes[k].units;
    if (lattice.heights) units[2] = lattice.heights->units;
    return units;
}

bool hasMixedUnits(const Lattice& lattice) {
    const auto units = worldUnits(lattice);
    return units[0] != units[1] || units[0] != units[2];
}

/// Units of a product of lengths along the axes.
std::string lengthUnits(const Lattice& lattice, int power) {
    const auto units = worldUnits(lattice);
    const std::string exponent = "^" + std::to_string(power);
    if (!hasMixedUnits(lattice))
        return units[0].empty() ? "[axis unit" + exponent + "]" : "[" + units[0] + exponent + "]";
    std::string mixed;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string name = k == 2 && lattice.heights ? lattice.heights->name : lattice.axes[k].name;
        mixed += (k > 0 ? ", " : "") + (units[k].empty() ? name : units[k]);
    }
    return "[units of the axes: " + mixed + "]";
}

std::string header(const SeriesDescription& series) {
    const std::string units = series.time.units.empty() ? "" : " [" + series.time.units + "]";
    std::string line = field("time" + units);
    if (hasDates(series.time)) line += ",date";
    line += "," + field("area " + lengthUnits(series.lattice, 2));
    line += "," + field("volume " + lengthUnits(series.lattice, 3));
    return line + ",volume_share,components,euler_number,boundary_edges,triangles,missing_cells\n";
}

std::string row(const SeriesDescription& series, double time, const SurfaceMesh& mesh,
                const EnclosedVolume& inside) {
    const MeshTopology topology = checkTopology(mesh);
    std::ostringstream line;
    line << numeral(time);
    if (hasDates(series.time)) line << ',' << field(dateFromAxisTime(series.time, time));
    line << ',' << numeral(measure(mesh).area) << ',' << numeral(inside.volume) << ','
         << (inside.domain > 0 ? numeral(inside.volume / inside.domain) : "") << ',' << topology.components
         << ',' << topology.eulerNumber << ',' << topology.boundaryEdges << ',' << mesh.triangleCount() << ','
         << inside.missingCells << '\n';
    return line.str();
}

/// Every key frame, with `steps` - 1 moments between two.
std::vector<double> moments(const std::vector<double>& times, int steps) {
    std::vector<double> all;
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        for (int step = 0; step < steps; ++step)
            all.push_back(times[i] + (times[i + 1] - times[i]) * step / steps);
    }
    all.push_back(times.back());
    return all;
}

/// Reads key frames once each: a moment needs the two around it.
class FrameReader {
  public:
    explicit FrameReader(const SeriesFile& file) : file_(file) {}

    TimedField at(double time) {
        const TimeSample sample = locate(file_.description().time, time);
        TimedField timed;
        timed.a = frame(sample.frameA);
        if (sample.fraction > 0) timed.b = frame(sample.frameB);
        timed.fraction = static_cast<float>(sample.fraction);
        return timed;
    }

  private:
    std::shared_ptr<const KeyFrame> frame(std::size_t index) {
        auto& place = kept_[index % kept_.size()];
        if (!place.second || place.first != index) place = {index, file_.read(index)};
        return place.second;
    }

    const SeriesFile& file_;
    std::array<std::pair<std::size_t, std::shared_ptr<const KeyFrame>>, 2> kept_;
};

void writeText(const std::filesystem::path& out, const std::string& text) {
    AtomicFile whole(out);
    std::ofstream file(whole.temporaryPath(), std::ios::binary);
    file << text;
    file.close();
    if (!file) throw Error("cannot write", out.string(), "free some space, or choose another place");
    whole.commit();
}

}  // namespace

void runMeshSeries(const MeshCommand& command, const CommonOptions& common) {
    if (command.out.extension() != ".csv") {
        throw Error("the figures of a series are written as CSV", command.out.string(),
                    "end the name in .csv");
    }
    checkPlace(command.out);
    const SeriesFile file(command.series);
    const SeriesDescription& series = file.description();
    if (hasMixedUnits(series.lattice)) {
        printNote("the axes have different units: area is no area, and volume only in proportion to another");
    }
    const std::vector<double> times = moments(series.time.times, command.steps);
    std::string table = header(series);
    FrameReader reader(file);
    {
        Progress progress("measuring", "moments", static_cast<std::int64_t>(times.size()));
        for (std::size_t i = 0; i < times.size(); ++i) {
            const TimedField timed = reader.at(times[i]);
            const ExtractOptions options{.iso = static_cast<float>(command.iso),
                                         .insideIsBelow = command.insideIsBelow,
                                         .threads = common.threads};
            table += row(series, times[i], extractSurface(series.lattice, timed, options).mesh,
                         enclosedVolume(series.lattice, timed, options));
            progress.update(static_cast<std::int64_t>(i) + 1);
        }
    }
    writeText(command.out, table);
    std::cout << command.out.string() << ": " << times.size() << " moments\n";
}

}  // namespace isoglass
