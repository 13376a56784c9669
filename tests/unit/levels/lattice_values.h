#pragma once

#include "surface/blended_brick.h"
#include "surface/extract_view.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace isoglass::test {

/// The bricks of all levels that cover the domain, whether the surface touches them or not.
inline void coverWithBricks(const LevelSpace& space, const SizeField& sizes, LevelBrick node,
                            std::vector<LevelBrick>& out) {
    for (int k = 0; k < 3; ++k) {
        if (node.brick[k] * kBrickSize >= space.cellsAt(node.level)[k]) return;
    }
    if (sizes.isCoarseEnough(node)) {
        out.push_back(node);
        return;
    }
    for (int child = 0; child < 8; ++child) {
        coverWithBricks(space, sizes,
                        {node.level - 1, 2 * node.brick + glm::ivec3(child & 1, child >> 1 & 1, child >> 2)},
                        out);
    }
}

inline std::vector<LevelBrick> coverWithBricks(const LevelSpace& space, const SizeField& sizes) {
    std::vector<LevelBrick> bricks;
    coverWithBricks(space, sizes, {space.top(), glm::ivec3(0)}, bricks);
    return bricks;
}

/// The blended, piecewise linear functions at every vertex of level 0, whatever bricks they come from.
struct LatticeValues {
    static constexpr int kChannels = 7;  ///< field, position, gradient
    using Values = std::array<double, kChannels>;

    std::vector<Values> at;
    /// Largest difference between what bricks that share a vertex say there.
    Values disagreement{};
};

namespace detail {

/// Linear in the tetrahedron of a cell that holds the point `part` / `size` of it.
template <typename Corner>
LatticeValues::Values inCell(glm::ivec3 cell, glm::ivec3 part, int size, const Corner& corner) {
    std::array<int, 3> order = {0, 1, 2};
    std::ranges::stable_sort(order, [&](int a, int b) { return part[a] > part[b]; });
    LatticeValues::Values result{};
    const auto add = [&](int share) {
        if (share == 0) return;
        const LatticeValues::Values values = corner(cell);
        for (std::size_t i = 0; i < values.size(); ++i) result[i] += values[i] * share / size;
    };
    add(size - part[order[0]]);
    for (int k = 0; k < 3; ++k) {
        ++cell[order[k]];
        add(part[order[k]] - (k < 2 ? part[order[k + 1]] : 0));
    }
    return result;
}

}  // namespace detail

/// `blending` off takes each brick's own level as it is: levels then switch at once.
inline LatticeValues latticeValues(const LevelFields& fields, bool blending = true) {
    const glm::ivec3 dims = fields.space.cells + 1;
    LatticeValues result;
    result.at.resize(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    std::vector<bool> known(result.at.size());
    const auto brick = std::make_unique<BlendedBrick>();
    for (const LevelBrick& node : coverWithBricks(fields.space, fields.sizes)) {
        brick->load(fields, node);
        const int size = 1 << node.level;
        const glm::ivec3 base = node.brick * kBrickSize;
        const auto corner = [&](glm::ivec3 v) {
            const Channels& c = brick->channels(v);
            LatticeValues::Values values = {brick->values()[cornerPlace(v)],
                                            c.position.x,
                                            c.position.y,
                                            c.position.z,
                                            c.gradient.x,
                                            c.gradient.y,
                                            c.gradient.z};
            if (!blending) {
                const glm::ivec3 last = fields.space.cellsAt(node.level);
                const auto& field = fields.fields[node.level];
                const glm::ivec3 sample = glm::min(base + v, last);
                values[0] = field.a->sample(sample) +
                            field.fraction * (field.b->sample(sample) - field.a->sample(sample));
            }
            return values;
        };
        const glm::ivec3 first = base * size;
        const glm::ivec3 last = glm::min(first + kBrickSize * size, fields.space.cells);
        glm::ivec3 i;
        for (i.z = first.z; i.z <= last.z; ++i.z) {
            for (i.y = first.y; i.y <= last.y; ++i.y) {
                for (i.x = first.x; i.x <= last.x; ++i.x) {
                    const glm::ivec3 cell = glm::min((i - first) / size, glm::ivec3(kBrickSize - 1));
                    const LatticeValues::Values values =
                        detail::inCell(cell, i - first - cell * size, size, corner);
                    const std::size_t place = (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
                    if (known[place]) {
                        for (std::size_t k = 0; k < values.size(); ++k)
                            result.disagreement[k] =
                                std::max(result.disagreement[k], std::abs(values[k] - result.at[place][k]));
                    }
                    result.at[place] = values;
                    known[place] = true;
                }
            }
        }
    }
    return result;
}

inline LatticeValues::Values largestChange(const LatticeValues& a, const LatticeValues& b) {
    LatticeValues::Values largest{};
    for (std::size_t i = 0; i < a.at.size(); ++i) {
        for (std::size_t k = 0; k < largest.size(); ++k)
            largest[k] = std::max(largest[k], std::abs(a.at[i][k] - b.at[i][k]));
    }
    return largest;
}

}  // namespace isoglass::test
