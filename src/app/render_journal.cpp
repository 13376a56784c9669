#include "app/render_journal.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <zlib.h>

#include <array>
#include <fstream>
#include <string>

namespace isoglass {

namespace {

constexpr const char* kFirstWord = "isoglass-render";

std::string lineOf(std::int64_t number, std::uint64_t size, std::uint32_t crc) {
    return std::to_string(number) + ' ' + std::to_string(size) + ' ' + std::to_string(crc) + '\n';
}

[[noreturn]] void failToWrite(const std::filesystem::path& path) {
    throw Error("cannot write what a later run needs to go on", path.string(),
                "free some space, or choose another place");
}

}  // namespace

RenderJournal::RenderJournal(std::filesystem::path path, std::uint64_t identity)
    : path_(std::move(path)), identity_(identity) {
    std::ifstream file(path_);
    if (!file) return;
    std::string word;
    std::uint64_t found = 0;
    if (!(file >> word >> found) || word != kFirstWord || found != identity_) {
        foreign_ = true;
        return;
    }
    std::int64_t number = 0;
    Entry entry{};
    while (file >> number >> entry.size >> entry.crc32) entries_[number] = entry;
}

std::optional<RenderJournal::Entry> RenderJournal::entryOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    Entry entry{0, static_cast<std::uint32_t>(crc32(0, nullptr, 0))};
    std::array<char, 1 << 16> block;
    while (file.read(block.data(), block.size()) || file.gcount() > 0) {
        const auto size = static_cast<uInt>(file.gcount());
        entry.crc32 = static_cast<std::uint32_t>(
            crc32(entry.crc32, reinterpret_cast<const Bytef*>(block.data()), size));
        entry.size += size;
    }
    return entry;
}

bool RenderJournal::holds(std::int64_t number, const std::filesystem::path& file) const {
    const auto found = entries_.find(number);
    return found != entries_.end() && entryOf(file) == found->second;
}

void RenderJournal::add(std::int64_t number, const std::filesystem::path& file) {
    const auto entry = entryOf(file);
    if (!entry) throw Error("the file that was just written cannot be read", file.string());
    entries_[number] = *entry;
    if (begun_) return append(number, *entry);
    writeWhole();
    begun_ = true;
}

void RenderJournal::finish() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    entries_.clear();
}

void RenderJournal::writeWhole() const {
    AtomicFile whole(path_);
    std::ofstream file(whole.temporaryPath());
    file << kFirstWord << ' ' << identity_ << '\n';
    for (const auto& [number, entry] : entries_) file << lineOf(number, entry.size, entry.crc32);
    file.close();
    if (!file) failToWrite(path_);
    whole.commit();
}

/// A line that a power failure cuts short is no entry, or names another checksum: its file is made again.
void RenderJournal::append(std::int64_t number, const Entry& entry) const {
    std::ofstream file(path_, std::ios::app);
    file << lineOf(number, entry.size, entry.crc32);
    file.close();
    if (!file) failToWrite(path_);
}

}  // namespace isoglass
