#include "gl/window.h"

#include "base/error.h"

// GL's functions come from epoxy.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <glm/common.hpp>

#include <algorithm>
#include <utility>

namespace isoglass::gl {
namespace {

/// GLFW's reason for the last failure, for as long as one was not taken.
std::string takeReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason was given";
}

/// GLFW is initialised as long as this lives.
struct Library {
    Library() {
        if (glfwInit()) return;
        throw Error("cannot open a window: " + takeReason(), "display",
                    "run it in a desktop session, set DISPLAY, or use isoglass render, which needs none");
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

GLFWwindow* makeWindow(const std::string& title, glm::ivec2 size) {
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    // The picture is drawn elsewhere and copied.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    GLFWwindow* window = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (window != nullptr) return window;
    throw Error("cannot open a window for OpenGL 4.5: " + takeReason(), "display",
                "install a newer driver, or Mesa's software renderer (libgl1-mesa-dri)");
}

std::optional<Key> keyOf(int key) {
    switch (key) {
        case GLFW_KEY_LEFT:
            return Key::left;
        case GLFW_KEY_RIGHT:
            return Key::right;
        case GLFW_KEY_HOME:
            return Key::home;
        case GLFW_KEY_ESCAPE:
            return Key::escape;
        default:
            return std::nullopt;
    }
}

std::optional<MouseButton> buttonOf(int button) {
    switch (button) {
        case GLFW_MOUSE_BUTTON_LEFT:
            return MouseButton::left;
        case GLFW_MOUSE_BUTTON_MIDDLE:
            return MouseButton::middle;
        case GLFW_MOUSE_BUTTON_RIGHT:
            return MouseButton::right;
        default:
            return std::nullopt;
    }
}

}  // namespace

struct Window::Impl {
    Library library;
    GLFWwindow* window;
    std::vector<WindowEvent> events;
    bool repeating = false;  ///< the character that follows comes from a key that is held
    /// Where the events that were handled have brought it; GLFW would say where it is now, after those
    /// that still wait.
    glm::dvec2 cursor{0};

    Impl(const std::string& title, glm::ivec2 size) : window(makeWindow(title, size)) {
        glfwGetCursorPos(window, &cursor.x, &cursor.y);
        glfwSetWindowUserPointer(window, this);
        listen();
    }
    ~Impl() { glfwDestroyWindow(window); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    static void put(GLFWwindow* window, WindowEvent event) { of(window).events.push_back(std::move(event)); }

  private:
    static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }

    static void onKey(GLFWwindow* window, int key, int /*scancode*/, int action, int modifiers) {
        of(window).repeating = action == GLFW_REPEAT;
        const auto known = keyOf(key);
        // Stepping goes on while its key is held.
        if (known && action != GLFW_RELEASE) {
            put(window, KeyPressed{*known, (modifiers & GLFW_MOD_SHIFT) != 0});
        }
    }

    static void onButton(GLFWwindow* window, int button, int action, int modifiers) {
        const auto known = buttonOf(button);
        if (!known) return;
        put(window, ButtonChanged{*known, action == GLFW_PRESS, (modifiers & GLFW_MOD_SHIFT) != 0,
                                  of(window).cursor});
    }

    static void onDrop(GLFWwindow* window, int count, const char** names) {
        put(window, FilesDropped{{names, names + count}});
    }

    void listen() const {
        glfwSetKeyCallback(window, onKey);
        glfwSetMouseButtonCallback(window, onButton);
        glfwSetDropCallback(window, onDrop);
        glfwSetCharCallback(window, [](GLFWwindow* at, unsigned int character) {
            if (!of(at).repeating) put(at, CharacterTyped{character});
        });
        glfwSetCursorPosCallback(window, [](GLFWwindow* at, double x, double y) {
            of(at).cursor = {x, y};
            put(at, CursorMoved{{x, y}});
        });
        glfwSetScrollCallback(window, [](GLFWwindow* at, double /*x*/, double y) {
            put(at, Scrolled{y, of(at).cursor});
        });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* at, int, int) { put(at, PictureNeeded{}); });
        glfwSetWindowRefreshCallback(window, [](GLFWwindow* at) { put(at, PictureNeeded{}); });
        glfwSetWindowIconifyCallback(window, [](GLFWwindow* at, int) { put(at, PictureNeeded{}); });
        glfwSetWindowCloseCallback(window, [](GLFWwindow* at) { put(at, CloseRequested{}); });
    }
};

Window::Window(const std::string& title, glm::ivec2 size) : impl_(std::make_unique<Impl>(title, size)) {}
Window::~Window() = default;

void Window::show() {
    glfwShowWindow(impl_->window);
}

void Window::hide() {
    glfwHideWindow(impl_->window);
}

void Window::resize(glm::ivec2 size) {
    glm::ivec2 corner, room(0);
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
        glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
    }
    if (room.x > 0 && room.y > 0) {
        const glm::dvec2 share = glm::dvec2(room) / glm::dvec2(size);
        size = glm::max(glm::ivec2(1), glm::ivec2(glm::dvec2(size) * std::min({1.0, share.x, share.y})));
    }
    glfwSetWindowSize(impl_->window, size.x, size.y);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(impl_->window, title.c_str());
}

glm::ivec2 Window::size() const {
    glm::ivec2 size;
    glfwGetWindowSize(impl_->window, &size.x, &size.y);
    return size;
}

glm::ivec2 Window::pictureSize() const {
    if (minimised()) return glm::ivec2(0);
    glm::ivec2 size;
    glfwGetFramebufferSize(impl_->window, &size.x, &size.y);
    return size;
}

bool Window::minimised() const {
    return glfwGetWindowAttrib(impl_->window, GLFW_ICONIFIED) != 0;
}

float Window::scale() const {
    glm::vec2 scale(1);
    glfwGetWindowContentScale(impl_->window, &scale.x, &scale.y);
    return std::max(1.0f, std::min(scale.x, scale.y));
}

std::vector<WindowEvent> Window::wait(std::optional<double> seconds) {
    if (!seconds) {
        glfwWaitEvents();
    } else if (*seconds > 0) {
        glfwWaitEventsTimeout(*seconds);
    } else {
        glfwPollEvents();
    }
    return std::exchange(impl_->events, {});
}

void Window::wake() {
    glfwPostEmptyEvent();
}

WindowContext::WindowContext(Window& window) : window_(window) {
    glfwMakeContextCurrent(window_.impl_->window);
    try {
        context_ = std::make_unique<Context>();
    } catch (...) {
        glfwMakeContextCurrent(nullptr);
        throw;
    }
    glfwSwapInterval(1);
}

WindowContext::~WindowContext() {
    context_.reset();
    glfwMakeContextCurrent(nullptr);
}

void WindowContext::show() {
    glfwSwapBuffers(window_.impl_->window);
}

}  // namespace isoglass::gl
