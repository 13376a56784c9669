#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>

namespace isoglass {

/// What a run that writes many files has finished, in a text file that outlives it: the next run of the
/// same job goes on from there.
///
/// The first line names the job by its identity, each further one a finished file by number, size and CRC-32.
/// A file counts as finished only where it still has that size and checksum, and the journal counts only
/// where the identity is the same. Use from one thread.
class RenderJournal {
  public:
    /// Reads what an earlier run left at `path`, if there is anything.
    RenderJournal(std::filesystem::path path, std::uint64_t identity);

    /// An earlier run left a journal of another job.
    bool isForeign() const { return foreign_; }

    /// Whether the earlier run finished `file`, its number `number`, and it is still as it was.
    bool holds(std::int64_t number, const std::filesystem::path& file) const;

    /// Notes a finished file; the first one makes the journal. Throws Error where the disk does not take it.
    void add(std::int64_t number, const std::filesystem::path& file);

    /// The job is done: removes the journal.
    void finish();

  private:
    struct Entry {
        std::uint64_t size;
        std::uint32_t crc32;

        friend bool operator==(const Entry&, const Entry&) = default;
    };

    static std::optional<Entry> entryOf(const std::filesystem::path& file);
    void writeWhole() const;
    void append(std::int64_t number, const Entry& entry) const;

    std::filesystem::path path_;
    std::uint64_t identity_;
    std::map<std::int64_t, Entry> entries_;
    bool foreign_ = false;
    bool begun_ = false;  ///< by this run
};

}  // namespace isoglass
