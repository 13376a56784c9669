#include "app/ffmpeg.h"

#include "app/stop_signal.h"
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

extern char** environ;

namespace isoglass {

namespace {

pid_t start(const std::vector<std::string>& arguments, int input, const std::string& log) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
    // A group of its own: the terminal's Ctrl-C is for us, and ffmpeg would end the film with it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = -1;
    const int failure = ::posix_spawnp(&process, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (failure) {
        throw Error(std::string("cannot run ffmpeg: ") + std::strerror(failure), "ffmpeg",
                    "install the package ffmpeg, or render to PNG files");
    }
    return process;
}

}  // namespace

Ffmpeg::Log::~Log() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

Ffmpeg::Ffmpeg(std::vector<std::string> arguments, std::filesystem::path out,
               const std::filesystem::path& temporary)
    : out_(std::move(out)), log_{temporary.string() + ".log"} {
    // Without -xerror ffmpeg reports success for a file that the disk did not take whole.
    const std::vector<std::string> always = {"ffmpeg",   "-hide_banner", "-loglevel", "error",
                                             "-nostdin", "-xerror",      "-y"};
    arguments.insert(arguments.begin(), always.begin(), always.end());
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(std::strerror(errno), out_.string());
    // A broken pipe must come back as an error of `write`.
    ::signal(SIGPIPE, SIG_IGN);
    try {
        process_ = start(arguments, ends[0], log_.path.string());
    } catch (...) {
        ::close(ends[0]);
        ::close(ends[1]);
        throw;
    }
    ::close(ends[0]);
    pipe_ = ends[1];
    setChildToStop(process_);
}

Ffmpeg::~Ffmpeg() {
    if (process_ > 0) ::kill(process_, SIGTERM);
    waitForEnd();
}

void Ffmpeg::write(const void* data, std::size_t size) {
    const auto* next = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::write(pipe_, next, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail();
        next += written;
        size -= static_cast<std::size_t>(written);
    }
}

void Ffmpeg::finish() {
    if (waitForEnd() != 0) fail();
}

void Ffmpeg::fail() {
    waitForEnd();
    std::ifstream log(log_.path);
    std::ostringstream words;
    words << log.rdbuf();
    std::string text = words.str();
    for (char& c : text) c = c == '\n' ? ' ' : c;
    throw Error("ffmpeg failed: " + text, out_.string(), "free some space, or render to PNG files");
}

int Ffmpeg::waitForEnd() {
    if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
    int status = 0;
    if (process_ > 0) {
        ::waitpid(std::exchange(process_, -1), &status, 0);
        setChildToStop(-1);
    }
    return status;
}

}  // namespace isoglass
