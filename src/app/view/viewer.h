#pragma once

#include "app/view/controls.h"
#include "app/view/opened.h"
#include "app/view/screenshots.h"
#include "app/view/window_output.h"
#include "basis/mailbox.h"
#include "gl/window.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>

namespace isoglass {

/// A window that plays one scene at a time.
///
/// All members belong to the main thread. It alone knows events and clock, and never waits for the others:
/// the render thread draws, the extraction thread makes meshes, other threads open files and save pictures.
class Viewer {
  public:
    /// `window` must outlive it.
    Viewer(gl::Window& window, Opened opened, const OpenOptions& options);
    ~Viewer();

    /// Runs until the user quits. Throws what ended the render thread.
    void run();

  private:
    struct Session;
    using OpenResult = std::variant<Opened, std::string>;

    static std::string substituteNotice(const Session& session);
    double now() const;
    void show(Opened opened);
    void handle(const gl::WindowEvent& event);
    void startOpening(const std::vector<std::filesystem::path>& files);
    void collect();
    void publish();
    void requestMeshes(double now, const RenderView& view);
    std::optional<double> secondsToSleep() const;
    std::string title() const;
    void notify(std::string text, bool isError = false);
    void reportError(const std::string& text);

    gl::Window& window_;
    OpenOptions options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    bool quit_ = false;

    Mailbox<Screenshots::Outcome> savedPictures_;
    Screenshots screenshots_;
    std::unique_ptr<Session> session_;
    OverlayText text_;  ///< its notice stays until the next key or click
    std::string title_;

    Mailbox<OpenResult> openResults_;
    std::jthread opener_;
    std::jthread closer_;  ///< waits for an old session's extraction
    bool opening_ = false;
};

}  // namespace isoglass
