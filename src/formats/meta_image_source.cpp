#include "base/error.h"
#include "formats/data_files.h"
#include "formats/header_text.h"
#include "formats/medical_images.h"
#include "formats/orientation.h"
#include "formats/raw_samples.h"

#include <cmath>
#include <fstream>
#include <map>

// MetaImage as ITK writes it: https://itk.org/Wiki/ITK/MetaIO/Documentation

namespace isoglass {

namespace {

constexpr std::size_t kHeaderLimit = std::size_t{1} << 20;

struct MetaHeader {
    HeaderText fields;
    std::uint64_t bytes = 0;             ///< where a payload in the same file starts
    std::vector<std::string> dataFiles;  ///< lines after "ElementDataFile = LIST"
};

MetaHeader readHeader(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error("cannot be opened", path.string());
    std::string text(kHeaderLimit, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));

    MetaHeader header{HeaderText("MetaImage", path.string()), 0, {}};
    while (!header.fields.find({"elementdatafile"})) {
        const std::size_t end = text.find('\n', header.bytes);
        const std::string_view line = std::string_view(text).substr(header.bytes, end - header.bytes);
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) header.fields.fail("it ends without ElementDataFile");
        header.fields.add(lowerCase(trimmed(line.substr(0, equals))),
                          std::string(trimmed(line.substr(equals + 1))));
        header.bytes = end == std::string::npos ? text.size() : end + 1;
    }
    std::string_view rest = std::string_view(text).substr(header.bytes);
    while (header.fields.find({"elementdatafile"})->starts_with("LIST") && !rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
        if (const auto name = trimmed(rest.substr(0, end + 1)); !name.empty())
            header.dataFiles.emplace_back(name);
        rest.remove_prefix(end + 1);
    }
    return header;
}

bool isTrue(const HeaderText& fields, std::initializer_list<std::string_view> keys, bool otherwise) {
    const auto text = fields.find(keys);
    if (!text) return otherwise;
    const std::string value = lowerCase(*text);
    if (value != "true" && value != "false" && value != "1" && value != "0")
        fields.fail("\"" + std::string(*keys.begin()) + "\" is neither True nor False");
    return value == "true" || value == "1";
}

SampleType sampleType(const HeaderText& fields) {
    static const std::map<std::string, SampleType, std::less<>> kTypes = {
        {"met_char", SampleType::i8},        {"met_uchar", SampleType::u8},
        {"met_short", SampleType::i16},      {"met_ushort", SampleType::u16},
        {"met_int", SampleType::i32},        {"met_uint", SampleType::u32},
        {"met_long", SampleType::i32},       {"met_ulong", SampleType::u32},
        {"met_long_long", SampleType::i64},  {"met_float", SampleType::f32},
        {"met_ulong_long", SampleType::u64}, {"met_double", SampleType::f64}};
    const std::string type = lowerCase(fields.require({"elementtype"}));
    const auto found = kTypes.find(type);
    if (found == kTypes.end()) fields.fail("the type \"" + type + "\" is no plain number");
    return found->second;
}

AffinePlace placeOf(const HeaderText& fields, std::size_t rank, std::vector<std::string>& notes) {
    AffinePlace place;
    // Row i of the matrix, as it is written, is the direction of axis i.
    const auto matrix = fields.numbers({"transformmatrix", "rotation", "orientation"}, rank * rank);
    const auto spacing = fields.numbers({"elementspacing", "elementsize"}, rank);
    const auto origin = fields.numbers({"offset", "position", "origin"}, rank);
    for (std::size_t i = 0; i < 3; ++i) {
        const int axis = static_cast<int>(i);
        if (matrix) place.steps[i] = {(*matrix)[i * rank], (*matrix)[i * rank + 1], (*matrix)[i * rank + 2]};
        if (spacing) place.steps[i] *= (*spacing)[i];
        if (origin) place.origin[axis] = (*origin)[i];
    }
    const auto anatomy = fields.find({"anatomicalorientation"});
    if (!anatomy || anatomy->find('?') != std::string_view::npos) return place;
    notes.push_back(
        "Anatomical coordinates of MetaImage count left, posterior, superior; x and y are negated, so that "
        "they count right and anterior");
    return turnedAboutZ(place);
}

void readPayloadPlace(const MetaHeader& header, const std::filesystem::path& path, RawFile& file) {
    const HeaderText& fields = header.fields;
    if (!isTrue(fields, {"binarydata"}, true))
        fields.fail("samples as text cannot be read", "write it with BinaryData = True");
    file.place.compressed = isTrue(fields, {"compresseddata"}, false);
    if (const auto size = fields.find({"headersize"})) {
        file.place.atEnd = *size == "-1";
        const auto bytes = countOf(*size);
        if ((!file.place.atEnd && !bytes) || (file.place.atEnd && file.place.compressed))
            fields.fail("\"HeaderSize\" is " + std::string(*size));
        file.place.start = bytes.value_or(0);
    }
    const std::string_view data = fields.require({"elementdatafile"});
    const auto parts = words(data);
    if (parts.empty()) fields.fail("\"ElementDataFile\" is empty");
    if (lowerCase(data) == "local") {
        file.files = {path};
        file.place.start += header.bytes;
    } else if (parts[0] == "LIST") {
        file.files = listedFiles(header.dataFiles, fields);
    } else if (data.find('%') != std::string_view::npos && parts.size() >= 3) {
        const auto first = numberOf(parts[1]), last = numberOf(parts[2]);
        const auto step = parts.size() > 3 ? numberOf(parts[3]) : 1.0;
        if (!first || !last || !step || std::abs(*first) > 1e9 || std::abs(*last) > 1e9 ||
            std::abs(*step) > 1e9)
            fields.fail("\"ElementDataFile\" has no numbers after its pattern");
        file.files =
            numberedFiles(parts[0], static_cast<std::int64_t>(*first), static_cast<std::int64_t>(*last),
                          static_cast<std::int64_t>(*step), fields);
    } else {
        file.files = listedFiles({std::string(data)}, fields);
    }
}

void describeTimes(const HeaderText& fields, std::size_t rank, RawFile& file) {
    const auto spacing = fields.numbers({"elementspacing", "elementsize"}, rank);
    const auto origin = fields.numbers({"offset", "position", "origin"}, rank);
    file.knowsTimes = rank == 4 && spacing && std::isfinite((*spacing)[3]) && (*spacing)[3] > 0;
    for (std::uint64_t i = 0; i < file.layout.frames(); ++i) {
        const double start = file.knowsTimes && origin ? (*origin)[3] : 0;
        file.description.time.times.push_back(start +
                                              static_cast<double>(i) * (file.knowsTimes ? (*spacing)[3] : 1));
    }
}

}  // namespace

std::unique_ptr<FileSource> openMetaImage(const std::filesystem::path& path, const std::string& variable) {
    refuseVariable(variable, "MetaImage");
    const MetaHeader header = readHeader(path);
    const HeaderText& fields = header.fields;
    const auto rank = countOf(fields.require({"ndims"}));
    if (rank != 3u && rank != 4u) fields.fail("\"NDims\" must be 3 or 4");
    if (const auto channels = fields.find({"elementnumberofchannels"}); channels && countOf(*channels) != 1u)
        fields.fail("it has " + std::string(*channels) + " channels a sample: 1 can be read");

    RawFile file;
    file.layout.type = sampleType(fields);
    file.layout.lengths = fields.requireCounts({"dimsize"}, *rank);
    file.layout.bigEndian = isTrue(fields, {"binarydatabyteordermsb", "elementbyteordermsb"}, false);
    if (*rank == 4) file.layout.time = 3;
    const auto dims = requireSizes(file.layout, path.string());
    SeriesDescription& description = file.description;
    const OrientedAxes axes = orient(placeOf(fields, *rank, description.notes), dims, path.string());
    file.layout.axes = axes.axes;
    description.lattice = axes.lattice;
    description.notes.insert(description.notes.end(), axes.notes.begin(), axes.notes.end());
    describeTimes(fields, *rank, file);
    readPayloadPlace(header, path, file);
    description.name = path.stem().string();
    description.provenance = path.filename().string() + ", MetaImage";
    return openRawFile(std::move(file));
}

}  // namespace isoglass
