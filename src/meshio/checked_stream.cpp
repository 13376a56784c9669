#include "meshio/checked_stream.h"

#include "base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

namespace isoglass {

namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 18;

}  // namespace

CheckedStreambuf::CheckedStreambuf(const std::filesystem::path& file, EditHead editHead, std::string text)
    : editHead_(editHead), text_(std::move(text)) {
    file_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) throw Error(std::string("cannot write: ") + std::strerror(errno), file.string());
    block_.reserve(kBlockBytes);
}

CheckedStreambuf::~CheckedStreambuf() {
    if (file_ >= 0) ::close(file_);
}

int CheckedStreambuf::finish() {
    writeBlock();
    if (::close(std::exchange(file_, -1)) != 0 && failure_ == 0) failure_ = errno;
    return failure_;
}

CheckedStreambuf::int_type CheckedStreambuf::overflow(int_type letter) {
    if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
    const char value = traits_type::to_char_type(letter);
    return xsputn(&value, 1) == 1 ? letter : traits_type::eof();
}

std::streamsize CheckedStreambuf::xsputn(const char* data, std::streamsize count) {
    block_.append(data, static_cast<std::size_t>(count));
    if (block_.size() >= kBlockBytes && !writeBlock()) return 0;
    return count;
}

bool CheckedStreambuf::writeBlock() {
    if (!std::exchange(headWritten_, true)) editHead_(block_, text_);
    std::size_t done = 0;
    while (done < block_.size() && failure_ == 0) {
        const ssize_t written = ::write(file_, block_.data() + done, block_.size() - done);
        if (written >= 0) {
            done += static_cast<std::size_t>(written);
        } else if (errno != EINTR) {
            failure_ = errno;
        }
    }
    block_.clear();
    return failure_ == 0;
}

}  // namespace isoglass
