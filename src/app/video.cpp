#include "app/video.h"

#include "base/error.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

extern char** environ;

namespace isoglass {

namespace {

/// A fixed number, because x264's output depends on it.
constexpr const char* kEncoderThreads = "2";

std::vector<std::string> encoderArguments(const std::string& file, glm::ivec2 size, double fps) {
    std::ostringstream rate;
    rate.precision(17);
    rate << fps;
    // H.264 with halved chroma wants even sides: an odd side gets one more line.
    // Without -xerror ffmpeg reports success for a file that the disk did not take whole.
    return {"ffmpeg",
            "-hide_banner",
            "-loglevel",
            "error",
            "-nostdin",
            "-xerror",
            "-y",
            "-f",
            "rawvideo",
            "-pixel_format",
            "rgba",
            "-video_size",
            std::to_string(size.x) + "x" + std::to_string(size.y),
            "-framerate",
            rate.str(),
            "-i",
            "pipe:0",
            "-vf",
            "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
            "-c:v",
            "libx264",
            "-preset",
            "medium",
            "-crf",
            "18",
            "-threads",
            kEncoderThreads,
            "-pix_fmt",
            "yuv420p",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "iec61966-2-1",
            "-movflags",
            "+faststart",
            "-fflags",
            "+bitexact",
            "-flags:v",
            "+bitexact",
            "-f",
            "mp4",
            file};
}

pid_t start(const std::vector<std::string>& arguments, int input, const std::string& log) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
    pid_t process = -1;
    const int failure = ::posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure) {
        throw Error(std::string("cannot run ffmpeg: ") + std::strerror(failure), "ffmpeg",
                    "install the package ffmpeg, or render to PNG files");
    }
    return process;
}

}  // namespace

VideoWriter::Log::~Log() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

VideoWriter::VideoWriter(const std::filesystem::path& file, glm::ivec2 size, double fps)
    : file_(file), target_(file), log_{target_.temporaryPath().string() + ".log"} {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(std::strerror(errno), file_.string());
    pipe_ = ends[1];
    // A broken pipe must come back as an error of `write`.
    ::signal(SIGPIPE, SIG_IGN);
    try {
        process_ =
            start(encoderArguments(target_.temporaryPath().string(), size, fps), ends[0], log_.path.string());
    } catch (...) {
        ::close(ends[0]);
        ::close(ends[1]);
        throw;
    }
    ::close(ends[0]);
}

VideoWriter::~VideoWriter() {
    if (process_ > 0) ::kill(process_, SIGTERM);
    waitForEnd();
}

void VideoWriter::add(const Image& image) {
    const char* data = reinterpret_cast<const char*>(image.pixels.data());
    std::size_t left = image.pixels.size() * sizeof(Rgba8);
    while (left > 0) {
        const ssize_t written = ::write(pipe_, data, left);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail();
        data += written;
        left -= static_cast<std::size_t>(written);
    }
}

void VideoWriter::finish() {
    if (waitForEnd() != 0) fail();
    target_.commit();
}

void VideoWriter::fail() {
    waitForEnd();
    std::ifstream log(log_.path);
    std::ostringstream words;
    words << log.rdbuf();
    std::string text = words.str();
    for (char& c : text) c = c == '\n' ? ' ' : c;
    throw Error("ffmpeg failed: " + text, file_.string(), "free some space, or render to PNG files");
}

int VideoWriter::waitForEnd() {
    if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
    int status = 0;
    if (process_ > 0) ::waitpid(std::exchange(process_, -1), &status, 0);
    return status;
}

}  // namespace isoglass
