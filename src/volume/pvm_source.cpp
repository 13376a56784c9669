#include "base/error.h"
#include "volume/frame_source.h"
#include "volume/import_times.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>

namespace isoglass {

namespace {

/// Longest header that is read in search of its four lines.
constexpr std::size_t kHeaderLimit = 512;
constexpr std::uint64_t kLongestAxis = std::uint64_t{1} << 20;

struct PvmHeader {
    std::array<std::uint64_t, 3> dims{};
    std::array<double, 3> spacing{1, 1, 1};
    std::uint64_t bytesPerSample = 0;
    std::uint64_t payloadOffset = 0;

    std::uint64_t samples() const { return dims[0] * dims[1] * dims[2]; }
};

/// Takes the numbers of a line; nothing where it does not hold exactly `count` of them.
template <typename Number, std::size_t count>
std::optional<std::array<Number, count>> numbersOf(std::string_view line) {
    std::array<Number, count> numbers{};
    for (Number& number : numbers) {
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(' ')));
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
        if (error != std::errc{}) return std::nullopt;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    }
    if (line.find_first_not_of(" \r") != std::string_view::npos) return std::nullopt;
    return numbers;
}

class HeaderParser {
  public:
    HeaderParser(std::string_view text, std::string place) : text_(text), place_(std::move(place)) {}

    PvmHeader parse() {
        readMagic();
        PvmHeader header;
        const auto dims = numbersOf<std::uint64_t, 3>(nextLine());
        if (!dims) fail("the second line is not three dimensions");
        header.dims = *dims;
        for (const std::uint64_t length : header.dims)
            if (length < 2 || length > kLongestAxis)
                fail("an axis of " + std::to_string(length) + " samples: 2 to 2^20 are possible");

        std::string_view line = nextLine();
        if (const auto spacing = numbersOf<double, 3>(line)) {
            header.spacing = *spacing;
            for (const double step : header.spacing)
                if (!std::isfinite(step) || step <= 0) fail("the spacing must be positive");
            line = nextLine();
        }
        const auto bytes = numbersOf<std::uint64_t, 1>(line);
        if (!bytes || ((*bytes)[0] != 1 && (*bytes)[0] != 2)) fail("bytes per sample must be 1 or 2");
        header.bytesPerSample = (*bytes)[0];
        header.payloadOffset = position_;
        return header;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw Error("PVM header: " + what, place_); }

    void readMagic() {
        if (text_.starts_with("DDS v3"))
            throw Error("the file is compressed (DDS)", place_, "decompress it to plain PVM first");
        if (text_.starts_with("PVM3"))
            throw Error("PVM version 3 is not supported", place_, "versions 1 and 2 are");
        const std::string_view magic = nextLine();
        if (magic != "PVM" && magic != "PVM2")
            throw Error("not a PVM file", place_, "its first line must be PVM");
    }

    std::string_view nextLine() {
        const std::size_t end = text_.find('\n', position_);
        if (end == std::string_view::npos) fail("it ends early");
        const std::string_view line = text_.substr(position_, end - position_);
        position_ = end + 1;
        return line;
    }

    std::string_view text_;
    std::string place_;
    std::size_t position_ = 0;
};

PvmHeader readHeader(const std::filesystem::path& path) {
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(path, unreadable)) throw Error("no such file", path.string());
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error("cannot be opened", path.string());
    std::string text(kHeaderLimit, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    const PvmHeader header = HeaderParser(text, path.string()).parse();

    const std::uint64_t expected = header.samples() * header.bytesPerSample;
    const std::uint64_t found = std::filesystem::file_size(path) - header.payloadOffset;
    if (found != expected)
        throw Error("the header announces " + std::to_string(expected) + " bytes of samples, but " +
                        std::to_string(found) + " follow",
                    path.string(), "the file may be cut off or damaged");
    return header;
}

void requireSame(const PvmHeader& header, const PvmHeader& first, const std::filesystem::path& path) {
    const std::string hint = "all files of a sequence must agree";
    if (header.dims != first.dims)
        throw Error("dimensions differ from those of the first file", path.string(), hint);
    if (header.bytesPerSample != first.bytesPerSample)
        throw Error("bytes per sample differ from those of the first file", path.string(), hint);
    if (header.spacing != first.spacing)
        throw Error("the spacing differs from that of the first file", path.string(), hint);
}

class PvmSource final : public FrameSource {
  public:
    PvmSource(std::span<const std::filesystem::path> files, const ImportOptions& options)
        : files_(files.begin(), files.end()) {
        if (files_.empty()) throw Error("no files", "PVM sequence");
        if (!options.variable.empty())
            throw Error("PVM files have no variables", "--variable " + options.variable, "leave it out");
        for (const std::filesystem::path& file : files_) {
            headers_.push_back(readHeader(file));
            requireSame(headers_.back(), headers_.front(), file);
        }
        describe(options.times);
    }

    const SeriesDescription& description() const override { return description_; }

    void read(std::size_t frame, std::span<float> samples) override {
        const std::filesystem::path& path = files_.at(frame);
        const PvmHeader& header = headers_[frame];
        payload_.resize(samples.size() * header.bytesPerSample);
        std::ifstream file(path, std::ios::binary);
        file.seekg(static_cast<std::streamoff>(header.payloadOffset));
        file.read(reinterpret_cast<char*>(payload_.data()), static_cast<std::streamsize>(payload_.size()));
        if (!file)
            throw Error("samples cannot be read", path.string(), "the file has changed since it was opened");
        for (std::size_t i = 0; i < samples.size(); ++i)
            samples[i] = static_cast<float>(
                header.bytesPerSample == 1 ? payload_[i] : payload_[2 * i] << 8 | payload_[2 * i + 1]);
    }

  private:
    void describe(const std::vector<double>& times) {
        const std::string first = files_.front().filename().string();
        description_.name = first.substr(0, first.find('.', 1));
        const PvmHeader& header = headers_.front();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            description_.lattice.axes[axis].name = std::string(1, "xyz"[axis]);
            for (std::uint64_t i = 0; i < header.dims[axis]; ++i)
                description_.lattice.axes[axis].coordinates.push_back(static_cast<double>(i) *
                                                                      header.spacing[axis]);
        }
        description_.time.times = times;
        if (times.empty())
            for (std::size_t i = 0; i < files_.size(); ++i)
                description_.time.times.push_back(static_cast<double>(i));
        requireTimes(description_.time.times, files_.size(), "--times");
        description_.provenance = first + ", PVM";
        if (files_.size() > 1)
            description_.provenance = first + " to " + files_.back().filename().string() + ", PVM, " +
                                      std::to_string(files_.size()) + " files";
    }

    std::vector<std::filesystem::path> files_;
    std::vector<PvmHeader> headers_;
    SeriesDescription description_;
    std::vector<unsigned char> payload_;
};

}  // namespace

std::unique_ptr<FrameSource> openPvm(std::span<const std::filesystem::path> files,
                                     const ImportOptions& options) {
    return std::make_unique<PvmSource>(files, options);
}

}  // namespace isoglass
