#include "formats/payload.h"

#include "base/error.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace isoglass {

namespace {

/// Deflate codes 258 bytes in 2 bits at best.
constexpr std::uint64_t kBestDeflate = 1032;

std::ifstream openFile(const std::filesystem::path& file) {
    std::error_code unreadable;
    if (!std::filesystem::exists(file, unreadable)) throw Error("there is no such file", file.string());
    if (!std::filesystem::is_regular_file(file, unreadable)) throw Error("this is no file", file.string());
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error("cannot be opened", file.string());
    return stream;
}

/// The header and what follows disagree.
[[noreturn]] void failSize(std::uint64_t announced, const std::string& found,
                           const std::filesystem::path& file) {
    throw Error(
        "the header announces " + std::to_string(announced) + " bytes of samples, but " + found + " follow",
        file.string(), "the file may be cut off or damaged");
}

class PlainPayload final : public Payload {
  public:
    PlainPayload(const std::filesystem::path& file, const PayloadPlace& place)
        : file_(file), stream_(openFile(file)), start_(place.start) {
        const std::uint64_t size = std::filesystem::file_size(file);
        if (place.atEnd) {
            if (size < place.size) failSize(place.size, std::to_string(size), file);
            start_ = size - place.size;
        } else if (size < start_ || size - start_ != place.size) {
            failSize(place.size, std::to_string(size - std::min(size, start_)), file);
        }
    }

    void read(std::uint64_t offset, std::span<std::byte> bytes) override {
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(start_ + offset));
        stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        if (!stream_)
            throw Error("samples cannot be read", file_.string(), "the file has changed since it was opened");
    }

  private:
    std::filesystem::path file_;
    std::ifstream stream_;
    std::uint64_t start_;
};

/// A gzip (of any number of members) or zlib stream in a file, decompressed in order.
class Inflater {
  public:
    Inflater(const std::filesystem::path& file, std::uint64_t start)
        : file_(file), stream_(openFile(file)), start_(start) {
        // 15 bits of window, and 32: gzip or zlib, whichever it is.
        if (inflateInit2(&inflate_, 15 + 32) != Z_OK) throw Error("no memory to decompress", file.string());
        restart();
    }
    ~Inflater() { inflateEnd(&inflate_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    void restart() {
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(start_));
        inflateReset(&inflate_);
        inflate_.avail_in = 0;
        ended_ = false;
        position_ = 0;
    }

    std::uint64_t position() const { return position_; }

    /// The next bytes, fewer only where the stream ends.
    std::size_t read(std::span<std::byte> bytes) {
        std::size_t done = 0;
        while (done < bytes.size() && !ended_) {
            const std::size_t wanted = std::min<std::size_t>(bytes.size() - done, 1u << 30);
            inflate_.next_out = reinterpret_cast<Bytef*>(bytes.data() + done);
            inflate_.avail_out = static_cast<uInt>(wanted);
            step();
            done += wanted - inflate_.avail_out;
        }
        position_ += done;
        return done;
    }

  private:
    void step() {
        if (!fill()) fail("it ends early");
        const int result = inflate(&inflate_, Z_NO_FLUSH);
        if (result == Z_STREAM_END) {
            ended_ = !fill();
            if (!ended_) inflateReset(&inflate_);
        } else if (result != Z_OK && result != Z_BUF_ERROR) {
            fail(inflate_.msg ? inflate_.msg : "unknown method");
        }
    }

    /// False where the file has no more bytes.
    bool fill() {
        if (inflate_.avail_in > 0) return true;
        stream_.read(reinterpret_cast<char*>(block_.data()), static_cast<std::streamsize>(block_.size()));
        inflate_.next_in = block_.data();
        inflate_.avail_in = static_cast<uInt>(stream_.gcount());
        return inflate_.avail_in > 0;
    }

    [[noreturn]] void fail(const std::string& reason) const {
        throw Error("the compressed data are damaged: " + reason, file_.string(),
                    "the file may be cut off or damaged");
    }

    std::filesystem::path file_;
    std::ifstream stream_;
    std::uint64_t start_;
    z_stream inflate_{};
    std::vector<Bytef> block_ = std::vector<Bytef>(std::size_t{1} << 16);
    bool ended_ = false;
    std::uint64_t position_ = 0;
};

class CompressedPayload final : public Payload {
  public:
    CompressedPayload(const std::filesystem::path& file, const PayloadPlace& place)
        : file_(file), place_(place), inflater_(file, place.start) {
        const std::uint64_t size = std::filesystem::file_size(file);
        const std::uint64_t most = (size - std::min(size, place.start)) * kBestDeflate;
        if (place.size > most) failSize(place.size, "at most " + std::to_string(most), file);
    }

    void read(std::uint64_t offset, std::span<std::byte> bytes) override {
        skipTo(place_.skip + offset);
        if (const std::size_t done = inflater_.read(bytes); done < bytes.size())
            failSize(place_.size, std::to_string(offset + done), file_);
        if (offset + bytes.size() == place_.size) requireEnd();
    }

  private:
    void skipTo(std::uint64_t position) {
        if (position < inflater_.position()) inflater_.restart();
        std::vector<std::byte> skipped(std::size_t{1} << 16);
        while (inflater_.position() < position) {
            const std::uint64_t left = position - inflater_.position();
            const std::span block(skipped.data(), std::min<std::uint64_t>(left, skipped.size()));
            if (inflater_.read(block) < block.size())
                failSize(place_.size,
                         std::to_string(inflater_.position() - std::min(inflater_.position(), place_.skip)),
                         file_);
        }
    }

    /// Reads on until the stream ends, which is where its checksum is compared.
    void requireEnd() {
        std::byte further;
        if (inflater_.read({&further, 1}) > 0) {
            inflater_.restart();
            failSize(place_.size, "more", file_);
        }
    }

    std::filesystem::path file_;
    PayloadPlace place_;
    Inflater inflater_;
};

}  // namespace

std::unique_ptr<Payload> openPayload(const std::filesystem::path& file, const PayloadPlace& place) {
    if (place.compressed) return std::make_unique<CompressedPayload>(file, place);
    return std::make_unique<PlainPayload>(file, place);
}

bool isGzip(const std::filesystem::path& file) {
    std::array<char, 2> magic{};
    std::ifstream stream(file, std::ios::binary);
    return stream.read(magic.data(), magic.size()) && magic[0] == '\x1f' && magic[1] == '\x8b';
}

std::string readStart(const std::filesystem::path& file, std::size_t limit) {
    std::string text(limit, '\0');
    if (isGzip(file)) {
        text.resize(Inflater(file, 0).read(std::as_writable_bytes(std::span(text))));
    } else {
        std::ifstream stream = openFile(file);
        stream.read(text.data(), static_cast<std::streamsize>(limit));
        text.resize(static_cast<std::size_t>(stream.gcount()));
    }
    return text;
}

}  // namespace isoglass
