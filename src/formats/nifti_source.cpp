#include "base/error.h"
#include "formats/medical_images.h"
#include "formats/orientation.h"
#include "formats/raw_samples.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

// The NIfTI-1 data format, R. W. Cox and others, 2004: nifti1.h gives the offsets used here.

namespace isoglass {

namespace {

constexpr std::size_t kHeaderBytes = 348;
constexpr std::int32_t kNifti2HeaderBytes = 540;

/// The numbers of a header, in either byte order.
class NiftiHeader {
  public:
    explicit NiftiHeader(const std::filesystem::path& file) : file_(file.string()) {
        bytes_ = readStart(file, kHeaderBytes);
        if (bytes_.size() < 4) fail("it ends early");
        const auto size = get<std::int32_t>(0);
        swapped_ = size != static_cast<std::int32_t>(kHeaderBytes) && size != kNifti2HeaderBytes;
        if (get<std::int32_t>(0) == kNifti2HeaderBytes)
            throw Error("this is NIfTI-2, which cannot be read", file_, "convert it to NIfTI-1");
        if (get<std::int32_t>(0) != static_cast<std::int32_t>(kHeaderBytes)) fail("it has not 348 bytes");
        if (bytes_.size() < kHeaderBytes) fail("it ends early");
    }

    template <typename Number>
    Number get(std::size_t offset) const {
        std::array<char, sizeof(Number)> number;
        std::memcpy(number.data(), bytes_.data() + offset, sizeof(Number));
        if (swapped_) std::ranges::reverse(number);
        return std::bit_cast<Number>(number);
    }

    /// `size` letters, up to a zero.
    std::string text(std::size_t offset, std::size_t size) const {
        const std::string letters = bytes_.substr(offset, size);
        return letters.substr(0, letters.find('\0'));
    }

    std::int64_t dim(std::size_t i) const { return get<std::int16_t>(40 + 2 * i); }
    double pixdim(std::size_t i) const { return get<float>(76 + 4 * i); }
    bool bigEndian() const { return swapped_ == (std::endian::native == std::endian::little); }
    const std::string& file() const { return file_; }
    [[noreturn]] void fail(const std::string& what) const { throw Error("NIfTI header: " + what, file_); }

  private:
    std::string file_;
    std::string bytes_;
    bool swapped_ = false;
};

SampleType sampleType(const NiftiHeader& header) {
    const int code = header.get<std::int16_t>(70);
    switch (code) {
        case 2:
            return SampleType::u8;
        case 4:
            return SampleType::i16;
        case 8:
            return SampleType::i32;
        case 16:
            return SampleType::f32;
        case 64:
            return SampleType::f64;
        case 256:
            return SampleType::i8;
        case 512:
            return SampleType::u16;
        case 768:
            return SampleType::u32;
        case 1024:
            return SampleType::i64;
        case 1280:
            return SampleType::u64;
        default:
            header.fail("the samples have type " + std::to_string(code) + ", which is no plain number");
    }
}

/// x, y, z, and time where there are several steps.
std::vector<std::uint64_t> lengths(const NiftiHeader& header) {
    const std::int64_t rank = header.dim(0);
    if (rank < 3 || rank > 7) header.fail(std::to_string(rank) + " dimensions: 3 or 4 are possible");
    for (std::int64_t i = 1; i <= rank; ++i)
        if (header.dim(i) < 1)
            header.fail("dimension " + std::to_string(i) + " is " + std::to_string(header.dim(i)));
    for (std::int64_t i = 5; i <= rank; ++i)
        if (header.dim(i) > 1)
            header.fail("dimension " + std::to_string(i) + " is " + std::to_string(header.dim(i)) +
                        ": vectors and statistics cannot be read");
    std::vector<std::uint64_t> found;
    for (std::size_t i = 1; i <= 3; ++i) found.push_back(static_cast<std::uint64_t>(header.dim(i)));
    if (rank > 3 && header.dim(4) > 1) found.push_back(static_cast<std::uint64_t>(header.dim(4)));
    return found;
}

/// Method 3 of nifti1.h: the affine matrix.
AffinePlace placeOfSform(const NiftiHeader& header) {
    AffinePlace place;
    for (int row = 0; row < 3; ++row) {
        const std::size_t offset = 280 + 16 * static_cast<std::size_t>(row);
        for (int axis = 0; axis < 3; ++axis)
            place.steps[axis][row] = header.get<float>(offset + 4 * static_cast<std::size_t>(axis));
        place.origin[row] = header.get<float>(offset + 12);
    }
    return place;
}

/// Method 2: a rotation, kept as the last three parts of a quaternion, and the spacing; `qfac` mirrors the
/// third axis.
AffinePlace placeOfQform(const NiftiHeader& header) {
    const double b = header.get<float>(256), c = header.get<float>(260), d = header.get<float>(264);
    const double rest = 1 - (b * b + c * c + d * d);
    // Rounding of b, c, d to floats may leave a little less than zero.
    if (!(rest > -1e-4)) header.fail("the quaternion of its qform is none");
    const glm::dmat3 rotation =
        glm::mat3_cast(glm::normalize(glm::dquat(std::sqrt(std::max(rest, 0.0)), b, c, d)));
    AffinePlace place;
    for (int axis = 0; axis < 3; ++axis)
        place.steps[axis] = rotation[axis] * std::abs(header.pixdim(static_cast<std::size_t>(axis) + 1));
    if (header.pixdim(0) < 0) place.steps[2] = -place.steps[2];
    place.origin = {header.get<float>(268), header.get<float>(272), header.get<float>(276)};
    return place;
}

/// Method 1: nothing but the spacing.
AffinePlace placeOfSpacing(const NiftiHeader& header) {
    AffinePlace place;
    for (int axis = 0; axis < 3; ++axis)
        place.steps[axis] = place.steps[axis] * std::abs(header.pixdim(static_cast<std::size_t>(axis) + 1));
    return place;
}

OrientedAxes orientation(const NiftiHeader& header, const std::array<std::uint64_t, 3>& dims) {
    const bool hasQform = header.get<std::int16_t>(252) > 0;
    const bool hasSform = header.get<std::int16_t>(254) > 0;
    if (hasSform) {
        try {
            return orient(placeOfSform(header), dims, header.file() + ", sform");
        } catch (const Error& failure) {
            if (!hasQform) throw;
            OrientedAxes axes = orient(placeOfQform(header), dims, header.file() + ", qform");
            axes.notes.insert(axes.notes.begin(),
                              std::string("The qform places the volume, not the sform: ") + failure.what());
            return axes;
        }
    }
    if (hasQform) return orient(placeOfQform(header), dims, header.file() + ", qform");
    OrientedAxes axes = orient(placeOfSpacing(header), dims, header.file());
    axes.notes.push_back("The file has neither sform nor qform; x, y, z are its axes, with their spacing");
    return axes;
}

void describeTimes(const NiftiHeader& header, std::uint64_t frames, RawFile& file) {
    const double step = header.pixdim(4);
    file.knowsTimes = frames > 1 && std::isfinite(step) && step > 0;
    // An offset beside which a step vanishes says nothing.
    const double offset = header.get<float>(136);
    const double start = file.knowsTimes && std::abs(offset) < step * 0x1p50 ? offset : 0;
    for (std::uint64_t i = 0; i < frames; ++i)
        file.description.time.times.push_back(file.knowsTimes ? start + static_cast<double>(i) * step
                                                              : static_cast<double>(i));
    constexpr int kTimeMask = 0x38;
    const int units = header.get<std::uint8_t>(123) & kTimeMask;
    if (file.knowsTimes)
        file.description.time.units = units == 8 ? "s" : units == 16 ? "ms" : units == 24 ? "us" : "";
}

/// The file of the samples: the same for .nii, beside it for a pair.
std::filesystem::path dataFile(const NiftiHeader& header, const std::filesystem::path& file) {
    const std::string magic = header.text(344, 4);
    if (magic == "n+1") return file;
    if (magic != "ni1")
        throw Error("not a NIfTI-1 file: its magic is missing", file.string(), "is it Analyze 7.5?");
    std::filesystem::path data = file;
    if (data.extension() == ".gz") data.replace_extension();
    data.replace_extension(".img");
    std::filesystem::path packed = data;
    packed += ".gz";
    return !std::filesystem::exists(data) && std::filesystem::exists(packed) ? packed : data;
}

}  // namespace

std::unique_ptr<FileSource> openNifti(const std::filesystem::path& path, const std::string& variable) {
    refuseVariable(variable, "NIfTI");
    const NiftiHeader header(path);
    RawFile file;
    file.files = {dataFile(header, path)};
    file.layout.type = sampleType(header);
    file.layout.bigEndian = header.bigEndian();
    file.layout.lengths = lengths(header);
    if (file.layout.lengths.size() == 4) file.layout.time = 3;
    const auto dims = requireSizes(file.layout, header.file());
    const double slope = header.get<float>(112), intercept = header.get<float>(116);
    if (slope != 0 && std::isfinite(slope) && std::isfinite(intercept)) {
        file.layout.slope = slope;
        file.layout.intercept = intercept;
    }

    const double offset = header.get<float>(108);
    const bool single = file.files.front() == path;
    if (!(offset >= (single ? static_cast<double>(kHeaderBytes) : 0) && offset < 1e9) ||
        offset != std::floor(offset))
        header.fail("the samples cannot start at byte " + std::to_string(offset));
    file.place.compressed = isGzip(file.files.front());
    (file.place.compressed ? file.place.skip : file.place.start) = static_cast<std::uint64_t>(offset);

    const OrientedAxes axes = orientation(header, dims);
    file.layout.axes = axes.axes;
    SeriesDescription& description = file.description;
    description.lattice = axes.lattice;
    description.notes = axes.notes;
    const int units = header.get<std::uint8_t>(123) & 7;
    for (Axis& axis : description.lattice.axes)
        axis.units = units == 1 ? "m" : units == 2 ? "mm" : units == 3 ? "um" : "";
    describeTimes(header, file.layout.frames(), file);
    const std::string name = path.filename().string();
    description.name = name.substr(0, name.find('.', 1));
    description.provenance = name + ", NIfTI";
    if (const std::string remark = header.text(148, 80); !remark.empty())
        description.provenance += ": " + remark;
    return openRawFile(std::move(file));
}

}  // namespace isoglass
