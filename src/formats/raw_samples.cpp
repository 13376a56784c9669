#include "formats/raw_samples.h"

#include "base/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace isoglass {

namespace {

constexpr std::array<std::string_view, 10> kTypeNames = {"u8",  "i8",  "u16", "i16", "u32",
                                                         "i32", "u64", "i64", "f32", "f64"};
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Calls `use` with a value of the type's C++ type.
template <typename Use>
void withType(SampleType type, const Use& use) {
    switch (type) {
        case SampleType::u8:
            return use(std::uint8_t{});
        case SampleType::i8:
            return use(std::int8_t{});
        case SampleType::u16:
            return use(std::uint16_t{});
        case SampleType::i16:
            return use(std::int16_t{});
        case SampleType::u32:
            return use(std::uint32_t{});
        case SampleType::i32:
            return use(std::int32_t{});
        case SampleType::u64:
            return use(std::uint64_t{});
        case SampleType::i64:
            return use(std::int64_t{});
        case SampleType::f32:
            return use(float{});
        case SampleType::f64:
            return use(double{});
    }
}

template <typename Stored>
Stored stored(const std::byte* place, bool swapped) {
    std::array<std::byte, sizeof(Stored)> bytes;
    std::memcpy(bytes.data(), place, sizeof(Stored));
    if (swapped) std::ranges::reverse(bytes);
    return std::bit_cast<Stored>(bytes);
}

/// From a stored number to a sample.
class Conversion {
  public:
    explicit Conversion(const RawLayout& layout)
        : swapped_(layout.bigEndian != (std::endian::native == std::endian::big)),
          plain_(layout.slope == 1 && layout.intercept == 0),
          slope_(layout.slope),
          intercept_(layout.intercept),
          missing_(layout.missing) {}

    template <typename Stored>
    float operator()(const std::byte* place) const {
        const auto number = stored<Stored>(place, swapped_);
        if (missing_ && isMissing(number)) return kMissing;
        const auto sample =
            static_cast<float>(plain_ ? number : slope_ * static_cast<double>(number) + intercept_);
        return std::abs(sample) <= kLargestValue ? sample : kMissing;
    }

  private:
    /// 1e20 in a description is the float next to it in a file of floats.
    template <typename Stored>
    bool isMissing(Stored number) const {
        if constexpr (std::is_same_v<Stored, float>) return number == static_cast<float>(*missing_);
        return static_cast<double>(number) == *missing_;
    }

    bool swapped_;
    bool plain_;
    double slope_;
    double intercept_;
    std::optional<double> missing_;
};

class RawSource final : public FileSource {
  public:
    explicit RawSource(RawFile file) : file_(std::move(file)), width_(bytesPerSample(file_.layout.type)) {
        const RawLayout& layout = file_.layout;
        requireSizes(layout, file_.files.front().string());
        if (layout.bytes() % file_.files.size() != 0)
            throw Error(std::to_string(layout.bytes()) + " bytes of samples do not divide into " +
                            std::to_string(file_.files.size()) + " files",
                        file_.files.front().string());
        share_ = layout.bytes() / file_.files.size();
        file_.place.size = share_;
        for (std::size_t i = 0; i < file_.files.size(); ++i) openPart(i);
        arrange();
    }

    const SeriesDescription& description() const override { return file_.description; }
    bool knowsTimes() const override { return file_.knowsTimes; }

    void read(std::size_t frame, std::span<float> samples) override {
        const Conversion convert(file_.layout);
        // No structured binding: Clang 14 does not let lambdas take one along.
        const Extent &fast = spatial_[0], &middle = spatial_[1], &slow = spatial_[2];
        const std::uint64_t frameOffset = frame * timeStride_;
        // Where time is not the slowest axis, a plane of all key frames is read and one of them taken.
        const std::uint64_t planeOffset = timeIsSlowest_ ? frameOffset : 0;
        const std::uint64_t pick = timeIsSlowest_ ? 0 : frameOffset;
        for (std::uint64_t k = 0; k < slow.length; ++k) {
            plane_.resize(slow.stride * width_);
            readBytes((planeOffset + k * slow.stride) * width_, plane_);
            withType(file_.layout.type, [&](auto number) {
                using Stored = decltype(number);
                for (std::uint64_t j = 0; j < middle.length; ++j) {
                    const std::byte* row = plane_.data() + (pick + j * middle.stride) * sizeof(Stored);
                    float* out = samples.data() + k * slow.target + j * middle.target;
                    for (std::uint64_t i = 0; i < fast.length; ++i)
                        out[i * fast.target] =
                            convert.operator()<Stored>(row + i * fast.stride * sizeof(Stored));
                }
            });
        }
    }

  private:
    /// One spatial axis: how far its neighbours lie apart in the payload and in a key frame, in samples.
    struct Extent {
        std::size_t position;
        std::uint64_t length;
        std::uint64_t stride;
        std::uint64_t target;
    };

    void arrange() {
        const RawLayout& layout = file_.layout;
        std::vector<std::uint64_t> strides(layout.lengths.size(), 1);
        for (std::size_t i = 1; i < strides.size(); ++i) strides[i] = strides[i - 1] * layout.lengths[i - 1];
        std::uint64_t target = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t position = layout.axes[axis];
            spatial_[axis] = {position, layout.lengths[position], strides[position], target};
            target *= layout.lengths[position];
        }
        std::ranges::sort(spatial_, {}, &Extent::position);
        timeIsSlowest_ = !layout.time || *layout.time > spatial_[2].position;
        timeStride_ = layout.time ? strides[*layout.time] : 0;
    }

    Payload& openPart(std::size_t part) {
        if (!payload_ || part != part_) {
            payload_ = openPayload(file_.files[part], file_.place);
            part_ = part;
        }
        return *payload_;
    }

    void readBytes(std::uint64_t offset, std::span<std::byte> bytes) {
        while (!bytes.empty()) {
            const std::uint64_t inPart = offset % share_;
            const std::size_t count = std::min<std::uint64_t>(bytes.size(), share_ - inPart);
            openPart(offset / share_).read(inPart, bytes.first(count));
            bytes = bytes.subspan(count);
            offset += count;
        }
    }

    RawFile file_;
    std::size_t width_;
    std::uint64_t share_ = 0;
    std::array<Extent, 3> spatial_{};  ///< fastest in the payload first
    std::uint64_t timeStride_ = 0;
    bool timeIsSlowest_ = true;
    std::unique_ptr<Payload> payload_;  ///< of the part that was asked for last
    std::size_t part_ = 0;
    std::vector<std::byte> plane_;
};

}  // namespace

std::span<const std::string_view> sampleTypeNames() {
    return kTypeNames;
}

std::size_t bytesPerSample(SampleType type) {
    std::size_t bytes = 0;
    withType(type, [&](auto number) { bytes = sizeof number; });
    return bytes;
}

std::uint64_t RawLayout::samples() const {
    std::uint64_t samples = 1;
    for (const std::uint64_t length : lengths) samples *= length;
    return samples;
}

std::array<std::uint64_t, 3> requireSizes(const RawLayout& layout, const std::string& place) {
    std::array<std::uint64_t, 3> dims{};
    std::size_t axis = 0;
    for (std::size_t i = 0; i < layout.lengths.size(); ++i)
        if (layout.time != i) dims.at(axis++) = layout.lengths[i];
    requireVolume(dims, place);
    if (layout.frames() < 1 || layout.frames() > kLongestAxis)
        throw Error(std::to_string(layout.frames()) + " key frames: 1 to 2^20 are possible", place);
    return dims;
}

std::unique_ptr<FileSource> openRawFile(RawFile file) {
    return std::make_unique<RawSource>(std::move(file));
}

}  // namespace isoglass
