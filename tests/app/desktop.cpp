#include "app/desktop.h"

#include "app/run_program.h"
#include "threads/eventually.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace isoglass::test {

namespace {

constexpr const char* kXvfb = "/usr/bin/Xvfb";
constexpr const char* kXdotool = "/usr/bin/xdotool";

/// Starts the server, which chooses a free number and writes it into the pipe.
pid_t startServer(std::string& name) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    const pid_t process = ::fork();
    if (process == 0) {
        const int quiet = ::open("/dev/null", O_RDWR);
        ::dup2(quiet, STDERR_FILENO);
        ::close(ends[0]);
        const std::string number = std::to_string(ends[1]);
        ::execl(kXvfb, kXvfb, "-displayfd", number.c_str(), "-screen", "0", "800x600x24", "-nolisten", "tcp",
                nullptr);
        ::_exit(127);
    }
    ::close(ends[1]);
    name = ":";
    for (char digit = 0; ::read(ends[0], &digit, 1) == 1 && digit != '\n';) name += digit;
    ::close(ends[0]);
    if (name == ":") throw std::runtime_error("Xvfb does not start");
    return process;
}

}  // namespace

struct Desktop::X {
    Display* display;

    explicit X(const std::string& name) : display(XOpenDisplay(name.c_str())) {
        if (display == nullptr) throw std::runtime_error("no connection to Xvfb");
        // A window may go while it is asked about; Xlib would end the test.
        XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
    }
    ~X() { XCloseDisplay(display); }
    X(const X&) = delete;
    X& operator=(const X&) = delete;

    Atom atom(const char* name) const { return XInternAtom(display, name, 0); }
    Window root() const { return DefaultRootWindow(display); }

    std::string title(Window window) const {
        Atom type = 0;
        int format = 0;
        unsigned long count = 0, rest = 0;
        unsigned char* bytes = nullptr;
        XGetWindowProperty(display, window, atom("_NET_WM_NAME"), 0, 1000, 0, atom("UTF8_STRING"), &type,
                           &format, &count, &rest, &bytes);
        std::string text(reinterpret_cast<char*>(bytes), count);
        if (bytes != nullptr) XFree(bytes);
        return text;
    }

    Window shownWindow(const std::string& part) const {
        Window ignored = 0, *children = nullptr, found = 0;
        unsigned count = 0;
        XQueryTree(display, root(), &ignored, &ignored, &children, &count);
        for (unsigned i = 0; i < count; ++i) {
            XWindowAttributes attributes;
            XGetWindowAttributes(display, children[i], &attributes);
            if (attributes.map_state == IsViewable && title(children[i]).find(part) != std::string::npos) {
                found = children[i];
            }
        }
        if (children != nullptr) XFree(children);
        return found;
    }

    void send(Window window, const char* type, std::array<long, 5> data) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = window;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i] = data[i];
        XSendEvent(display, window, 0, NoEventMask, &event);
        XFlush(display);
    }

    /// The next message of that type to `window`, answering on the way whoever asks for the dropped files.
    XClientMessageEvent await(Window window, const char* type, const std::string& files) const {
        XEvent event{};
        const bool came = eventually([&] {
            while (XPending(display) > 0) {
                XNextEvent(display, &event);
                if (event.type == SelectionRequest) give(event.xselectionrequest, files);
                if (event.type == ClientMessage && event.xclient.window == window &&
                    event.xclient.message_type == atom(type)) {
                    return true;
                }
            }
            ::usleep(1000);
            return false;
        });
        if (!came) throw std::runtime_error(std::string("no ") + type);
        return event.xclient;
    }

    void give(const XSelectionRequestEvent& request, const std::string& files) const {
        XChangeProperty(display, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(files.data()), static_cast<int>(files.size()));
        XEvent answer{};
        answer.xselection.type = SelectionNotify;
        answer.xselection.requestor = request.requestor;
        answer.xselection.selection = request.selection;
        answer.xselection.target = request.target;
        answer.xselection.property = request.property;
        answer.xselection.time = request.time;
        XSendEvent(display, request.requestor, 0, NoEventMask, &answer);
        XFlush(display);
    }
};

bool canMakeDesktop() {
    return ::access(kXvfb, X_OK) == 0 && ::access(kXdotool, X_OK) == 0;
}

Desktop::Desktop() {
    server_ = startServer(name_);
    x_ = std::make_unique<X>(name_);
}

Desktop::~Desktop() {
    x_.reset();
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
}

void Desktop::xdotool(const std::vector<std::string>& arguments) const {
    const RunResult result = runProgram(kXdotool, arguments, {.environment = {"DISPLAY=" + name_}});
    if (result.status != 0) throw std::runtime_error("xdotool: " + result.err);
}

unsigned long Desktop::waitForWindow(const std::string& part) {
    Window window = 0;
    const bool came = eventually([&] {
        window = x_->shownWindow(part);
        if (window == 0) ::usleep(10000);
        return window != 0;
    });
    if (!came) throw std::runtime_error("no window '" + part + "'");
    return window;
}

std::string Desktop::title(unsigned long window) {
    return x_->title(window);
}

Image Desktop::picture(unsigned long window) {
    XWindowAttributes attributes;
    XGetWindowAttributes(x_->display, window, &attributes);
    XImage* pixels = XGetImage(x_->display, window, 0, 0, static_cast<unsigned>(attributes.width),
                               static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
    if (pixels == nullptr) throw std::runtime_error("no picture of the window");
    Image image{{attributes.width, attributes.height}, {}};
    for (int y = 0; y < attributes.height; ++y) {
        for (int x = 0; x < attributes.width; ++x) {
            const unsigned long value = XGetPixel(pixels, x, y);
            image.pixels.push_back({static_cast<std::uint8_t>(value >> 16),
                                    static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value),
                                    255});
        }
    }
    XDestroyImage(pixels);
    return image;
}

bool Desktop::drop(unsigned long window, const std::vector<std::filesystem::path>& files) {
    std::string list;
    for (const auto& file : files) list += "file://" + file.string() + "\r\n";
    Display* display = x_->display;
    const Window source = XCreateSimpleWindow(display, x_->root(), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display, x_->atom("XdndSelection"), source, CurrentTime);
    const long from = static_cast<long>(source);
    x_->send(window, "XdndEnter", {from, 5L << 24, static_cast<long>(x_->atom("text/uri-list")), 0, 0});
    x_->send(window, "XdndPosition",
             {from, 0, (20L << 16) | 20, CurrentTime, static_cast<long>(x_->atom("XdndActionCopy"))});
    const bool accepts = (x_->await(source, "XdndStatus", list).data.l[1] & 1) != 0;
    bool took = false;
    if (accepts) {
        x_->send(window, "XdndDrop", {from, 0, CurrentTime, 0, 0});
        // GLFW puts the length of the list where the protocol wants a 1.
        took = x_->await(source, "XdndFinished", list).data.l[1] != 0;
    }
    XDestroyWindow(display, source);
    XFlush(display);
    return took;
}

void Desktop::setMinimised(unsigned long window, bool minimised) {
    const std::array<long, 2> state{minimised ? IconicState : NormalState, 0};
    const Atom property = x_->atom("WM_STATE");
    XChangeProperty(x_->display, window, property, property, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(state.data()), 2);
    XFlush(x_->display);
}

void Desktop::askToClose(unsigned long window) {
    x_->send(window, "WM_PROTOCOLS", {static_cast<long>(x_->atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0, 0});
}

}  // namespace isoglass::test
