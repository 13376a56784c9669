#pragma once

#include "render/image.h"

#include <glm/vec2.hpp>
#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace isoglass::test {

/// Whether the programs are there that a Desktop needs: Xvfb and xdotool.
bool canMakeDesktop();

/// A desktop without a screen: Xvfb, with nothing on it but what a test starts.
///
/// What waits for a program gives up after half a minute with std::runtime_error.
class Desktop {
  public:
    Desktop();
    ~Desktop();
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;

    /// As the variable DISPLAY wants it.
    const std::string& name() const { return name_; }

    /// Sends real keys and mouse events: the arguments of xdotool.
    void xdotool(const std::vector<std::string>& arguments) const;

    /// The window whose title contains `part`, once it is shown.
    unsigned long waitForWindow(const std::string& part);
    std::string title(unsigned long window);
    /// Its picture as the screen has it.
    Image picture(unsigned long window);
    /// Drops files on it, as a file manager does (XDND, version 5). True when the window took them.
    bool drop(unsigned long window, const std::vector<std::filesystem::path>& files);
    /// Says that it is minimised or not, as a window manager does.
    void setMinimised(unsigned long window, bool minimised);
    /// Asks it to close, as the button of its frame does.
    void askToClose(unsigned long window);

  private:
    struct X;

    pid_t server_ = -1;
    std::string name_;
    std::unique_ptr<X> x_;
};

}  // namespace isoglass::test
