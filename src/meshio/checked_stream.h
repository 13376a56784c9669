#pragma once

#include <filesystem>
#include <streambuf>
#include <string>

namespace isoglass {

/// Writes to a file and keeps the reason of the first failure, so that a writer which does not look at
/// its stream cannot hide a full disk.
///
/// The first block is held back and handed to `editHead` before it is written: OpenMesh has no call to
/// put a comment into a header.
class CheckedStreambuf : public std::streambuf {
  public:
    /// Edits the beginning of the file, at least 64 KiB of it or all.
    using EditHead = void (*)(std::string& head, const std::string& text);

    /// Opens an existing or new file for writing. Throws Error.
    CheckedStreambuf(const std::filesystem::path& file, EditHead editHead, std::string text);
    ~CheckedStreambuf() override;
    CheckedStreambuf(const CheckedStreambuf&) = delete;
    CheckedStreambuf& operator=(const CheckedStreambuf&) = delete;

    /// Writes what is left and closes. Returns 0, or the errno of the first failure.
    int finish();

  protected:
    int_type overflow(int_type letter) override;
    std::streamsize xsputn(const char* data, std::streamsize count) override;

  private:
    bool writeBlock();

    int file_ = -1;
    int failure_ = 0;
    bool headWritten_ = false;
    EditHead editHead_;
    std::string text_;
    std::string block_;
};

}  // namespace isoglass
