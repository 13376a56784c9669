#pragma once

#include "gl/current_context.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace isoglass::gl {

/// Keys that are no characters.
enum class Key { left, right, home, escape };

enum class MouseButton { left, middle, right };

struct KeyPressed {
    Key key;
    bool shift = false;
};
/// A key that writes something, as the user's keyboard layout has it. Keys that are held are not repeated.
struct CharacterTyped {
    char32_t character;
};
/// Positions of the cursor go from (0,0), the window's upper left, to its `Window::size`.
struct ButtonChanged {
    MouseButton button;
    bool down = false;
    bool shift = false;
    glm::dvec2 cursor{0};
};
struct CursorMoved {
    glm::dvec2 cursor{0};
};
struct Scrolled {
    double steps = 0;  ///< above 0 is away from the user
    glm::dvec2 cursor{0};
};
/// Its size or what covers it changed: draw again.
struct PictureNeeded {};
struct FilesDropped {
    std::vector<std::filesystem::path> files;
};
struct CloseRequested {};

using WindowEvent = std::variant<KeyPressed, CharacterTyped, ButtonChanged, CursorMoved, Scrolled,
                                 PictureNeeded, FilesDropped, CloseRequested>;

/// A window of the desktop, through GLFW; one at a time. Its picture is drawn in a WindowContext.
///
/// All members belong to the thread that made it, which must be the main thread, but for `wake`.
class Window {
  public:
    /// Hidden until `show`. Throws Error where there is no display or it gives no GL 4.5 core context.
    Window(const std::string& title, glm::ivec2 size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    void show();
    void hide();
    /// Shrinks `size`, keeping its shape, to what the display has room for.
    void resize(glm::ivec2 size);
    void setTitle(const std::string& title);

    /// Where the cursor can be; screen coordinates, which need not be pixels.
    glm::ivec2 size() const;
    /// Pixels of the picture; 0 while the window is minimised.
    glm::ivec2 pictureSize() const;
    bool minimised() const;
    /// How much larger than usual text must be on the window's display.
    float scale() const;

    /// Sleeps until there are events, `wake` was called or `seconds` have passed; hands out the events.
    std::vector<WindowEvent> wait(std::optional<double> seconds);

    /// Ends a `wait`, also one that is about to begin. Any thread.
    ///
    /// The render thread calls it after every picture: the replies that it reads from the display server
    /// may have events behind them, which would stay unseen.
    static void wake();

  private:
    friend class WindowContext;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The GL context of a window. Belongs to the render thread, in which it is current while it lives; one a
/// window at a time.
class WindowContext final : public CurrentContext {
  public:
    /// `window` must outlive it. Throws Error below GL 4.5.
    explicit WindowContext(Window& window);
    ~WindowContext() override;

    Context& context() override { return *context_; }

    /// Shows what was drawn into framebuffer 0. May wait for the display to refresh.
    void show();

  private:
    Window& window_;
    std::unique_ptr<Context> context_;
};

}  // namespace isoglass::gl
