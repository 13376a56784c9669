#include "scene/volume_style.h"

#include <algorithm>

namespace isoglass {

namespace {

/// What `get` takes from the points, linear between them.
template <typename Point, typename Value>
Value between(const std::vector<Point>& points, double value, Value Point::*get) {
    const auto next = std::ranges::upper_bound(points, value, {}, &Point::value);
    if (next == points.begin()) return points.front().*get;
    if (next == points.end()) return points.back().*get;
    const Point& last = *(next - 1);
    const auto share = static_cast<float>((value - last.value) / (next->value - last.value));
    return last.*get + share * ((*next).*get - last.*get);
}

}  // namespace

glm::vec4 transferAt(const VolumeStyle& style, double value) {
    return {between(style.colors, value, &VolumeStyle::ColorPoint::color),
            between(style.opacities, value, &VolumeStyle::OpacityPoint::opacity)};
}

}  // namespace isoglass
