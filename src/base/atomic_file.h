#pragma once

#include "base/signal_cleanup.h"

#include <filesystem>
#include <optional>

namespace isoglass {

/// A file that appears under its name only when it is whole.
///
/// Write to `temporaryPath()`, close it, call `commit()`. Without `commit` the destructor removes the
/// temporary file, and whatever lay under the final name stays as it was. A signal that ends the program
/// by `removeNotedFiles` removes it too.
class AtomicFile {
  public:
    /// Picks a temporary name beside `finalPath`, with the same extension. Throws Error where the folder
    /// does not exist or cannot be written.
    explicit AtomicFile(const std::filesystem::path& finalPath);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::filesystem::path& temporaryPath() const { return temporary_; }

    /// Brings the bytes to the disk and renames. Throws Error where the disk refuses them.
    void commit();

  private:
    std::filesystem::path final_;
    std::filesystem::path temporary_;
    std::optional<NotedFile> noted_;
    bool committed_ = false;
};

/// A device or pipe: there is nothing to rename, and renaming would replace it by a file.
bool isSpecialFile(const std::filesystem::path& path);

/// Throws what an AtomicFile for `finalPath` would throw, and leaves nothing: to be asked before the work
/// whose result goes there.
void checkPlace(const std::filesystem::path& finalPath);

}  // namespace isoglass
