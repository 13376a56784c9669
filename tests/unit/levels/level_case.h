#pragma once

#include "surface/extract_view.h"
#include "volume/analytic.h"
#include "volume/pyramid.h"
#include "volume/series_file.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace isoglass::test {

/// Two key frames, a time, a view and an iso-value, drawn by a seed: what the tests of levels try.
struct LevelCase {
    Lattice lattice;
    std::array<std::vector<float>, 2> samples;  ///< dense, x fastest
    TimedField field;
    ExtractOptions options;
    CellForm form = CellForm::sliding;
    float gate = 0;
    std::string name;
};

/// Plain numbers of mt19937, so that the cases are the same on every machine.
class Dice {
  public:
    explicit Dice(std::uint32_t seed) : random_(seed) {}
    std::uint32_t below(std::uint32_t n) { return random_() % n; }
    double unit() { return random_() * 0x1p-32; }
    double between(double low, double high) { return low + unit() * (high - low); }

  private:
    std::mt19937 random_;
};

enum class Kind { blobs, noise, gyroid, integers, steps, rough };
inline constexpr int kKinds = 6;

/// Value in [-1,1]^3 at a time of 0 or 1.
inline float levelField(Kind kind, glm::dvec3 p, int time, Dice& dice) {
    const double at = 0.1 * time;
    switch (kind) {
        case Kind::blobs:
            return blobs(p, at);
        case Kind::noise:
            return static_cast<float>(dice.unit());
        case Kind::gyroid:
            return gyroid(p, at);
        case Kind::integers:
            return static_cast<float>(dice.below(3)) * 0.5f;
        case Kind::steps:
            return std::floor(blobs(p, at) * 8) / 8;
        default:
            return blobs(p, at) + static_cast<float>(0.2 * (dice.unit() - 0.5));
    }
}

inline float isoOf(Kind kind, Dice& dice) {
    switch (kind) {
        case Kind::integers:
            return 0.5f;  // equal to a third of the samples
        case Kind::steps:
            return 0.5f;  // equal to whole regions
        case Kind::gyroid:
            return static_cast<float>(dice.between(-0.5, 0.5));
        default:
            return static_cast<float>(dice.between(0.3, 0.7));
    }
}

/// The case's key frames from its samples, after a change of them.
inline void rebuild(LevelCase& c) {
    c.field.a = makeKeyFrame(c.lattice, c.samples[0]);
    c.field.b = makeKeyFrame(c.lattice, c.samples[1]);
}

/// The eye lies in and around the lattice.
inline LevelCase makeLevelCase(std::uint32_t seed, Kind kind, glm::ivec3 dims) {
    Dice dice(seed);
    LevelCase c;
    c.lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const glm::dvec3 cells = dims - 1;
    for (int time = 0; time < 2; ++time) {
        for (int z = 0; z < dims.z; ++z) {
            for (int y = 0; y < dims.y; ++y) {
                for (int x = 0; x < dims.x; ++x) {
                    const glm::dvec3 p = 2.0 * glm::dvec3(x, y, z) / cells - 1.0;
                    c.samples[time].push_back(levelField(kind, p, time, dice));
                }
            }
        }
    }
    rebuild(c);
    constexpr std::array<float, 4> kFractions = {0, 1, 0.3125f, 0.71f};
    c.field.fraction = kFractions[dice.below(4)];
    View view;
    // Cells per size, from the least that is allowed to the most of a picture; the eye so far away that
    // levels 0 to 3 are seen.
    const double cellsPerSize = std::exp(dice.between(std::log(10.0), std::log(200.0)));
    view.pixelsPerUnit = 1000;
    view.cellPixels = view.pixelsPerUnit / cellsPerSize;
    for (int k = 0; k < 3; ++k) view.eye[k] = 0.5 * cells[k] + dice.between(-5, 5) * cellsPerSize;
    if (seed % 3 == 0) view.eye = glm::round(view.eye);
    c.options.view = view;
    c.options.iso = isoOf(kind, dice);
    c.options.insideIsBelow = dice.below(4) == 0;
    c.form = dice.below(4) == 0 ? CellForm::tetrahedral : CellForm::sliding;
    c.gate = dice.below(2) == 0 ? 0.05f : 0;
    c.options.threads = 1;
    c.name = "seed " + std::to_string(seed) + ", kind " + std::to_string(static_cast<int>(kind)) + ", " +
             std::to_string(dims.x) + "x" + std::to_string(dims.y) + "x" + std::to_string(dims.z);
    return c;
}

/// The steps of an extraction up to the choice of bricks.
struct Selected {
    LevelSpace space;
    SizeField sizes;
    LevelFields fields;
    std::vector<LevelBrick> bricks;

    explicit Selected(const LevelCase& c)
        : space(c.lattice),
          sizes(space, *c.options.view, c.field, c.options.iso, 1),
          fields{space, sizes, fieldsOfLevels(space, c.field), c.options.insideIsBelow ? -1.0f : 1.0f},
          bricks(selectBricks(space, sizes, fields.fields, c.options.iso).bricks) {}
    Selected(const Selected&) = delete;

    std::vector<MeshPart> mesh(const LevelCase& c) const {
        return meshBricks(fields, bricks, {c.options.iso, c.form, c.gate}, 1);
    }
};

/// As extractSurface, with the case's own form of cells.
inline SurfaceMesh meshOf(const LevelCase& c) {
    const Selected selected(c);
    std::vector<MeshPart> parts = selected.mesh(c);
    return joinParts(parts, selected.space.levels[0].origin, 1);
}

}  // namespace isoglass::test
