#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace isoglass {

/// Linear-light colour of an sRGB colour "#rrggbb", by the piecewise curve of IEC 61966-2-1; nothing for
/// any other text.
std::optional<LinearColor> linearFromHex(std::string_view hex);

/// The sRGB colour "#rrggbb" nearest to `color`; the inverse of `linearFromHex` for each of its results.
std::string hexFromLinear(const LinearColor& color);

/// A colour and how much of what lies behind it it hides.
struct Backdrop {
    LinearColor color{0};
    float opacity = 1;
};

/// Reads "transparent", "#rrggbb" or "#rrggbbaa" (straight alpha); nothing for any other text.
std::optional<Backdrop> backdropFromText(std::string_view text);

/// "#rrggbb", or "#rrggbbaa" where it is not opaque; the inverse of `backdropFromText` but for the word.
std::string textFromBackdrop(const Backdrop& backdrop);

}  // namespace isoglass
