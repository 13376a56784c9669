#include "app/view/viewer.h"

#include "app/text.h"
#include "pipeline/extraction_worker.h"

#include <iostream>
#include <utility>

namespace isoglass {

/// One scene and the threads that play it.
struct Viewer::Session {
    Opened opened;
    ViewerControls controls;
    RenderInbox inbox;
    WindowOutput output;
    ShownMoment shown;
    std::optional<RenderView> postedView;
    std::optional<OutputOrder> postedOrder;
    OutputOrder order;
    std::optional<FrameRequest> requested;
    std::uint64_t arrivedBefore = 0;  ///< key frames that were read ahead before that request
    ExtractionWorker worker;
    RenderLoop loop;

    Session(Opened scene, gl::Window& window, Screenshots& screenshots)
        : opened(std::move(scene)),
          controls(opened.scene, opened.keyPositions()),
          output(window, inbox, screenshots, opened.name),
          worker(
              [this](const FrameRequest& request) {
                  return opened.extractor->extract(request.position, request.camera, request.imageSize,
                                                   request.course);
              },
              inbox.meshes),
          loop(opened.scene, Pace::newest, inbox, output.hooks()) {}
};

Viewer::Viewer(gl::Window& window, Opened opened, const OpenOptions& options)
    : window_(window), options_(options), screenshots_([this](const Screenshots::Outcome& outcome) {
          if (outcome.error.empty()) {
              std::cout << outcome.file.string() << std::endl;
          } else {
              std::cerr << "isoglass: error: " << outcome.error << std::endl;
          }
          savedPictures_.post(outcome);
          gl::Window::wake();
      }) {
    show(std::move(opened));
}

Viewer::~Viewer() {
    window_.hide();
}

/// Says that something else is shown meanwhile, and why.
std::string Viewer::substituteNotice(const Session& session) {
    if (session.shown.substitute == 0) return {};
    const std::string what = "coarser level " + std::to_string(session.shown.substitute);
    return session.controls.playhead().playing()
               ? "key frames come more slowly than they are played: shown at " + what
               : what + " is shown until the key frames are read";
}

double Viewer::now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Viewer::run() {
    while (!quit_) {
        publish();
        for (const gl::WindowEvent& event : window_.wait(secondsToSleep())) handle(event);
        collect();
    }
}

/// Ends the scene that was shown before. Its render thread must have left the window when the new one
/// comes; its extraction may take longer, and is waited for elsewhere.
void Viewer::show(Opened opened) {
    for (const std::string& note : opened.notes) printNote(note);
    if (session_) {
        session_->loop.stop();
        session_->loop.join();
        closer_ = std::jthread([old = std::move(session_)]() mutable { old.reset(); });
    }
    session_ = std::make_unique<Session>(std::move(opened), window_, screenshots_);
}

void Viewer::handle(const gl::WindowEvent& event) {
    if (std::holds_alternative<gl::PictureNeeded>(event)) session_->inbox.news.ring();
    if (std::holds_alternative<gl::KeyPressed>(event) || std::holds_alternative<gl::CharacterTyped>(event) ||
        std::holds_alternative<gl::ButtonChanged>(event)) {
        notify({});
    }
    const ViewerWish wish = session_->controls.handle(event, window_.size(), now());
    quit_ = quit_ || wish.quit;
    if (wish.screenshot) {
        // While it plays the newest picture is wanted, else the one that is on its way.
        publish();
        const bool playing = session_->controls.playhead().playing();
        ++session_->order.screenshots;
        const auto& wanted = session_->requested;
        session_->order.screenshotRequest = playing || !wanted ? 0 : wanted->number;
    }
    if (wish.printStyle) std::cout << session_->controls.style().sceneText() << std::endl;
    if (!wish.open.empty()) startOpening(wish.open);
}

void Viewer::startOpening(const std::vector<std::filesystem::path>& files) {
    if (opening_) return reportError("another file is still being opened");
    if (files.size() > 1) return reportError("drop one file: a scene (.json), a series (.vdb) or a mesh");
    notify("opening " + files.front().string());
    opening_ = true;
    opener_ = std::jthread([this, file = files.front(), size = window_.size()] {
        try {
            openResults_.post(openForViewing(file, size, options_));
        } catch (const std::exception& error) {
            openResults_.post(std::string(error.what()));
        }
        gl::Window::wake();
    });
}

void Viewer::notify(std::string text, bool isError) {
    text_.notice = std::move(text);
    text_.isError = isError;
}

void Viewer::reportError(const std::string& text) {
    std::cerr << "isoglass: error: " << text << std::endl;
    notify(text, true);
}

/// Takes what the other threads have finished.
void Viewer::collect() {
    if (const auto saved = savedPictures_.tryTake()) {
        const bool failed = !saved->error.empty();
        notify(failed ? saved->error : "saved " + saved->file.string(), failed);
    }
    if (auto result = openResults_.tryTake()) {
        opening_ = false;
        notify({});
        if (const auto* error = std::get_if<std::string>(&*result)) {
            reportError(*error);
        } else {
            show(std::get<Opened>(std::move(*result)));
        }
    }
    if (auto shown = session_->output.takeShown()) {
        const bool news = shown->failure != session_->shown.failure;
        session_->shown = std::move(*shown);
        if (news && !session_->shown.failure.empty()) reportError(session_->shown.failure);
    }
    if (session_->output.ended()) session_->loop.join();
}

/// Tells the other threads what has changed.
void Viewer::publish() {
    const ViewerControls& controls = session_->controls;
    const double moment = now();
    const RenderView view{.camera = controls.camera(moment),
                          .size = window_.pictureSize(),
                          .wireframe = controls.wireframe(),
                          .position = controls.playhead().position(moment),
                          .illustration = controls.style().shown()};
    if (view.size.x > 0 && view.size.y > 0) {
        if (session_->postedView != view) session_->inbox.views.post(view);
        session_->postedView = view;
        requestMeshes(moment, view);
    }
    text_.help = controls.help() ? viewerHelp() : "";
    session_->order.text = text_;
    if (text_.notice.empty()) session_->order.text.notice = substituteNotice(*session_);
    if (session_->order.text.notice.empty()) session_->order.text.notice = controls.style().notice();
    if (session_->postedOrder != session_->order) session_->output.post(session_->order);
    session_->postedOrder = session_->order;
    if (std::string text = title(); text != title_) {
        title_ = std::move(text);
        window_.setTitle(title_);
    }
}

void Viewer::requestMeshes(double moment, const RenderView& view) {
    const FrameRequest wanted{.number = session_->requested ? session_->requested->number + 1 : 1,
                              .position = session_->controls.playhead().position(moment),
                              .camera = view.camera,
                              .imageSize = view.size,
                              .course = {session_->controls.playhead().forwards(), /*loops=*/true}};
    const std::uint64_t arrived = session_->opened.extractor->cache().arrivals();
    if (const auto& last = session_->requested) {
        const bool sameView = last->camera == wanted.camera && last->imageSize == wanted.imageSize;
        // Where something else is shown meanwhile, what came may be what is missing.
        const bool mayImprove = session_->shown.substitute > 0 && arrived != session_->arrivedBefore;
        // Meshes of full resolution look the same from everywhere.
        if (last->position == wanted.position && !mayImprove &&
            (sameView || !session_->opened.scene.quality.wantsDetail())) {
            return;
        }
    }
    session_->requested = wanted;
    session_->arrivedBefore = arrived;
    session_->worker.request(wanted);
}

/// Nothing needs the main thread between events but the clock.
std::optional<double> Viewer::secondsToSleep() const {
    const Playhead& playhead = session_->controls.playhead();
    if (!playhead.playing() || window_.minimised()) return std::nullopt;
    return playhead.secondsToNextFrame(now());
}

std::string Viewer::title() const {
    const Opened& opened = session_->opened;
    std::string text = opened.name;
    if (const auto& times = session_->shown.axisTimes; !times.empty()) {
        text += "  " + momentText(opened.extractor->series().front().file->description().time, times.front());
    }
    const Playhead& playhead = session_->controls.playhead();
    if (playhead.canPlay()) text += playhead.playing() ? "  (playing)" : "  (paused)";
    return text + "  IsoGlass, ? for help";
}

}  // namespace isoglass
