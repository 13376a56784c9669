#include "surface/brick_field.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace isoglass {

namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Consecutive samples of a gathered axis that lie in one stored brick.
struct Run {
    int begin;  ///< first place in the gathered axis, from 0
    int length;
    int brick;   ///< stored brick, -1 outside the domain
    int sample;  ///< first sample in that brick
};

struct Runs {
    std::array<Run, kFieldSize> run;
    int count = 0;
};

Runs makeRuns(const IndexSpace& space, int axis, int brick) {
    Runs runs;
    for (int place = 0; place < kFieldSize; ++place) {
        const int stored = space.storedIndex(axis, brick * kBrickSize - 1 + place);
        const int owner = stored < 0 ? -1 : stored / kBrickSize;
        const int sample = stored < 0 ? 0 : stored % kBrickSize;
        Run* last = runs.count > 0 ? &runs.run[runs.count - 1] : nullptr;
        if (last && last->brick == owner && (owner < 0 || last->sample + last->length == sample)) {
            ++last->length;
        } else {
            runs.run[runs.count++] = {place, 1, owner, sample};
        }
    }
    return runs;
}

void copyRow(const BrickView& brick, int x, int y, const Run& run, float* out) {
    const int row = (x * kBrickSize + y) * kBrickSize;
    if (run.length == kBrickSize) {
        std::memcpy(out, brick.samples + row, kBrickSize * sizeof(float));
    } else {
        std::copy_n(brick.samples + row + run.sample, run.length, out);
    }
    if (!brick.valid) return;
    const std::uint64_t valid = brick.valid[x] >> (y * kBrickSize + run.sample);
    for (int z = 0; z < run.length; ++z) {
        if (!(valid >> z & 1)) out[z] = kMissing;
    }
}

/// Copies what one stored brick gives; returns whether all of it is valid.
bool copyBlock(const BrickView* brick, const Run& rx, const Run& ry, const Run& rz, float* out) {
    const bool stored = brick && brick->samples;
    const float constant = brick && !brick->missing ? brick->constant : kMissing;
    for (int x = 0; x < rx.length; ++x) {
        for (int y = 0; y < ry.length; ++y) {
            float* row = out + (rx.begin + x) * BrickField::kStrideX + (ry.begin + y) * BrickField::kStrideY +
                         rz.begin;
            if (stored) {
                copyRow(*brick, rx.sample + x, ry.sample + y, rz, row);
            } else {
                std::fill_n(row, rz.length, constant);
            }
        }
    }
    return brick && !brick->missing && !brick->valid;
}

void gatherKeyFrame(const KeyFrame& frame, const std::array<Runs, 3>& runs, BrickField& out) {
    out.complete = true;
    for (int i = 0; i < runs[0].count; ++i) {
        const Run& rx = runs[0].run[i];
        for (int j = 0; j < runs[1].count; ++j) {
            const Run& ry = runs[1].run[j];
            for (int k = 0; k < runs[2].count; ++k) {
                const Run& rz = runs[2].run[k];
                const bool inside = rx.brick >= 0 && ry.brick >= 0 && rz.brick >= 0;
                const BrickView* brick =
                    inside ? &frame.brick(frame.linear({rx.brick, ry.brick, rz.brick})) : nullptr;
                out.complete &= copyBlock(brick, rx, ry, rz, out.values.data());
            }
        }
    }
}

}  // namespace

void gatherBrick(const IndexSpace& space, const TimedField& field, glm::ivec3 brick, float sign,
                 BrickField& scratch, BrickField& out) {
    const std::array<Runs, 3> runs = {makeRuns(space, 0, brick.x), makeRuns(space, 1, brick.y),
                                      makeRuns(space, 2, brick.z)};
    gatherKeyFrame(field.fraction == 1 ? *field.b : *field.a, runs, out);
    if (field.fraction > 0 && field.fraction < 1) {
        gatherKeyFrame(*field.b, runs, scratch);
        out.complete &= scratch.complete;
        const float s = field.fraction;
        for (std::size_t i = 0; i < out.values.size(); ++i) {
            out.values[i] += s * (scratch.values[i] - out.values[i]);
        }
    }
    if (sign < 0) {
        for (float& value : out.values) value = -value;
    }
}

}  // namespace isoglass
