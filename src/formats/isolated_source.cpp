#include "formats/isolated_source.h"

#include "base/error.h"
#include "volume/series_json.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <string>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ISOGLASS_SANITIZED 1
#else
#define ISOGLASS_SANITIZED 0
#endif

namespace isoglass {

namespace {

constexpr std::uint64_t kLargestMessage = std::uint64_t{1} << 30;

/// What the parent asks for.
struct Request {
    std::uint64_t frame = 0;
    std::uint64_t heights = 0;  ///< 1: heights instead of samples
};

/// One end of the connection between the two processes. Both return false where the other end is gone.
class Channel {
  public:
    explicit Channel(int socket) : socket_(socket) {}
    ~Channel() { ::close(socket_); }
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;

    int socket() const { return socket_; }

    bool send(const void* data, std::size_t bytes) const {
        const char* from = static_cast<const char*>(data);
        while (bytes > 0) {
            const ssize_t sent = ::send(socket_, from, bytes, MSG_NOSIGNAL);
            if (sent < 0 && errno == EINTR) continue;
            if (sent <= 0) return false;
            from += sent;
            bytes -= static_cast<std::size_t>(sent);
        }
        return true;
    }

    bool receive(void* data, std::size_t bytes) const {
        char* to = static_cast<char*>(data);
        while (bytes > 0) {
            const ssize_t got = ::recv(socket_, to, bytes, 0);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return false;
            to += got;
            bytes -= static_cast<std::size_t>(got);
        }
        return true;
    }

    /// Whether it went well, and a text: the message of the failure if not.
    bool sendText(bool good, const std::string& text) const {
        const std::uint64_t header[2] = {good, text.size()};
        return send(header, sizeof header) && send(text.data(), text.size());
    }

    /// The text; throws Error with it where the other side failed. Nothing where the other end is gone.
    std::optional<std::string> receiveText() const {
        std::uint64_t header[2] = {};
        if (!receive(header, sizeof header) || header[1] > kLargestMessage) return std::nullopt;
        std::string text(header[1], '\0');
        if (!receive(text.data(), text.size())) return std::nullopt;
        if (!header[0]) throw Error(text, "");
        return text;
    }

  private:
    int socket_;
};

// ---- child

void limit(int resource, rlim_t most) {
    rlimit limits{};
    ::getrlimit(static_cast<__rlimit_resource_t>(resource), &limits);
    limits.rlim_cur = std::min(limits.rlim_max, most);
    ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limits);
}

/// Address space that this process has now, in bytes.
std::uint64_t addressSpace() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void confine(int socket, std::uint64_t processorSeconds) {
    // A Ctrl-C goes to both processes; it is the parent that decides, and that cleans up.
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGHUP, SIG_DFL);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    const auto kept = static_cast<unsigned>(socket);
    if (kept > 3) ::close_range(3, kept - 1, 0);
    ::close_range(kept + 1, ~0u, 0);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, processorSeconds);
    const auto memory = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    // The sanitizers' shadow memory is address space too.
    if (!ISOGLASS_SANITIZED) limit(RLIMIT_AS, addressSpace() + memory);
}

std::size_t samplesOf(const SeriesDescription& series) {
    const glm::ivec3 dims = series.lattice.dims();
    return static_cast<std::size_t>(dims.x) * dims.y * dims.z;
}

/// Calls `action`; sends what it throws and returns false.
template <typename Action>
bool guarded(const Channel& channel, const std::string& place, const Action& action) {
    try {
        action();
        return true;
    } catch (const std::bad_alloc&) {
        channel.sendText(
            false, Error("the file asks for more memory than there is", place, "it may be damaged").what());
    } catch (const std::exception& failure) {
        channel.sendText(false, failure.what());
    }
    return false;
}

/// The text form wants records of the key frames, which are not known yet.
std::string textOf(SeriesDescription series) {
    FrameRecord unknown;
    if (series.lattice.heights) unknown.heightsChecksum = 0;
    series.frames.assign(series.time.times.size(), unknown);
    return toJson(series);
}

/// Answers requests until the parent is gone.
void serve(const Channel& channel, const std::string& place,
           const std::function<std::unique_ptr<FrameSource>()>& open) {
    std::unique_ptr<FrameSource> source;
    std::unique_ptr<float[]> samples;
    std::size_t count = 0;
    constexpr std::uint64_t kNone = ~std::uint64_t{0};
    std::uint64_t held = 0;  ///< the key frame whose samples are in `samples`
    const bool opened = guarded(channel, place, [&] {
        source = open();
        SeriesDescription series = source->description();
        count = samplesOf(series);
        samples = std::make_unique_for_overwrite<float[]>(count);
        source->read(0, {samples.get(), count});
        channel.sendText(true, textOf(std::move(series)));
    });
    Request request;
    while (opened && channel.receive(&request, sizeof request)) {
        const bool read = guarded(channel, place, [&] {
            if (request.heights == 0 && held == request.frame) return;
            held = kNone;
            if (request.heights != 0) return source->readHeights(request.frame, {samples.get(), count});
            source->read(request.frame, {samples.get(), count});
            held = request.frame;
        });
        if (read && (!channel.sendText(true, "") || !channel.send(samples.get(), count * sizeof(float))))
            return;
    }
}

// ---- parent

std::uint64_t bytesOf(std::span<const std::filesystem::path> files) {
    std::uint64_t bytes = 0;
    for (const auto& file : files) {
        std::error_code unknown;
        const std::uint64_t size = std::filesystem::file_size(file, unknown);
        if (!unknown) bytes += size;
    }
    return bytes;
}

class IsolatedSource final : public FrameSource {
  public:
    IsolatedSource(std::span<const std::filesystem::path> files,
                   const std::function<std::unique_ptr<FrameSource>()>& open)
        : place_(files.empty() ? std::string() : files.front().string()) {
        if (files.size() > 1) place_ += " and " + std::to_string(files.size() - 1) + " more";
        constexpr std::uint64_t kLeastSeconds = 10, kBytesPerSecond = 1'000'000;
        start(open, kLeastSeconds + bytesOf(files) / kBytesPerSecond);
        try {
            const auto text = channel_->receiveText();
            if (!text) failDead();
            description_ = seriesFromJson(*text, place_);
        } catch (...) {
            stop();
            throw;
        }
        description_.frames.clear();
    }

    ~IsolatedSource() override { stop(); }

    const SeriesDescription& description() const override { return description_; }

    void read(std::size_t frame, std::span<float> samples) override { ask({frame, 0}, samples); }
    void readHeights(std::size_t frame, std::span<float> heights) override { ask({frame, 1}, heights); }

  private:
    void ask(Request request, std::span<float> samples) {
        if (!channel_) throw Error("the reader of the file has failed before", place_);
        if (!channel_->send(&request, sizeof request) || !channel_->receiveText() ||
            !channel_->receive(samples.data(), samples.size_bytes()))
            failDead();
    }

    void start(const std::function<std::unique_ptr<FrameSource>()>& open, std::uint64_t processorSeconds) {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
            throw Error(std::string("cannot start a reader: ") + std::strerror(errno), place_);
        child_ = ::fork();
        if (child_ == 0) {
            confine(ends[1], processorSeconds);
            serve(Channel(ends[1]), place_, open);
            ::_exit(0);
        }
        const int reason = errno;
        ::close(ends[1]);
        channel_ = std::make_unique<Channel>(ends[0]);
        if (child_ < 0) throw Error(std::string("cannot start a reader: ") + std::strerror(reason), place_);
    }

    /// Ends the child and returns its status.
    int stop() {
        int status = 0;
        channel_.reset();
        if (child_ > 0) {
            ::kill(child_, SIGKILL);
            while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
            }
        }
        child_ = -1;
        return status;
    }

    [[noreturn]] void failDead() {
        // It closed its end, so it is dead or dying: wait for its own end before it is killed.
        int status = 0;
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
        }
        child_ = -1;
        channel_.reset();
        std::string how = "ended";
        if (WIFSIGNALED(status))
            how = WTERMSIG(status) == SIGXCPU
                      ? "did not come to an end"
                      : "crashed on it (" + std::string(::strsignal(WTERMSIG(status))) + ")";
        throw Error("the file cannot be read: its reader " + how, place_,
                    "the file may be cut off or damaged");
    }

    std::string place_;
    pid_t child_ = -1;
    std::unique_ptr<Channel> channel_;
    SeriesDescription description_;
};

}  // namespace

std::unique_ptr<FrameSource> openIsolated(std::span<const std::filesystem::path> files,
                                          const std::function<std::unique_ptr<FrameSource>()>& open) {
    return std::make_unique<IsolatedSource>(files, open);
}

}  // namespace isoglass
