#pragma once

#include <filesystem>

namespace isoglass {

/// Notes a file, or a folder that is empty but for noted files, that must not stay behind where a signal ends
/// the program. Any thread.
///
/// At most 32 files are noted at once, with paths of up to 4095 bytes; what is beyond that is left to
/// destructors, which a signal does not run.
class NotedFile {
  public:
    explicit NotedFile(const std::filesystem::path& file);
    ~NotedFile();
    NotedFile(const NotedFile&) = delete;
    NotedFile& operator=(const NotedFile&) = delete;

  private:
    int slot_ = -1;
};

/// Removes every noted file, and noted folders that are empty then. For signal handlers: calls nothing that
/// is not async-signal-safe.
void removeNotedFiles() noexcept;

}  // namespace isoglass
