#include "surface/box_field.h"

#include <algorithm>
#include <array>
#include <limits>

namespace isoglass {

namespace {

/// Clamped indices along one axis, split into brick and sample, in runs that lie in one brick.
struct AxisPlaces {
    AxisPlaces(int first, int count, int last) : n(count) {
        for (int i = 0; i < n; ++i) {
            const int index = std::clamp(first + i, 0, last);
            brick[i] = index / kBrickSize;
            sample[i] = index % kBrickSize;
        }
    }
    int runEnd(int begin) const {
        int end = begin;
        while (end < n && brick[end] == brick[begin]) ++end;
        return end;
    }

    int n;
    std::array<int, kBrickSize> brick;
    std::array<int, kBrickSize> sample;
};

float valueIn(const BrickView& brick, int x, int y, int z) {
    if (brick.missing) return std::numeric_limits<float>::quiet_NaN();
    if (!brick.samples) return brick.constant;
    if (brick.valid && !(brick.valid[x] >> (y * kBrickSize + z) & 1))
        return std::numeric_limits<float>::quiet_NaN();
    return brick.samples[(x * kBrickSize + y) * kBrickSize + z];
}

/// Calls `copy(brick, x range, y range, z range)` for every brick that the box meets.
template <typename Copy>
void forEachPart(const std::array<AxisPlaces, 3>& places, Copy copy) {
    for (int x = 0, xEnd; x < places[0].n; x = xEnd) {
        xEnd = places[0].runEnd(x);
        for (int y = 0, yEnd; y < places[1].n; y = yEnd) {
            yEnd = places[1].runEnd(y);
            for (int z = 0, zEnd; z < places[2].n; z = zEnd) {
                zEnd = places[2].runEnd(z);
                copy(glm::ivec3(x, y, z), glm::ivec3(xEnd, yEnd, zEnd));
            }
        }
    }
}

}  // namespace

void gatherBox(const TimedField& field, glm::ivec3 last, glm::ivec3 first, int n, float sign, float* out) {
    const std::array<AxisPlaces, 3> places = {AxisPlaces(first.x, n, last.x), AxisPlaces(first.y, n, last.y),
                                              AxisPlaces(first.z, n, last.z)};
    const KeyFrame& a = field.fraction == 1 ? *field.b : *field.a;
    const bool between = field.fraction > 0 && field.fraction < 1;
    forEachPart(places, [&](glm::ivec3 begin, glm::ivec3 end) {
        const glm::ivec3 brick(places[0].brick[begin.x], places[1].brick[begin.y], places[2].brick[begin.z]);
        const BrickView& viewA = a.brick(a.linear(brick));
        const BrickView& viewB = between ? field.b->brick(field.b->linear(brick)) : viewA;
        for (int x = begin.x; x < end.x; ++x) {
            for (int y = begin.y; y < end.y; ++y) {
                float* row = out + (x * n + y) * n;
                for (int z = begin.z; z < end.z; ++z) {
                    const glm::ivec3 sample(places[0].sample[x], places[1].sample[y], places[2].sample[z]);
                    float value = valueIn(viewA, sample.x, sample.y, sample.z);
                    if (between) {
                        const float other = valueIn(viewB, sample.x, sample.y, sample.z);
                        value += field.fraction * (other - value);
                    }
                    row[z] = sign * value;
                }
            }
        }
    });
}

}  // namespace isoglass
