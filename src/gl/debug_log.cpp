#include "gl/debug_log.h"

#include "base/error.h"

#include <epoxy/gl.h>

#include <utility>

namespace isoglass::gl {
namespace {

bool counts(GLenum type, GLenum severity) {
    return type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
           type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR || severity == GL_DEBUG_SEVERITY_HIGH;
}

void APIENTRY receive(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                      const GLchar* text, const void* log) {
    if (!counts(type, severity)) return;
    auto* target = static_cast<DebugLog*>(const_cast<void*>(log));
    target->record(length < 0 ? std::string_view(text)
                              : std::string_view(text, static_cast<std::size_t>(length)));
}

}  // namespace

void DebugLog::attach() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
    glDebugMessageCallback(receive, this);
}

void DebugLog::detach() {
    glDebugMessageCallback(nullptr, nullptr);
}

void DebugLog::record(std::string_view message) {
    if (messages_.size() < kMostMessages) {
        messages_.emplace_back(message);
    } else {
        ++dropped_;
    }
}

std::vector<std::string> DebugLog::take() {
    std::vector<std::string> taken = std::exchange(messages_, {});
    if (dropped_ > 0) taken.push_back(std::to_string(std::exchange(dropped_, 0)) + " more messages");
    bool flagged = false;
    // A lost context reports an error for ever.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) flagged = true;
    if (flagged && taken.empty()) taken.emplace_back("an error flag was set without a debug message");
    return taken;
}

void DebugLog::throwIfAny(const std::string& where) {
    const std::vector<std::string> messages = take();
    if (messages.empty()) return;
    std::string joined;
    for (const std::string& message : messages) joined += (joined.empty() ? "" : "; ") + message;
    throw Error("OpenGL reports: " + joined, where);
}

}  // namespace isoglass::gl
