#pragma once

#include "gl/debug_log.h"

#include <string>

namespace isoglass::gl {

/// A GL 4.5 core context that is current in the calling thread: what it runs on and what it complains
/// about. Whoever makes contexts (headless, window) owns one of these beside it.
///
/// All members, and all GL objects of the context, belong to that thread.
class Context {
  public:
    /// Takes the current context and attaches the debug log. Throws Error below GL 4.5.
    Context();
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const std::string& rendererName() const { return rendererName_; }
    const std::string& version() const { return version_; }
    /// The GPU's work is done by the CPU: timer queries tell nothing there.
    bool isSoftware() const { return isSoftware_; }
    DebugLog& debugLog() { return debugLog_; }

  private:
    std::string rendererName_;
    std::string version_;
    bool isSoftware_ = false;
    DebugLog debugLog_;
};

}  // namespace isoglass::gl
