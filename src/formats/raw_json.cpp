#include "formats/raw_json.h"

#include "base/error.h"
#include "formats/file_names.h"
#include "formats/raw_samples.h"
#include "scene/json_document.h"
#include "scene/scene_format.h"
#include "volume/import_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

namespace isoglass {

namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 16> kRootKeys = {
    "format", "version", "name", "long_name", "units",   "files", "gzip",    "skip",
    "type",   "endian",  "dims", "origin",    "spacing", "axes",  "missing", "time"};
constexpr std::array<std::string_view, 5> kAxisKeys = {"name", "units", "coordinates", "negated", "period"};
constexpr std::array<std::string_view, 4> kTimeKeys = {"times", "units", "calendar", "period"};

constexpr std::array<RawObject, 3> kFormat = {RawObject{"", kRootKeys}, RawObject{"/axes/*", kAxisKeys},
                                              RawObject{"/time", kTimeKeys}};

/// A value of the description that knows its place.
class Value {
  public:
    Value(const Json& json, const std::string& file, std::string pointer)
        : json_(json), file_(file), pointer_(std::move(pointer)) {}

    [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
        throw Error(what, jsonPlace(file_, pointer_), hint);
    }

    /// An object with none but these keys.
    const Value& object(std::span<const std::string_view> known) const {
        if (!json_.is_object()) fail("expected an object");
        for (const auto& [key, value] : json_.items())
            if (std::ranges::find(known, key) == known.end())
                at(key, value)
                    .fail("unknown key " + inQuotes(key), "did you mean " +
                                                              inQuotes(closestWord(key, known)) +
                                                              "? Known here: " + listWords(known));
        return *this;
    }

    std::optional<Value> find(const std::string& key) const {
        const auto found = json_.find(key);
        if (found == json_.end()) return std::nullopt;
        return at(key, *found);
    }

    Value require(const std::string& key) const {
        const auto value = find(key);
        if (!value)
            throw Error("the key " + inQuotes(key) + " is missing",
                        jsonPlace(file_, childPointer(pointer_, key)));
        return *value;
    }

    std::string text() const {
        if (!json_.is_string()) fail("expected a text");
        return json_.get<std::string>();
    }

    double number() const {
        const double value = json_.is_number() ? json_.get<double>() : std::nan("");
        if (!std::isfinite(value)) fail("expected a number");
        return value;
    }

    std::uint64_t count(std::uint64_t least, std::uint64_t most) const {
        const std::string expected =
            "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most);
        if (!json_.is_number()) fail(expected);
        const auto value = json_.get<double>();
        if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)) ||
            value != std::floor(value))
            fail(expected);
        return static_cast<std::uint64_t>(value);
    }

    bool truth() const {
        if (!json_.is_boolean()) fail("expected true or false");
        return json_.get<bool>();
    }

    std::size_t choice(std::span<const std::string_view> words) const {
        const std::string word = json_.is_string() ? json_.get<std::string>() : std::string();
        const auto found = std::ranges::find(words, word);
        if (found == words.end()) fail("expected one of " + listWords(words));
        return static_cast<std::size_t>(found - words.begin());
    }

    bool isArray() const { return json_.is_array(); }

    /// The elements of an array; of any length where `count` is 0.
    std::vector<Value> items(std::size_t count = 0) const {
        if (!json_.is_array() || (count != 0 && json_.size() != count) || json_.empty())
            fail("expected an array" +
                 (count != 0 ? " of " + std::to_string(count) : std::string(" that is not empty")));
        std::vector<Value> values;
        for (std::size_t i = 0; i < json_.size(); ++i) values.push_back(at(std::to_string(i), json_[i]));
        return values;
    }

    std::vector<double> numbers(std::size_t count = 0) const {
        std::vector<double> values;
        for (const Value& value : items(count)) values.push_back(value.number());
        return values;
    }

    std::string place() const { return jsonPlace(file_, pointer_); }

  private:
    Value at(const std::string& key, const Json& json) const {
        return {json, file_, childPointer(pointer_, key)};
    }

    const Json& json_;
    const std::string& file_;
    std::string pointer_;
};

std::string textOr(const Value& object, const std::string& key) {
    const auto value = object.find(key);
    return value ? value->text() : std::string();
}

std::optional<double> periodOf(const Value& object, const std::vector<double>& values) {
    const auto period = object.find("period");
    if (!period) return std::nullopt;
    if (!(period->number() > std::abs(values.back() - values.front())))
        period->fail("the period must be longer than what the values span");
    return period->number();
}

Axis readAxis(const Value& value, std::uint64_t length) {
    value.object(kAxisKeys);
    Axis axis;
    axis.name = textOr(value, "name");
    axis.units = textOr(value, "units");
    const Value coordinates = value.require("coordinates");
    axis.coordinates = coordinates.numbers(length);
    const bool descending = axis.descending();
    for (std::size_t i = 1; i < length; ++i) {
        const double step = axis.coordinates[i] - axis.coordinates[i - 1];
        if (!(descending ? step < 0 : step > 0))
            coordinates.items()[i].fail("the coordinates must strictly increase or strictly decrease");
    }
    if (const auto negated = value.find("negated")) axis.negated = negated->truth();
    axis.period = periodOf(value, axis.coordinates);
    return axis;
}

Lattice readLattice(const Value& root, const std::array<std::uint64_t, 3>& dims) {
    Lattice lattice;
    if (const auto axes = root.find("axes")) {
        for (const char* other : {"origin", "spacing"})
            if (const auto value = root.find(other))
                value->fail("\"axes\" says this already", "keep one of the two");
        const auto values = axes->items(3);
        for (std::size_t k = 0; k < 3; ++k) lattice.axes[k] = readAxis(values[k], dims[k]);
        return lattice;
    }
    std::vector<double> origin(3, 0), spacing(3, 1);
    if (const auto value = root.find("origin")) origin = value->numbers(3);
    if (const auto value = root.find("spacing")) {
        spacing = value->numbers(3);
        for (std::size_t k = 0; k < 3; ++k)
            if (spacing[k] == 0) value->items()[k].fail("a spacing must not be 0");
    }
    for (std::size_t k = 0; k < 3; ++k) {
        Axis& axis = lattice.axes[k];
        axis.name = std::string(1, "xyz"[k]);
        for (std::uint64_t i = 0; i < dims[k]; ++i)
            axis.coordinates.push_back(origin[k] + static_cast<double>(i) * spacing[k]);
    }
    return lattice;
}

/// Fills in the time axis and how many key frames there are.
void readTime(const Value& root, std::uint64_t steps, RawFile& file) {
    TimeAxis& axis = file.description.time;
    const auto time = root.find("time");
    if (time) {
        time->object(kTimeKeys);
        axis.units = textOr(*time, "units");
        axis.calendar = textOr(*time, "calendar");
        if (const auto times = time->find("times")) {
            axis.times = times->numbers();
            requireTimes(axis.times, axis.times.size(), times->place());
            if (steps != 0 && axis.times.size() != steps)
                times->fail(std::to_string(axis.times.size()) + " times, but \"dims\" has " +
                            std::to_string(steps) + " key frames");
            file.knowsTimes = true;
        }
    }
    if (axis.times.empty())
        for (std::uint64_t i = 0; i < std::max<std::uint64_t>(steps, 1); ++i)
            axis.times.push_back(static_cast<double>(i));
    if (time) axis.period = periodOf(*time, axis.times);
}

void readFiles(const Value& root, const std::filesystem::path& description, RawFile& file) {
    const Value files = root.require("files");
    std::vector<std::string> names;
    if (files.isArray()) {
        for (const Value& name : files.items()) names.push_back(name.text());
    } else {
        names = {files.text()};
    }
    // A path ends at a zero, which JSON can hold.
    for (const std::string& name : names)
        if (name.empty() || name.find('\0') != std::string::npos)
            files.fail("a name of a file makes no sense");
    for (const std::string& name : names) file.files.push_back(description.parent_path() / name);
    const auto gzip = root.find("gzip");
    const auto skip = root.find("skip");
    file.place.compressed = gzip ? gzip->truth() : isGzip(file.files.front());
    const std::uint64_t bytes = skip ? skip->count(0, std::uint64_t{1} << 53) : 0;
    (file.place.compressed ? file.place.skip : file.place.start) = bytes;
}

RawFile readDescription(const Value& root, const std::filesystem::path& path) {
    root.object(kRootKeys);
    if (root.require("format").text() != "isoglass-raw")
        root.require("format").fail("expected \"isoglass-raw\"");
    if (root.require("version").number() != 1) root.require("version").fail("version 1 can be read");
    RawFile file;
    RawLayout& layout = file.layout;
    layout.type = static_cast<SampleType>(root.require("type").choice(sampleTypeNames()));
    static constexpr std::array<std::string_view, 2> kEndians = {"little", "big"};
    if (const auto endian = root.find("endian"))
        layout.bigEndian = endian->choice(kEndians) == 1;
    else if (bytesPerSample(layout.type) > 1)
        root.require("endian");

    const Value dimsValue = root.require("dims");
    const auto dimsItems = dimsValue.items();
    if (dimsItems.size() != 3 && dimsItems.size() != 4)
        dimsValue.fail("expected an array of 3 numbers, or of 4 with the key frames");
    for (const Value& item : dimsItems) layout.lengths.push_back(item.count(1, kLongestAxis));
    const bool stepsGiven = layout.lengths.size() == 4;
    readTime(root, stepsGiven ? layout.lengths[3] : 0, file);
    if (!stepsGiven) layout.lengths.push_back(file.description.time.times.size());
    layout.time = 3;
    const auto dims = requireSizes(layout, dimsValue.place());

    if (const auto missing = root.find("missing")) layout.missing = missing->number();
    file.description.name = root.find("name") ? root.find("name")->text() : path.stem().string();
    file.description.longName = textOr(root, "long_name");
    file.description.units = textOr(root, "units");
    file.description.lattice = readLattice(root, dims);
    readFiles(root, path, file);
    file.description.provenance = path.filename().string() + ", RAW";
    return file;
}

}  // namespace

std::span<const RawObject> rawFormat() {
    return kFormat;
}

std::unique_ptr<FileSource> openRaw(const std::filesystem::path& path, const std::string& variable) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error("cannot be opened", path.string());
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::string name = path.string();
    const Json json = parseJson(text, name);
    RawFile file = readDescription(Value(json, name, ""), path);
    if (!variable.empty() && variable != file.description.name)
        throw Error("there is no variable \"" + variable + "\"", name,
                    "the file holds \"" + file.description.name + "\"");
    return openRawFile(std::move(file));
}

}  // namespace isoglass
