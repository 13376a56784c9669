#include "base/error.h"
#include "formats/data_files.h"
#include "formats/header_text.h"
#include "formats/medical_images.h"
#include "formats/orientation.h"
#include "formats/raw_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>

// The NRRD format as teem's documentation defines it: http://teem.sourceforge.net/nrrd/format.html

namespace isoglass {

namespace {

constexpr std::size_t kHeaderLimit = std::size_t{1} << 20;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct NrrdHeader {
    HeaderText fields;
    std::uint64_t bytes = 0;             ///< where a payload in the same file starts
    std::vector<std::string> dataFiles;  ///< those listed after "data file: LIST"
};

/// One line without its end, which the last one may lack; nothing where the text is over.
std::optional<std::string_view> nextLine(std::string_view text, std::uint64_t& position) {
    if (position >= text.size()) return std::nullopt;
    const std::size_t end = std::min(text.find('\n', position), text.size());
    std::string_view line = text.substr(position, end - position);
    position = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

NrrdHeader readHeader(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error("cannot be opened", path.string());
    std::string text(kHeaderLimit, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (!text.starts_with("NRRD000"))
        throw Error("not a NRRD file", path.string(), "it must begin with NRRD");

    NrrdHeader header{HeaderText("NRRD", path.string()), 0, {}};
    nextLine(text, header.bytes);
    bool listed = false;
    for (;;) {
        const auto line = nextLine(text, header.bytes);
        if (!line) {
            // The header of other files may simply end.
            if (header.fields.find({"data file", "datafile"}) && text.size() < kHeaderLimit) return header;
            header.fields.fail("it ends early");
        }
        if (listed) {
            if (const std::string_view name = trimmed(*line); !name.empty())
                header.dataFiles.emplace_back(name);
            continue;
        }
        if (line->empty()) return header;
        if (line->starts_with('#') || line->find(":=") != std::string_view::npos) continue;
        const std::size_t colon = line->find(": ");
        if (colon == std::string_view::npos)
            header.fields.fail("\"" + std::string(line->substr(0, 40)) + "\" is no field");
        header.fields.add(lowerCase(trimmed(line->substr(0, colon))),
                          std::string(trimmed(line->substr(colon + 2))));
        listed = header.fields.find({"data file", "datafile"}).value_or("").starts_with("LIST");
    }
}

SampleType sampleType(const HeaderText& fields) {
    static const std::map<std::string, SampleType, std::less<>> kTypes = {
        {"signed char", SampleType::i8},
        {"int8", SampleType::i8},
        {"int8_t", SampleType::i8},
        {"uchar", SampleType::u8},
        {"unsigned char", SampleType::u8},
        {"uint8", SampleType::u8},
        {"uint8_t", SampleType::u8},
        {"short", SampleType::i16},
        {"short int", SampleType::i16},
        {"signed short", SampleType::i16},
        {"signed short int", SampleType::i16},
        {"int16", SampleType::i16},
        {"int16_t", SampleType::i16},
        {"ushort", SampleType::u16},
        {"unsigned short", SampleType::u16},
        {"unsigned short int", SampleType::u16},
        {"uint16", SampleType::u16},
        {"uint16_t", SampleType::u16},
        {"int", SampleType::i32},
        {"signed int", SampleType::i32},
        {"int32", SampleType::i32},
        {"int32_t", SampleType::i32},
        {"uint", SampleType::u32},
        {"unsigned int", SampleType::u32},
        {"uint32", SampleType::u32},
        {"uint32_t", SampleType::u32},
        {"longlong", SampleType::i64},
        {"long long", SampleType::i64},
        {"long long int", SampleType::i64},
        {"int64", SampleType::i64},
        {"int64_t", SampleType::i64},
        {"ulonglong", SampleType::u64},
        {"unsigned long long", SampleType::u64},
        {"unsigned long long int", SampleType::u64},
        {"uint64", SampleType::u64},
        {"uint64_t", SampleType::u64},
        {"float", SampleType::f32},
        {"double", SampleType::f64}};
    const std::string type = lowerCase(fields.require({"type"}));
    const auto found = kTypes.find(type);
    if (found == kTypes.end()) fields.fail("the type \"" + type + "\" is no plain number");
    return found->second;
}

/// A value of each axis that may be missing: "none", "nan", "???".
std::vector<double> perAxis(const HeaderText& fields, std::initializer_list<std::string_view> keys,
                            std::size_t rank) {
    const auto text = fields.find(keys);
    std::vector<double> values(rank, kUnknown);
    if (!text) return values;
    const std::vector<std::string_view> all = words(*text);
    if (all.size() != rank)
        fields.fail("\"" + std::string(*keys.begin()) + "\" has " + std::to_string(all.size()) +
                    " values for " + std::to_string(rank) + " axes");
    for (std::size_t i = 0; i < rank; ++i) values[i] = numberOf(all[i]).value_or(kUnknown);
    return values;
}

/// "(a,b,c)" as a vector.
glm::dvec3 vectorOf(std::string_view text, const HeaderText& fields) {
    std::string inner(trimmed(text));
    if (!inner.starts_with('(') || !inner.ends_with(')')) fields.fail("\"" + inner + "\" is no vector");
    inner = inner.substr(1, inner.size() - 2);
    std::ranges::replace(inner, ',', ' ');
    const auto parts = words(inner);
    glm::dvec3 vector;
    if (parts.size() != 3) fields.fail("a vector has " + std::to_string(parts.size()) + " components, not 3");
    for (int i = 0; i < 3; ++i) {
        const auto number = numberOf(parts[static_cast<std::size_t>(i)]);
        if (!number) fields.fail("\"" + inner + "\" is no vector");
        vector[i] = *number;
    }
    return vector;
}

/// Vectors and "none", one an axis; blanks may stand within the brackets.
std::vector<std::optional<glm::dvec3>> directions(const HeaderText& fields, std::size_t rank) {
    std::vector<std::optional<glm::dvec3>> found;
    std::string_view text = trimmed(*fields.find({"space directions"}));
    while (!text.empty()) {
        if (text.starts_with('(')) {
            const std::size_t end = text.find(')');
            if (end == std::string_view::npos) fields.fail("\"space directions\" lacks a bracket");
            found.emplace_back(vectorOf(text.substr(0, end + 1), fields));
            text = trimmed(text.substr(end + 1));
        } else {
            found.emplace_back();
            text = trimmed(text.substr(std::min(text.size(), words(text).front().size())));
        }
    }
    if (found.size() != rank)
        fields.fail("\"space directions\" has " + std::to_string(found.size()) + " values for " +
                    std::to_string(rank) + " axes");
    return found;
}

/// Which axis of four counts the key frames: the one without a direction in space, or of another kind than
/// the others, else the last.
std::size_t timeAxis(const HeaderText& fields) {
    std::optional<std::size_t> axis;
    if (fields.find({"space directions"})) {
        const auto all = directions(fields, 4);
        for (std::size_t i = 0; i < 4; ++i) {
            if (all[i]) continue;
            if (axis) fields.fail("two axes have no direction in space");
            axis = i;
        }
    }
    if (const auto text = fields.find({"kinds"})) {
        const auto kinds = words(*text);
        if (kinds.size() != 4) fields.fail("\"kinds\" has not 4 values");
        for (std::size_t i = 0; i < 4; ++i) {
            const std::string kind = lowerCase(kinds[i]);
            if (kind == "time" || kind == "list") {
                axis = axis.value_or(i);
                if (*axis != i) fields.fail("axis " + std::to_string(i + 1) + " is no time axis");
            } else if (kind != "space" && kind != "domain" && kind != "???" && kind != "none") {
                fields.fail("axis " + std::to_string(i + 1) + " has the kind \"" + kind + "\"",
                            "time series of one value a sample can be read");
            }
        }
    }
    return axis.value_or(3);
}

/// Start and step along an axis that has no direction in space.
std::array<double, 2> startAndStep(const HeaderText& fields, std::size_t axis, std::size_t rank,
                                   std::uint64_t length) {
    const double spacing = perAxis(fields, {"spacings"}, rank)[axis];
    const double low = perAxis(fields, {"axis mins", "axismins"}, rank)[axis];
    const double high = perAxis(fields, {"axis maxs", "axismaxs"}, rank)[axis];
    const auto centers = fields.find({"centers", "centerings"});
    const auto center = centers && words(*centers).size() == rank ? lowerCase(words(*centers)[axis]) : "node";
    const bool cells = center == "cell";
    double step = spacing;
    if (std::isnan(step) && !std::isnan(low) && !std::isnan(high))
        step = (high - low) / static_cast<double>(cells ? length : length - 1);
    // The limits of cells lie half a step outside their samples.
    const double start = std::isnan(low) ? 0 : low + (cells && !std::isnan(step) ? step / 2 : 0);
    return {start, step};
}

/// Coordinates that count left and posterior are turned to right and anterior.
AffinePlace inRas(AffinePlace place, const HeaderText& fields, std::vector<std::string>& notes) {
    const std::string space = lowerCase(fields.find({"space"}).value_or(""));
    if (space == "left-posterior-superior" || space == "lps") {
        notes.push_back(
            "The file counts left, posterior, superior; x and y are negated, so that they count right and "
            "anterior");
        return turnedAboutZ(place);
    }
    if (space == "left-anterior-superior" || space == "las") {
        notes.push_back("The file counts left, anterior, superior; x is negated, so that it counts right");
        place.origin.x = -place.origin.x;
        for (glm::dvec3& step : place.steps) step.x = -step.x;
        return place;
    }
    const bool plain = space.empty() || space == "right-anterior-superior" || space == "ras" ||
                       space == "scanner-xyz" || space == "3d-right-handed";
    if (!plain) notes.push_back("The coordinates are those of the file's space, " + space);
    return place;
}

AffinePlace placeOf(const HeaderText& fields, const RawLayout& layout,
                    const std::vector<std::size_t>& spatial, std::vector<std::string>& notes) {
    const std::size_t rank = layout.lengths.size();
    AffinePlace place;
    if (fields.find({"space directions"})) {
        const auto all = directions(fields, rank);
        for (std::size_t i = 0; i < 3; ++i) {
            if (!all[spatial[i]]) fields.fail("an axis of space has no direction");
            place.steps[i] = *all[spatial[i]];
        }
        if (const auto origin = fields.find({"space origin"})) place.origin = vectorOf(*origin, fields);
        return inRas(place, fields, notes);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [start, step] = startAndStep(fields, spatial[i], rank, layout.lengths[spatial[i]]);
        const int axis = static_cast<int>(i);
        place.origin[axis] = start;
        if (!std::isnan(step)) place.steps[i] *= step;
    }
    return place;
}

void readPayloadPlace(const NrrdHeader& header, const std::filesystem::path& path, RawFile& file) {
    const HeaderText& fields = header.fields;
    const std::string encoding = lowerCase(fields.require({"encoding"}));
    file.place.compressed = encoding == "gzip" || encoding == "gz";
    if (!file.place.compressed && encoding != "raw")
        fields.fail("the encoding \"" + encoding + "\" cannot be read", "raw and gzip can");
    if (const auto lines = fields.find({"line skip", "lineskip"}); lines && countOf(*lines) != 0u)
        fields.fail("\"line skip\" cannot be read");
    if (const auto skip = fields.find({"byte skip", "byteskip"})) {
        file.place.atEnd = *skip == "-1";
        const auto bytes = countOf(*skip);
        if ((!file.place.atEnd && !bytes) || (file.place.atEnd && file.place.compressed))
            fields.fail("\"byte skip\" is " + std::string(*skip));
        (file.place.compressed ? file.place.skip : file.place.start) = bytes.value_or(0);
    }
    const auto data = fields.find({"data file", "datafile"});
    if (!data) {
        file.files = {path};
        file.place.start += header.bytes;
        return;
    }
    const auto parts = words(*data);
    if (data->starts_with("LIST")) {
        file.files = listedFiles(header.dataFiles, fields);
    } else if (data->find('%') != std::string_view::npos && parts.size() >= 4) {
        std::array<std::int64_t, 3> numbers{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto number = numberOf(parts[i + 1]);
            if (!number || std::abs(*number) > 1e9)
                fields.fail("\"data file\" has no numbers after its pattern");
            numbers[i] = static_cast<std::int64_t>(*number);
        }
        file.files = numberedFiles(parts[0], numbers[0], numbers[1], numbers[2], fields);
    } else {
        file.files = listedFiles({std::string(*data)}, fields);
    }
}

/// Units of the axes of space, in quotes, one an axis of the world: "space units: "mm" "mm" "mm"".
std::vector<std::string> quotedUnits(const HeaderText& fields) {
    std::vector<std::string> units;
    std::string_view text = fields.find({"space units"}).value_or("");
    for (std::size_t open = text.find('"'); open != std::string_view::npos; open = text.find('"')) {
        const std::size_t close = text.find('"', open + 1);
        if (close == std::string_view::npos) break;
        units.emplace_back(text.substr(open + 1, close - open - 1));
        text.remove_prefix(close + 1);
    }
    return units;
}

void describeTimes(const HeaderText& fields, RawFile& file) {
    const std::uint64_t frames = file.layout.frames();
    std::array<double, 2> times{0, kUnknown};
    if (file.layout.time) times = startAndStep(fields, *file.layout.time, file.layout.lengths.size(), frames);
    file.knowsTimes = times[1] > 0;
    for (std::uint64_t i = 0; i < frames; ++i)
        file.description.time.times.push_back(file.knowsTimes ? times[0] + static_cast<double>(i) * times[1]
                                                              : static_cast<double>(i));
}

}  // namespace

std::unique_ptr<FileSource> openNrrd(const std::filesystem::path& path, const std::string& variable) {
    refuseVariable(variable, "NRRD");
    const NrrdHeader header = readHeader(path);
    const HeaderText& fields = header.fields;
    const auto rank = countOf(fields.require({"dimension"}));
    if (rank != 3u && rank != 4u) fields.fail("\"dimension\" must be 3 or 4");

    RawFile file;
    RawLayout& layout = file.layout;
    layout.type = sampleType(fields);
    layout.lengths = fields.requireCounts({"sizes"}, *rank);
    const std::string endian = lowerCase(fields.find({"endian"}).value_or(""));
    if (endian.empty() && bytesPerSample(layout.type) > 1) fields.fail("the field \"endian\" is missing");
    if (!endian.empty() && endian != "little" && endian != "big")
        fields.fail("\"endian\" is neither little nor big");
    layout.bigEndian = endian == "big";
    if (*rank == 4) layout.time = timeAxis(fields);

    std::vector<std::size_t> spatial;
    for (std::size_t i = 0; i < *rank; ++i)
        if (layout.time != i) spatial.push_back(i);
    const auto dims = requireSizes(layout, path.string());
    SeriesDescription& description = file.description;
    const OrientedAxes axes =
        orient(placeOf(fields, layout, spatial, description.notes), dims, path.string());
    for (std::size_t i = 0; i < 3; ++i) layout.axes[i] = spatial[axes.axes[i]];
    description.lattice = axes.lattice;
    description.notes.insert(description.notes.end(), axes.notes.begin(), axes.notes.end());
    if (const auto units = quotedUnits(fields); units.size() == 3)
        for (std::size_t i = 0; i < 3; ++i) description.lattice.axes[i].units = units[i];
    describeTimes(fields, file);
    readPayloadPlace(header, path, file);
    description.name = path.stem().string();
    description.units = std::string(fields.find({"sample units", "sampleunits"}).value_or(""));
    description.provenance = path.filename().string() + ", NRRD";
    if (const auto content = fields.find({"content"})) description.provenance += ": " + std::string(*content);
    return openRawFile(std::move(file));
}

}  // namespace isoglass
