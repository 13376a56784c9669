#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isoglass::gl {

/// What the driver complained about: debug messages of type error, undefined behaviour or deprecated,
/// and those of high severity, whatever their type.
///
/// Belongs to one context and to the thread in which that is current; messages arrive synchronously, in
/// the GL call that caused them.
class DebugLog {
  public:
    /// Turns debug output of the current context on. The address must stay the same until `detach`.
    void attach();
    void detach();

    /// Called for each message that counts. After kMostMessages only their number grows.
    void record(std::string_view message);

    /// Hands out the messages so far and forgets them. Errors that raised a flag (glGetError) without a
    /// message are among them.
    std::vector<std::string> take();

    /// Throws Error with the messages so far, if there are any, and forgets them. `where` names what was
    /// being done, e.g. "frame".
    void throwIfAny(const std::string& where);

    static constexpr std::size_t kMostMessages = 32;

  private:
    std::vector<std::string> messages_;
    std::size_t dropped_ = 0;
};

}  // namespace isoglass::gl
