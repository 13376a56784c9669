#pragma once

#include "formats/file_source.h"
#include "formats/orientation.h"
#include "formats/raw_samples.h"
#include "unit/import/import_check.h"
#include "unit/mesh_io/scratch_folder.h"

#include <glm/geometric.hpp>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <vector>

// Tiny files of every format, all of one field that is known in the world: whatever the order and the
// direction of a file's axes, a sample must have the value of the place where the file says it is.

namespace isoglass::test {

/// The field. Whole numbers for whole places, up to a few hundred.
inline float worldValue(const glm::dvec3& world, double frame) {
    return static_cast<float>(world.x + 10 * world.y + 50 * world.z + 7 * frame);
}

/// An array that no two of whose axes may be confused.
struct SmallArray {
    std::array<std::uint64_t, 3> lengths{5, 4, 3};
    std::uint64_t frames = 2;
    AffinePlace place = {};

    /// First axis fastest, key frames slowest.
    std::vector<float> values() const {
        std::vector<float> values;
        for (std::uint64_t t = 0; t < frames; ++t)
            for (std::uint64_t k = 0; k < lengths[2]; ++k)
                for (std::uint64_t j = 0; j < lengths[1]; ++j)
                    for (std::uint64_t i = 0; i < lengths[0]; ++i)
                        values.push_back(worldValue(place.origin + static_cast<double>(i) * place.steps[0] +
                                                        static_cast<double>(j) * place.steps[1] +
                                                        static_cast<double>(k) * place.steps[2],
                                                    static_cast<double>(t)));
        return values;
    }
};

/// Every sample has the value of its place.
inline void expectWorldValues(FrameSource& source, std::uint64_t frames = 2) {
    const Lattice& lattice = source.description().lattice;
    const glm::ivec3 dims = lattice.dims();
    ASSERT_EQ(source.description().time.times.size(), frames);
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        const std::vector<float> samples = readFrame(source, frame);
        std::size_t i = 0;
        for (int z = 0; z < dims.z; ++z)
            for (int y = 0; y < dims.y; ++y)
                for (int x = 0; x < dims.x; ++x, ++i) {
                    const glm::dvec3 world(lattice.axes[0].coordinate(static_cast<std::size_t>(x)),
                                           lattice.axes[1].coordinate(static_cast<std::size_t>(y)),
                                           lattice.axes[2].coordinate(static_cast<std::size_t>(z)));
                    ASSERT_EQ(samples[i], worldValue(world, static_cast<double>(frame)))
                        << "sample " << x << ' ' << y << ' ' << z << " of key frame " << frame;
                }
    }
}

template <typename Stored>
std::string packed(const std::vector<float>& values, bool bigEndian = false) {
    std::string bytes;
    for (const float value : values) {
        const auto stored = static_cast<Stored>(value);
        std::array<char, sizeof(Stored)> letters;
        std::memcpy(letters.data(), &stored, sizeof(Stored));
        if (bigEndian) std::reverse(letters.begin(), letters.end());
        bytes.append(letters.begin(), letters.end());
    }
    return bytes;
}

/// `windowBits`: 31 makes gzip, 15 zlib.
inline std::string deflated(const std::string& bytes, int windowBits = 31) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, windowBits, 9, Z_DEFAULT_STRATEGY);
    std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(out.size() - stream.avail_out);
    deflateEnd(&stream);
    return out;
}

inline void write(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Puts a number over the bytes at `offset`.
template <typename Number>
void put(std::string& bytes, std::size_t offset, Number number, bool bigEndian = false) {
    std::array<char, sizeof(Number)> letters;
    std::memcpy(letters.data(), &number, sizeof(Number));
    if (bigEndian) std::reverse(letters.begin(), letters.end());
    bytes.replace(offset, sizeof(Number), letters.data(), sizeof(Number));
}

/// NIfTI-1 with 16-bit samples and an sform.
inline std::string niftiBytes(const SmallArray& array, bool bigEndian = false) {
    std::string header(352, '\0');
    put(header, 0, std::int32_t{348}, bigEndian);
    put(header, 40, static_cast<std::int16_t>(array.frames > 1 ? 4 : 3), bigEndian);
    for (std::size_t i = 0; i < 3; ++i)
        put(header, 42 + 2 * i, static_cast<std::int16_t>(array.lengths[i]), bigEndian);
    for (std::size_t i = 3; i < 7; ++i) put(header, 42 + 2 * i, std::int16_t{1}, bigEndian);
    put(header, 48, static_cast<std::int16_t>(array.frames), bigEndian);
    put(header, 70, std::int16_t{4}, bigEndian);
    put(header, 72, std::int16_t{16}, bigEndian);
    for (std::size_t i = 0; i < 4; ++i) put(header, 76 + 4 * i, 1.0f, bigEndian);
    put(header, 92, 2.5f, bigEndian);
    put(header, 108, 352.0f, bigEndian);
    header[123] = 2 + 8;
    put(header, 254, std::int16_t{1}, bigEndian);
    for (int row = 0; row < 3; ++row) {
        const std::size_t offset = 280 + 16 * static_cast<std::size_t>(row);
        for (int axis = 0; axis < 3; ++axis)
            put(header, offset + 4 * static_cast<std::size_t>(axis),
                static_cast<float>(array.place.steps[static_cast<std::size_t>(axis)][row]), bigEndian);
        put(header, offset + 12, static_cast<float>(array.place.origin[row]), bigEndian);
    }
    header.replace(344, 3, "n+1");
    return header + packed<std::int16_t>(array.values(), bigEndian);
}

inline std::string vectorText(const glm::dvec3& vector, const char* separator = " ") {
    std::ostringstream text;
    text << vector.x << separator << vector.y << separator << vector.z;
    return text.str();
}

/// NRRD with the given further fields, each with a line end; time is the last axis where there are two.
inline std::string nrrdBytes(const SmallArray& array, const std::string& fields, bool gzip = false) {
    std::ostringstream text;
    text << "NRRD0005\n# a comment\ntype: short\nendian: little\ndimension: " << (array.frames > 1 ? 4 : 3)
         << "\nsizes: " << array.lengths[0] << ' ' << array.lengths[1] << ' ' << array.lengths[2];
    if (array.frames > 1) text << ' ' << array.frames;
    text << "\nencoding: " << (gzip ? "gzip" : "raw") << '\n' << fields << '\n';
    const std::string payload = packed<std::int16_t>(array.values());
    return text.str() + (gzip ? deflated(payload) : payload);
}

/// The fields that place an array of `nrrdBytes`.
inline std::string nrrdDirections(const SmallArray& array) {
    std::string text = "space directions:";
    for (const glm::dvec3& step : array.place.steps) text += " (" + vectorText(step, ",") + ")";
    if (array.frames > 1) text += " none";
    return text + "\nspace origin: (" + vectorText(array.place.origin, ",") + ")\n";
}

/// MetaImage with the samples in the file; `fields` come before them.
inline std::string metaImageBytes(const SmallArray& array, const std::string& fields = "",
                                  bool zlib = false) {
    const bool series = array.frames > 1;
    std::ostringstream text;
    text << "ObjectType = Image\nNDims = " << (series ? 4 : 3) << "\nBinaryData = True\nTransformMatrix =";
    for (const glm::dvec3& step : array.place.steps)
        text << ' ' << vectorText(step / glm::length(step)) << (series ? " 0" : "");
    if (series) text << " 0 0 0 1";
    text << "\nOffset = " << vectorText(array.place.origin) << (series ? " 100" : "") << "\nElementSpacing =";
    for (const glm::dvec3& step : array.place.steps) text << ' ' << glm::length(step);
    text << (series ? " 0.5" : "") << "\nDimSize = " << array.lengths[0] << ' ' << array.lengths[1] << ' '
         << array.lengths[2];
    if (series) text << ' ' << array.frames;
    text << "\nElementType = MET_SHORT\n"
         << (zlib ? "CompressedData = True\n" : "") << fields << "ElementDataFile = LOCAL\n";
    const std::string payload = packed<std::int16_t>(array.values());
    return text.str() + (zlib ? deflated(payload, 15) : payload);
}

/// SLC with one key frame of bytes, as run lengths or plain.
inline std::string slcBytes(const SmallArray& array, bool runs) {
    std::ostringstream text;
    text << "11111\n"
         << array.lengths[0] << ' ' << array.lengths[1] << ' ' << array.lengths[2] << " 8\n"
         << "1.0 1.0 1.0\n1 6 0 " << (runs ? 1 : 0) << "\n2 1 Xrrggbb";
    const std::string samples = packed<std::uint8_t>(array.values());
    const std::size_t plane = array.lengths[0] * array.lengths[1];
    for (std::uint64_t slice = 0; slice < array.lengths[2]; ++slice) {
        const std::string pixels = samples.substr(slice * plane, plane);
        // All but the last as they are, then a run of one.
        const std::string code = std::string(1, static_cast<char>(0x80 + plane - 1)) +
                                 pixels.substr(0, plane - 1) + '\x01' + pixels.back() + '\0';
        if (runs)
            text << code.size() << " X" << code;
        else
            text << pixels;
    }
    return text.str();
}

}  // namespace isoglass::test
