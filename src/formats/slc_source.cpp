#include "base/error.h"
#include "formats/header_text.h"
#include "formats/medical_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

// SLC, the format of VolVis (State University of New York at Stony Brook): a text header, an icon in three
// colours, and the slices, each by itself as run lengths where the header says so.

namespace isoglass {

namespace {

/// Walks through the bytes of a file.
class SlcParser {
  public:
    explicit SlcParser(const std::filesystem::path& file) : file_(file.string()) {
        std::ifstream stream(file, std::ios::binary);
        if (!stream) throw Error("cannot be opened", file_);
        bytes_.assign(std::istreambuf_iterator<char>(stream), {});
    }

    double number() {
        const std::string_view word = nextWord();
        const auto value = numberOf(word);
        if (!value || !std::isfinite(*value)) fail("a number is missing in the header");
        return *value;
    }

    std::uint64_t count() {
        const std::string_view word = nextWord();
        const auto value = countOf(word);
        if (!value) fail("a whole number is missing in the header");
        return *value;
    }

    /// The letter X after a blank, which ends a text part.
    void mark() {
        if (nextWord(1) != "X") fail("a mark X is missing");
    }

    std::string_view take(std::uint64_t count) {
        if (count > bytes_.size() - position_)
            fail(std::to_string(count) + " bytes are announced, but " +
                 std::to_string(bytes_.size() - position_) + " follow");
        const std::string_view taken = std::string_view(bytes_).substr(position_, count);
        position_ += count;
        return taken;
    }

    bool atEnd() const { return position_ == bytes_.size(); }
    std::size_t left() const { return bytes_.size() - position_; }
    const std::string& file() const { return file_; }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error("SLC: " + what, file_ + ", byte " + std::to_string(position_),
                    "the file may be cut off or damaged");
    }

  private:
    std::string_view nextWord(std::size_t longest = 40) {
        constexpr std::string_view kBlanks = " \t\r\n";
        const std::string_view text(bytes_);
        const std::size_t first = text.find_first_not_of(kBlanks, position_);
        if (first == std::string_view::npos) fail("it ends early");
        std::size_t end = std::min(text.find_first_of(kBlanks, first), text.size());
        end = std::min(end, first + longest);
        position_ = end;
        return text.substr(first, end - first);
    }

    std::string file_;
    std::string bytes_;
    std::size_t position_ = 0;
};

/// Run lengths: a byte with the count in its lower 7 bits, and the top bit set where as many bytes follow
/// as they are, clear where one byte is repeated; a count of 0 ends the slice.
void unpackSlice(std::string_view packed, std::size_t pixels, std::string& out, const SlcParser& parser) {
    const std::size_t end = out.size() + pixels;
    std::size_t i = 0;
    const auto next = [&] {
        if (i == packed.size()) parser.fail("a slice ends early");
        return static_cast<unsigned char>(packed[i++]);
    };
    for (unsigned code = next(); (code & 0x7f) != 0; code = next()) {
        const std::size_t run = code & 0x7f;
        if (run > end - out.size()) parser.fail("a slice holds more samples than announced");
        if (code & 0x80) {
            for (std::size_t k = 0; k < run; ++k) out += static_cast<char>(next());
        } else {
            out.append(run, static_cast<char>(next()));
        }
    }
    if (out.size() != end) parser.fail("a slice holds fewer samples than announced");
    if (i != packed.size()) parser.fail("a slice is longer than its run lengths");
}

class SlcSource final : public FileSource {
  public:
    explicit SlcSource(const std::filesystem::path& path) {
        SlcParser parser(path);
        if (parser.count() != 11111)
            throw Error("not an SLC file", path.string(), "it must begin with 11111");
        std::array<std::uint64_t, 3> dims{};
        for (std::uint64_t& length : dims) length = parser.count();
        if (const std::uint64_t bits = parser.count(); bits != 8)
            parser.fail(std::to_string(bits) + " bits a sample: 8 are possible");
        requireVolume(dims, path.string());
        std::array<double, 3> spacing{};
        for (double& step : spacing) {
            step = parser.number();
            if (step <= 0) parser.fail("the spacing must be positive");
        }
        parser.count();  // unit of length; its codes are not documented
        parser.count();  // where the data come from: simulated, sampled, ...
        parser.count();  // what was done to them
        const bool packed = isPacked(parser);
        skipIcon(parser);
        readSlices(parser, dims, packed);
        describe(path, dims, spacing);
    }

    const SeriesDescription& description() const override { return description_; }
    bool knowsTimes() const override { return false; }
    void read(std::size_t, std::span<float> samples) override {
        std::ranges::transform(samples_, samples.begin(), [](char sample) {
            return static_cast<float>(static_cast<unsigned char>(sample));
        });
    }

  private:
    static bool isPacked(SlcParser& parser) {
        const std::uint64_t compression = parser.count();
        if (compression > 1)
            parser.fail("compression " + std::to_string(compression) + " is unknown: 0 or 1");
        return compression == 1;
    }

    static void skipIcon(SlcParser& parser) {
        const std::uint64_t width = parser.count();
        const std::uint64_t height = parser.count();
        parser.mark();
        if (width > kLongestAxis || height > kLongestAxis) parser.fail("the icon is too large");
        parser.take(3 * width * height);
    }

    void readSlices(SlcParser& parser, const std::array<std::uint64_t, 3>& dims, bool packed) {
        const std::uint64_t pixels = dims[0] * dims[1];
        // Two bytes hold 127 samples at best.
        const std::uint64_t most = packed ? parser.left() * 64 : parser.left();
        if (pixels * dims[2] > most)
            parser.fail("the header announces " + std::to_string(pixels * dims[2]) +
                        " samples, but at most " + std::to_string(most) + " follow");
        samples_.reserve(pixels * dims[2]);
        for (std::uint64_t slice = 0; slice < dims[2]; ++slice) {
            if (packed) {
                const std::uint64_t bytes = parser.count();
                parser.mark();
                unpackSlice(parser.take(bytes), pixels, samples_, parser);
            } else {
                samples_ += parser.take(pixels);
            }
        }
        if (!parser.atEnd()) parser.fail("bytes follow the last slice");
    }

    void describe(const std::filesystem::path& path, const std::array<std::uint64_t, 3>& dims,
                  const std::array<double, 3>& spacing) {
        for (std::size_t k = 0; k < 3; ++k) {
            Axis& axis = description_.lattice.axes[k];
            axis.name = std::string(1, "xyz"[k]);
            for (std::uint64_t i = 0; i < dims[k]; ++i)
                axis.coordinates.push_back(static_cast<double>(i) * spacing[k]);
        }
        description_.name = path.stem().string();
        description_.time.times = {0};
        description_.provenance = path.filename().string() + ", SLC";
    }

    SeriesDescription description_;
    std::string samples_;
};

}  // namespace

std::unique_ptr<FileSource> openSlc(const std::filesystem::path& file, const std::string& variable) {
    refuseVariable(variable, "SLC");
    return std::make_unique<SlcSource>(file);
}

}  // namespace isoglass
