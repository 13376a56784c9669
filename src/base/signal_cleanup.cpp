#include "base/signal_cleanup.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>

namespace isoglass {

namespace {

enum class State : int { free, changing, noted };

struct Slot {
    std::atomic<State> state{State::free};
    std::array<char, 4096> path;
};

// Not destroyed at exit: a signal may come then too.
std::array<Slot, 32> slots;

static_assert(std::atomic<State>::is_always_lock_free, "a handler may read the states");

}  // namespace

NotedFile::NotedFile(const std::filesystem::path& file) {
    const std::string& path = file.native();
    if (path.size() >= slots[0].path.size()) return;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        State expected = State::free;
        if (!slots[i].state.compare_exchange_strong(expected, State::changing)) continue;
        std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
        slots[i].state = State::noted;
        slot_ = static_cast<int>(i);
        return;
    }
}

NotedFile::~NotedFile() {
    if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state = State::free;
}

void removeNotedFiles() noexcept {
    for (const Slot& slot : slots) {
        if (slot.state == State::noted) ::unlink(slot.path.data());
    }
    for (const Slot& slot : slots) {
        if (slot.state == State::noted) ::rmdir(slot.path.data());
    }
}

}  // namespace isoglass
