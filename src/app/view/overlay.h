#pragma once

#include <glm/vec2.hpp>

#include <string>

namespace isoglass {

/// What is written over the picture.
struct OverlayText {
    std::string help;      ///< in the middle; empty shows nothing
    std::string notice;    ///< at the bottom; empty shows nothing
    bool isError = false;  ///< the notice is one, and stands out

    bool empty() const { return help.empty() && notice.empty(); }

    friend bool operator==(const OverlayText&, const OverlayText&) = default;
};

/// Writes text over what was drawn into the window, through Dear ImGui.
///
/// One at a time; made, used and destroyed by the render thread while the window's context is current. GL's
/// state is afterwards as it was.
class TextOverlay {
  public:
    /// `scale` is that of the text: pixels to a screen coordinate.
    explicit TextOverlay(float scale);
    ~TextOverlay();
    TextOverlay(const TextOverlay&) = delete;
    TextOverlay& operator=(const TextOverlay&) = delete;

    /// Draws into framebuffer 0, which is `size` pixels large.
    void draw(const OverlayText& text, glm::ivec2 size);

  private:
    float scale_;
};

}  // namespace isoglass
