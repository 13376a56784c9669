#include "app/run_program.h"

#include <fcntl.h>
#include <grp.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

namespace isoglass::test {

/// A pipe or terminal whose text is read to its end by a thread of its own: when it is full it does not
/// stop the program.
class StartedProgram::Drain {
  public:
    explicit Drain(bool terminal) {
        const bool opened = terminal ? ::openpty(&ends_[0], &ends_[1], nullptr, nullptr, nullptr) == 0
                                     : ::pipe2(ends_.data(), O_CLOEXEC) == 0;
        if (!opened) throw std::runtime_error("no pipe");
    }

    int writeEnd() const { return ends_[1]; }

    /// Call it where the other side is running.
    void start() {
        ::close(ends_[1]);
        thread_ = std::jthread([this] {
            std::array<char, 4096> block;
            for (ssize_t n = 0; (n = ::read(ends_[0], block.data(), block.size())) > 0;) {
                text_.append(block.data(), static_cast<std::size_t>(n));
            }
            ::close(ends_[0]);
        });
    }

    std::string finish() {
        thread_.join();
        return std::move(text_);
    }

  private:
    std::array<int, 2> ends_{};
    std::string text_;
    std::jthread thread_;
};

namespace {

void dropPrivileges() {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() != 0) return;
    if (::setgroups(0, nullptr) != 0 || ::setgid(kNobody) != 0 || ::setuid(kNobody) != 0) ::_exit(126);
}

[[noreturn]] void becomeProgram(const std::vector<std::string>& command, const RunOptions& options, int out,
                                int err) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(options.outFile.empty() ? out : ::open(options.outFile.c_str(), O_WRONLY), STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    ::unsetenv("NO_COLOR");
    if (!options.folder.empty() && ::chdir(options.folder.c_str()) != 0) ::_exit(126);
    for (const std::string& variable : options.environment) ::putenv(const_cast<char*>(variable.c_str()));
    if (options.fileSizeLimit) {
        // A full disk fails the write and sends no signal.
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{*options.fileSizeLimit, *options.fileSizeLimit};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    // A shell that started the tests in the background made them ignore it.
    ::signal(SIGINT, SIG_DFL);
    if (options.dropPrivileges) dropPrivileges();
    std::vector<char*> argv;
    for (const std::string& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    ::_exit(127);
}

}  // namespace

StartedProgram::StartedProgram(const std::filesystem::path& program,
                               const std::vector<std::string>& arguments, const RunOptions& options)
    : out_(std::make_unique<Drain>(false)), err_(std::make_unique<Drain>(options.errIsTerminal)) {
    std::vector<std::string> command = {program.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("cannot start " + program.string());
    if (process_ == 0) becomeProgram(command, options, out_->writeEnd(), err_->writeEnd());
    out_->start();
    err_->start();
}

StartedProgram::~StartedProgram() {
    if (process_ > 0) finish();
}

void StartedProgram::signal(int number) const {
    if (process_ > 0) ::kill(process_, number);
}

RunResult StartedProgram::finish() {
    int status = 0;
    ::waitpid(std::exchange(process_, -1), &status, 0);
    RunResult result;
    result.out = out_->finish();
    result.err = err_->finish();
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

RunResult runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     const RunOptions& options) {
    return StartedProgram(program, arguments, options).finish();
}

bool canMakeTerminal() {
    int ends[2];
    if (::openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) != 0) return false;
    ::close(ends[0]);
    ::close(ends[1]);
    return true;
}

}  // namespace isoglass::test
