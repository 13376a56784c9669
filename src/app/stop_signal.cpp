#include "app/stop_signal.h"

#include "base/signal_cleanup.h"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>

namespace isoglass {

namespace {

std::atomic<int> received{0};
std::atomic<int> scopes{0};
std::atomic<pid_t> child{-1};

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free,
              "a handler uses them");

/// Async-signal-safe.
[[noreturn]] void endBy(int signal) {
    struct sigaction action = {};
    action.sa_handler = SIG_DFL;
    ::sigaction(signal, &action, nullptr);
    sigset_t set;
    ::sigemptyset(&set);
    ::sigaddset(&set, signal);
    ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    ::raise(signal);
    ::_exit(128 + signal);
}

void onSignal(int signal) {
    const int before = received.exchange(signal);
    if (before == 0 && scopes > 0) return;
    // The child first: it would write on into its file.
    if (const pid_t process = child; process > 0) {
        ::kill(process, SIGKILL);
        ::waitpid(process, nullptr, 0);
    }
    removeNotedFiles();
    endBy(signal);
}

}  // namespace

void installStopSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before = {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_IGN) continue;
        struct sigaction action = {};
        action.sa_handler = onSignal;
        action.sa_flags = SA_RESTART;
        ::sigaction(signal, &action, nullptr);
    }
}

StopScope::StopScope() {
    ++scopes;
}

StopScope::~StopScope() {
    --scopes;
}

bool stopRequested() {
    return received != 0;
}

void endByStopSignal() {
    endBy(received);
}

void setChildToStop(pid_t process) {
    child = process;
}

}  // namespace isoglass
