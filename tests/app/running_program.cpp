#include "app/running_program.h"

#include "threads/eventually.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace isoglass::test {

namespace {

constexpr const char* kOut = ".out.txt";
constexpr const char* kErr = ".err.txt";

void redirect(int stream, const char* name) {
    ::dup2(::open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666), stream);
}

}  // namespace

RunningProgram::RunningProgram(const std::filesystem::path& program,
                               const std::vector<std::string>& arguments, const RunOptions& options)
    : folder_(options.folder) {
    std::vector<std::string> command{program.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (const std::string& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("cannot start " + program.string());
    if (process_ > 0) return;
    if (::chdir(folder_.c_str()) != 0) ::_exit(126);
    redirect(STDOUT_FILENO, kOut);
    redirect(STDERR_FILENO, kErr);
    for (const std::string& variable : options.environment) ::putenv(const_cast<char*>(variable.c_str()));
    ::execv(argv[0], argv.data());
    ::_exit(127);
}

RunningProgram::~RunningProgram() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

std::string RunningProgram::contents(const char* name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> RunningProgram::outLines() const {
    std::istringstream text(contents(kOut));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line) && !text.eof();) lines.push_back(line);
    return lines;
}

std::string RunningProgram::err() const {
    return contents(kErr);
}

double RunningProgram::cpuSeconds() const {
    std::ifstream file("/proc/" + std::to_string(process_) + "/stat");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    // After the name in brackets: the state, ten numbers, then user and system time.
    std::istringstream rest(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int i = 0; i < 11; ++i) rest >> skipped;
    double user = 0, system = 0;
    rest >> user >> system;
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

int RunningProgram::wait() {
    int status = 0;
    if (!eventually([&] {
            ::usleep(1000);
            return ::waitpid(process_, &status, WNOHANG) == process_;
        })) {
        return -1;
    }
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace isoglass::test
