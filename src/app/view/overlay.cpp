#include "app/view/overlay.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <imgui.h>

#include <algorithm>
#include <limits>

namespace isoglass {

namespace {

constexpr ImU32 kPaper = IM_COL32(20, 24, 30, 215);
constexpr ImU32 kInk = IM_COL32(240, 240, 240, 255);
constexpr ImU32 kErrorInk = IM_COL32(255, 144, 112, 255);
constexpr float kPadding = 10, kMargin = 12;

/// A box with `text`, wrapped to the picture; the point of it at the shares `pivot` lies at those of the
/// picture. Not a window of ImGui, which would need a frame to learn its size before it shows.
void box(const std::string& text, ImU32 ink, glm::vec2 pivot, glm::vec2 picture, float scale) {
    if (text.empty()) return;
    const ImFont* font = ImGui::GetFont();
    const float size = font->FontSize * scale, around = (kMargin + kPadding) * scale;
    const float width = std::max(picture.x - 2 * around, size);
    const char* const end = text.data() + text.size();
    const ImVec2 extent =
        font->CalcTextSizeA(size, std::numeric_limits<float>::max(), width, text.data(), end);
    const glm::vec2 room = picture - 2 * around - glm::vec2(extent.x, extent.y);
    const glm::vec2 at = glm::floor(around + room * pivot), to = at + glm::vec2(extent.x, extent.y);
    const float padding = kPadding * scale;
    ImDrawList* list = ImGui::GetForegroundDrawList();
    list->AddRectFilled({at.x - padding, at.y - padding}, {to.x + padding, to.y + padding}, kPaper,
                        padding / 2);
    list->AddText(font, size, {at.x, at.y}, ink, text.data(), end, width);
}

}  // namespace

TextOverlay::TextOverlay(float scale) : scale_(scale) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

TextOverlay::~TextOverlay() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void TextOverlay::draw(const OverlayText& text, glm::ivec2 size) {
    if (text.empty()) return;
    const glm::vec2 picture(size);
    ImGui::GetIO().DisplaySize = {picture.x, picture.y};
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    box(text.help, kInk, {0.5f, 0.5f}, picture, scale_);
    box(text.notice, text.isError ? kErrorInk : kInk, {0, 1}, picture, scale_);
    ImGui::Render();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace isoglass
