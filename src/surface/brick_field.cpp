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

/// Where the 3^3 bricks around a gathered one keep their samples: rows of 8 along z. A constant brick
/// lends the same row everywhere, so that it is read like any other.
class NeighbourRows {
  public:
    /// False where one of them has missing samples. All must lie inside the domain.
    bool find(const KeyFrame& frame, glm::ivec3 brick) {
        for (int i = 0; i < 27; ++i) {
            const glm::ivec3 neighbour = brick + glm::ivec3(i / 9, i / 3 % 3, i % 3) - 1;
            const BrickView& view = frame.brick(frame.linear(neighbour));
            if (view.missing || view.valid) return false;
            if (!view.samples) constant_[i].fill(view.constant);
            first_[i] = view.samples ? view.samples : constant_[i].data();
            stride_[i] = view.samples ? kBrickSize : 0;
        }
        return true;
    }

    /// Row of the brick numbered `neighbour` (x slowest, z fastest, each 0 to 2).
    const float* row(int neighbour, int x, int y) const {
        return first_[neighbour] + stride_[neighbour] * (x * kBrickSize + y);
    }

  private:
    std::array<const float*, 27> first_;
    std::array<int, 27> stride_;
    std::array<std::array<float, kBrickSize>, 27> constant_;
};

/// Calls `copy(row, neighbour, x, y)` for every gathered row along z, `neighbour` being the first of the
/// three bricks that it runs through and x, y the place in them.
template <typename Copy>
void forEachRow(float* values, Copy copy) {
    for (int i = 0; i < kFieldSize; ++i) {
        const int x = i + kBrickSize - 1;
        for (int j = 0; j < kFieldSize; ++j) {
            const int y = j + kBrickSize - 1;
            const int neighbour = (x / kBrickSize * 3 + y / kBrickSize) * 3;
            copy(values + i * BrickField::kStrideX + j * BrickField::kStrideY, neighbour, x % kBrickSize,
                 y % kBrickSize);
        }
    }
}

/// Evaluates one gathered row, `value(neighbour, z)` being the sample z of one of the three bricks along z.
template <typename Value>
void fillRow(float* out, Value value) {
    out[0] = value(0, kBrickSize - 1);
    for (int z = 0; z < kBrickSize; ++z) out[z + 1] = value(1, z);
    out[kBrickSize + 1] = value(2, 0);
    out[kBrickSize + 2] = value(2, 1);
}

/// The common case, without a look at single samples: all samples around the brick are there, and the
/// gathered box does not wrap. False where that is not so.
bool gatherInterior(const IndexSpace& space, const TimedField& field, glm::ivec3 brick, BrickField& out) {
    for (int k = 0; k < 3; ++k) {
        if (brick[k] == 0 || (brick[k] + 1) * kBrickSize + 1 >= space.stored[k]) return false;
    }
    NeighbourRows a;
    if (!a.find(field.fraction == 1 ? *field.b : *field.a, brick)) return false;
    out.complete = true;
    if (field.fraction == 0 || field.fraction == 1) {
        forEachRow(out.values.data(), [&](float* row, int first, int x, int y) {
            const std::array rows = {a.row(first, x, y), a.row(first + 1, x, y), a.row(first + 2, x, y)};
            fillRow(row, [&](int neighbour, int z) { return rows[neighbour][z]; });
        });
        return true;
    }
    NeighbourRows b;
    if (!b.find(*field.b, brick)) return false;
    const float s = field.fraction;
    forEachRow(out.values.data(), [&](float* row, int first, int x, int y) {
        const std::array rowsA = {a.row(first, x, y), a.row(first + 1, x, y), a.row(first + 2, x, y)};
        const std::array rowsB = {b.row(first, x, y), b.row(first + 1, x, y), b.row(first + 2, x, y)};
        fillRow(row, [&](int neighbour, int z) {
            return rowsA[neighbour][z] + s * (rowsB[neighbour][z] - rowsA[neighbour][z]);
        });
    });
    return true;
}

/// The general case: ends of the domain, periodic axes, missing samples.
void gatherAnywhere(const IndexSpace& space, const TimedField& field, glm::ivec3 brick, BrickField& scratch,
                    BrickField& out) {
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
}

}  // namespace

void gatherBrick(const IndexSpace& space, const TimedField& field, glm::ivec3 brick, float sign,
                 BrickField& scratch, BrickField& out) {
    if (!gatherInterior(space, field, brick, out)) gatherAnywhere(space, field, brick, scratch, out);
    if (sign < 0) {
        for (float& value : out.values) value = -value;
    }
}

}  // namespace isoglass
