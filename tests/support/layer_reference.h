#pragma once

#include "render/camera.h"
#include "render/layer_draw.h"
#include "render/volume_samples.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

// Layers of an iso-surface by rays on the CPU in double precision: every sample is looked at, no brick is
// left out and no ray ends early.

namespace isoglass::test {

/// What a ray meets.
struct LayerHits {
    std::vector<double> depths;       ///< of the layers, along the view axis
    std::vector<glm::dvec3> normals;  ///< series gradients there
    /// How close a sample comes to the iso-value: the layers are certain where it is above rounding.
    double closest = std::numeric_limits<double>::infinity();
    /// How close a value comes to the iso-value where values begin or end.
    double closestAtBorder = std::numeric_limits<double>::infinity();
};

/// Of the samples around a place, in double precision; corners with less weight than `least` are not looked
/// at.
inline double trilinear(const VolumeSamples& volume, const glm::dvec3& index, double least = -1) {
    const glm::ivec3 low = glm::clamp(glm::ivec3(index), glm::ivec3(0), volume.dims - 2);
    const glm::dvec3 part = index - glm::dvec3(low);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 at = low + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        double weight = 1;
        for (int k = 0; k < 3; ++k) weight *= corner >> k & 1 ? part[k] : 1 - part[k];
        if (weight < least) continue;
        sum +=
            weight *
            static_cast<double>(
                volume
                    .values[(static_cast<std::size_t>(at.z) * volume.dims.y + at.y) * volume.dims.x + at.x]);
    }
    return sum;
}

class LayerReference {
  public:
    /// Even axes; the volumes must outlive it.
    LayerReference(const LayerDraw& draw, const VolumeSamples& first, const VolumeSamples& second)
        : draw_(draw), first_(first), second_(second) {}

    /// Rounding decides whether a sample that has hardly any weight is looked at; that matters where it is
    /// missing.
    bool isCertain(const glm::dvec3& index) const {
        constexpr double kHardly = 1e-3;
        const auto same = [&](const VolumeSamples& volume) {
            return std::isnan(trilinear(volume, index)) == std::isnan(trilinear(volume, index, kHardly));
        };
        return same(first_) && same(second_);
    }

    /// NaN next to missing samples.
    double value(const glm::dvec3& index) const {
        const double a = trilinear(first_, index);
        return draw_.fraction > 0 ? a + draw_.fraction * (trilinear(second_, index) - a) : a;
    }

    /// Of the ray through a place of the picture, in pixels from its upper left corner.
    LayerHits march(const CameraView& camera, double x, double y) const {
        const ViewAxes axes = viewAxes(camera);
        const double height = std::tan(camera.fovDegrees * M_PI / 360);
        const double width = height * camera.size.x / camera.size.y;
        const glm::dvec3 world = axes.forward + (2 * x / camera.size.x - 1) * width * axes.right +
                                 (1 - 2 * y / camera.size.y) * height * axes.up;
        const glm::dmat4 seriesFromWorld = glm::inverse(draw_.worldFromSeries);
        const glm::dvec3 eye = indexOf(glm::dvec3(seriesFromWorld * glm::dvec4(camera.eye, 1)));
        const glm::dvec3 way = glm::dmat3(seriesFromWorld) * world / spacing();
        double begin = 0, end = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k) {
            const double a = -eye[k] / way[k];
            const double b = (first_.dims[k] - 1 - eye[k]) / way[k];
            begin = std::max(begin, std::min(a, b));
            end = std::min(end, std::max(a, b));
        }
        LayerHits hits;
        const double step = draw_.style.step / glm::length(way);
        bool known = false;
        double before = 0;
        double tBefore = begin;
        for (int i = 0; begin < end; ++i) {
            const double t = std::min(begin + i * step, end);
            const glm::dvec3 index = clamped(eye + t * way);
            const double f = value(index) - static_cast<double>(draw_.iso);
            if (!isCertain(index)) hits.closest = 0;
            const bool valid = !std::isnan(f);
            if (valid) hits.closest = std::min(hits.closest, std::abs(f));
            if (known && valid && (f >= 0) != (before >= 0)) add(hits, eye, way, tBefore, t);
            if (i > 0 && known != valid)
                addAtBorder(hits, eye, way, known ? tBefore : t, known ? t : tBefore);
            known = valid;
            before = f;
            tBefore = t;
            if (t == end) break;
        }
        return hits;
    }

    glm::dvec3 indexOf(const glm::dvec3& p) const {
        const glm::dvec3 first(draw_.axes[0].front(), draw_.axes[1].front(), draw_.axes[2].front());
        return (p - first) / spacing();
    }

  private:
    glm::dvec3 spacing() const {
        glm::dvec3 step;
        for (int k = 0; k < 3; ++k) {
            const auto& axis = draw_.axes[static_cast<std::size_t>(k)];
            step[k] = (axis.back() - axis.front()) / static_cast<double>(axis.size() - 1);
        }
        return step;
    }

    glm::dvec3 clamped(const glm::dvec3& index) const {
        return glm::clamp(index, glm::dvec3(0), glm::dvec3(first_.dims - 1));
    }

    /// Between a place with a value and one without, both on the ray.
    void addAtBorder(LayerHits& hits, const glm::dvec3& eye, const glm::dvec3& way, double present,
                     double missing) const {
        const double first = present;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (present + missing);
            (std::isnan(value(clamped(eye + middle * way))) ? missing : present) = middle;
        }
        const double f = value(clamped(eye + present * way)) - draw_.iso;
        hits.closestAtBorder = std::min(hits.closestAtBorder, std::abs(f));
        const bool changes = (f >= 0) != (value(clamped(eye + first * way)) >= draw_.iso);
        if (changes) add(hits, eye, way, std::min(first, present), std::max(first, present));
    }

    void add(LayerHits& hits, const glm::dvec3& eye, const glm::dvec3& way, double low, double high) const {
        const bool rises = value(clamped(eye + high * way)) >= draw_.iso;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            ((value(clamped(eye + middle * way)) >= draw_.iso) == rises ? high : low) = middle;
        }
        hits.depths.push_back(high);
        glm::dvec3 gradient;
        const glm::dvec3 index = clamped(eye + high * way);
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 side(0);
            side[k] = 1;
            gradient[k] = (value(clamped(index + side)) - value(clamped(index - side))) / spacing()[k];
        }
        hits.normals.push_back(gradient);
    }

    const LayerDraw& draw_;
    const VolumeSamples& first_;
    const VolumeSamples& second_;
};

}  // namespace isoglass::test
