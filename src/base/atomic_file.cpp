#include "base/atomic_file.h"

#include "base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace isoglass {

AtomicFile::AtomicFile(const std::filesystem::path& finalPath) : final_(finalPath) {
    const std::filesystem::path folder = final_.has_parent_path() ? final_.parent_path() : ".";
    if (!std::filesystem::is_directory(folder)) {
        throw Error("the folder does not exist", folder.string(), "create it, or choose another place");
    }
    if (std::filesystem::is_directory(final_)) {
        throw Error("a folder stands where the file should go", final_.string(), "name a file");
    }
    // The extension stays last: writers choose their format by it.
    std::string name(1, '.');
    name.append(final_.stem().string()).append(".part-").append(std::to_string(::getpid()));
    temporary_ = folder / name.append(final_.extension().string());
    noted_.emplace(temporary_);
    const int file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) {
        throw Error(std::string("cannot write: ") + std::strerror(errno), final_.string(),
                    "choose a folder that you may write to");
    }
    ::close(file);
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    const int file = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool synced = file >= 0 && ::fsync(file) == 0;
    const int reason = errno;
    if (file >= 0) ::close(file);
    if (!synced) {
        throw Error(std::string("the disk did not take the file: ") + std::strerror(reason), final_.string(),
                    "free some space, or choose another place");
    }
    std::error_code failure;
    std::filesystem::rename(temporary_, final_, failure);
    if (failure) throw Error("cannot write: " + failure.message(), final_.string());
    committed_ = true;
}

bool isSpecialFile(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    return std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status);
}

void checkPlace(const std::filesystem::path& finalPath) {
    const AtomicFile probe(finalPath);
}

}  // namespace isoglass
