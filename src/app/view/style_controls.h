#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <optional>
#include <string>

namespace isoglass {

/// The user's hold on the illustrative style: on or off, and every one of its parameters, one at a time.
class StyleControls {
  public:
    /// Begins with the scene's style, on or off. Scenes that show layers have none.
    explicit StyleControls(const Scene& scene);

    /// Does what the character stands for; false where it stands for nothing.
    bool type(char32_t character);

    /// What is shown; nothing while it is off.
    std::optional<IllustrativeStyle> shown() const;
    /// The parameter that is being changed and its value; empty until one is.
    std::string notice() const;
    /// The style as a scene file writes it.
    std::string sceneText() const;

  private:
    bool available_;
    bool on_;
    IllustrativeStyle style_;
    std::optional<std::size_t> parameter_;
};

}  // namespace isoglass
