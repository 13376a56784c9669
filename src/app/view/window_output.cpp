#include "app/view/window_output.h"

#include <exception>

namespace isoglass {

namespace {

std::string reasonOf(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const std::exception& error) {
        return error.what();
    }
}

}  // namespace

/// The window as the render loop's context, and what is written over its picture.
struct WindowOutput::Target final : gl::CurrentContext {
    gl::WindowContext window;
    TextOverlay overlay;

    Target(gl::Window& shownIn, float scale) : window(shownIn), overlay(scale) {}
    gl::Context& context() override { return window.context(); }
};

WindowOutput::WindowOutput(gl::Window& window, RenderInbox& inbox, Screenshots& screenshots, std::string name)
    : window_(window),
      screenshots_(screenshots),
      name_(std::move(name)),
      scale_(window.scale()),
      orders_(&inbox.news) {}

RenderLoop::Hooks WindowOutput::hooks() {
    return {
        .makeContext = [this] { return makeContext(); },
        // An order is for the view that was posted before it.
        .woken =
            [this] {
                if (auto newest = orders_.tryTake()) order_ = std::move(*newest);
            },
        .taken = [this](const FrameMeshes& taken) { answer(taken, {}); },
        .failed = [this](const FrameMeshes& failed) { answer(failed, reasonOf(failed.failure)); },
        .present = [this](const ShownFrame& shown, Renderer& renderer) { return present(shown, renderer); },
        .ended =
            [this] {
                ended_ = true;
                gl::Window::wake();
            }};
}

std::unique_ptr<gl::CurrentContext> WindowOutput::makeContext() {
    auto target = std::make_unique<Target>(window_, scale_);
    target_ = target.get();
    return target;
}

bool WindowOutput::present(const ShownFrame& shown, Renderer& renderer) {
    const glm::ivec2 size = renderer.copyToWindow();
    target_->overlay.draw(order_.text, size);
    saveIfDue(renderer);
    target_->window.show();
    ShownMoment moment{.axisTimes = {}, .failure = failure_};
    if (shown.meshes) {
        moment.axisTimes = shown.meshes->meshes.axisTimes;
        moment.substitute = shown.meshes->meshes.substitute();
    }
    shown_.post(std::move(moment));
    gl::Window::wake();
    return true;
}

void WindowOutput::answer(const FrameMeshes& meshes, std::string failure) {
    answered_ = meshes.request.number;
    // Where they could not be made the old ones stay.
    if (!meshes.failure) substitute_ = meshes.meshes.substitute();
    failure_ = std::move(failure);
}

void WindowOutput::saveIfDue(Renderer& renderer) {
    const bool asked = order_.screenshots > saved_;
    if (!asked || !answered_ || *answered_ < order_.screenshotRequest) return;
    // Another request for the same moment follows.
    if (order_.screenshotRequest > 0 && substitute_ > 0) return;
    saved_ = order_.screenshots;
    screenshots_.save(renderer.readSrgb(), name_);
}

}  // namespace isoglass
