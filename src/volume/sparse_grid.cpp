#include "volume/sparse_grid.h"

#include "basis/parallel.h"
#include "volume/frame_source.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
using MaskWords = std::array<std::uint64_t, kBrickSize>;

static_assert(Leaf::DIM == kBrickSize, "a brick is one leaf");

/// Bits of the samples of a brick that lie inside the domain.
MaskWords insideMask(glm::ivec3 inside) {
    MaskWords mask{};
    for (int x = 0; x < std::min(inside.x, kBrickSize); ++x) {
        for (int y = 0; y < std::min(inside.y, kBrickSize); ++y) {
            const std::uint64_t row = (1u << std::min(inside.z, kBrickSize)) - 1;
            mask[x] |= row << (y * kBrickSize);
        }
    }
    return mask;
}

MaskWords activeMask(const Leaf& leaf) {
    MaskWords mask;
    for (int x = 0; x < kBrickSize; ++x) mask[x] = leaf.valueMask().getWord<std::uint64_t>(x);
    return mask;
}

/// The nodes that one brick of a dense frame turns into: a leaf, a tile, or nothing.
struct BuiltBrick {
    std::unique_ptr<Leaf> leaf;
    bool tile = false;
    float value = 0;
};

BuiltBrick buildBrick(glm::ivec3 dims, std::span<const float> samples, glm::ivec3 base, double tolerance,
                      const BrickFate* fate) {
    const glm::ivec3 inside = glm::min(dims - base, glm::ivec3(kBrickSize));
    auto leaf = std::make_unique<Leaf>(openvdb::Coord(base.x, base.y, base.z), 0.0f, false);
    float* values = leaf->buffer().data();
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    int count = 0;
    for (int z = 0; z < inside.z; ++z) {
        for (int y = 0; y < inside.y; ++y) {
            const float* row =
                &samples[(static_cast<std::size_t>(base.z + z) * dims.y + base.y + y) * dims.x + base.x];
            for (int x = 0; x < inside.x; ++x) {
                if (!(std::abs(row[x]) <= kLargestValue)) continue;  // nor is a NaN
                const int offset = (x * kBrickSize + y) * kBrickSize + z;
                values[offset] = row[x];
                leaf->setValueOn(offset);
                low = std::min(low, row[x]);
                high = std::max(high, row[x]);
                ++count;
            }
        }
    }
    BuiltBrick built;
    if (count == 0) return built;
    const bool whole = count == kBrickSamples;
    const auto middle = static_cast<float>(0.5 * (static_cast<double>(low) + high));
    const bool flat =
        static_cast<double>(high) - middle <= tolerance && static_cast<double>(middle) - low <= tolerance;
    if (whole && fate && fate->kind == BrickFate::Kind::constant) {
        built.tile = true;
        built.value = fate->constant;
    } else if (whole && flat) {
        built.tile = true;
        built.value = middle;
    } else {
        built.leaf = std::move(leaf);
    }
    return built;
}

/// A brick with samples, of which so many along each axis are inside the domain.
std::unique_ptr<Leaf> makeLeaf(const BrickView& brick, glm::ivec3 inside, const openvdb::Coord& origin) {
    auto leaf = std::make_unique<Leaf>(origin, 0.0f, false);
    const MaskWords mask = insideMask(inside);
    for (int offset = 0; offset < kBrickSamples; ++offset) {
        const int word = offset / 64, bit = offset % 64;
        const bool valid = !brick.valid || brick.valid[word] >> bit & 1;
        if (!valid || !(mask[word] >> bit & 1)) continue;
        leaf->buffer().setValue(offset, brick.samples[offset]);
        leaf->setValueOn(offset);
    }
    return leaf;
}

/// Collects samples and the brick table while it walks a tree.
struct TableBuilder {
    static constexpr std::uint32_t kBackground = 0;

    glm::ivec3 dims;
    glm::ivec3 brickDims;
    bool inactiveIsMissing;
    KeyFrame::Pool pool;
    std::vector<BrickView> bricks;
    std::vector<std::uint32_t> index;
    /// Entries of `bricks` whose samples, and of those whose masks, come next in the pool: it may still
    /// move while it grows.
    std::vector<std::uint32_t> stored;
    std::vector<std::uint32_t> masked;

    TableBuilder(glm::ivec3 dims_, bool inactiveIsMissing_, float background)
        : dims(dims_),
          brickDims((dims_ + (kBrickSize - 1)) / kBrickSize),
          inactiveIsMissing(inactiveIsMissing_) {
        BrickView view;
        view.missing = inactiveIsMissing;
        view.constant = background;
        bricks.push_back(view);
        index.assign(static_cast<std::size_t>(brickDims.x) * brickDims.y * brickDims.z, kBackground);
    }

    std::uint32_t& at(glm::ivec3 b) {
        return index[(static_cast<std::size_t>(b.z) * brickDims.y + b.y) * brickDims.x + b.x];
    }

    void addTile(const openvdb::CoordBBox& box, float value, bool active) {
        if (!active && inactiveIsMissing) return;
        const auto brickOf = [](int coordinate) { return coordinate >> 3; };
        glm::ivec3 first;
        glm::ivec3 last;
        for (int k = 0; k < 3; ++k) {
            first[k] = std::max(brickOf(box.min()[k]), 0);
            last[k] = std::min(brickOf(box.max()[k]), brickDims[k] - 1);
            if (first[k] > last[k]) return;
        }
        BrickView view;
        view.constant = value;
        const auto entry = static_cast<std::uint32_t>(bricks.size());
        bricks.push_back(view);
        for (int z = first.z; z <= last.z; ++z) {
            for (int y = first.y; y <= last.y; ++y) {
                for (int x = first.x; x <= last.x; ++x) at({x, y, z}) = entry;
            }
        }
    }

    void addLeaf(const Leaf& leaf) {
        const openvdb::Coord origin = leaf.origin();
        const glm::ivec3 base(origin.x(), origin.y(), origin.z());
        if (glm::any(glm::lessThan(base, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(base, dims)))
            return;
        const auto entry = static_cast<std::uint32_t>(bricks.size());
        if (inactiveIsMissing) {
            const MaskWords inside = insideMask(dims - base);
            MaskWords valid = activeMask(leaf);
            for (int x = 0; x < kBrickSize; ++x) valid[x] &= inside[x];
            if (std::all_of(valid.begin(), valid.end(), [](std::uint64_t word) { return word == 0; })) return;
            if (valid != inside) {
                pool.valid.insert(pool.valid.end(), valid.begin(), valid.end());
                masked.push_back(entry);
            }
        }
        const float* samples = leaf.buffer().data();
        pool.samples.insert(pool.samples.end(), samples, samples + kBrickSamples);
        stored.push_back(entry);
        bricks.emplace_back();
        at(base / kBrickSize) = entry;
    }

    void pointIntoPool() {
        for (std::size_t i = 0; i < stored.size(); ++i)
            bricks[stored[i]].samples = &pool.samples[i * kBrickSamples];
        for (std::size_t i = 0; i < masked.size(); ++i) bricks[masked[i]].valid = &pool.valid[i * kBrickSize];
    }
};

}  // namespace

openvdb::FloatGrid::Ptr makeSparseGrid(glm::ivec3 dims, std::span<const float> samples, double tolerance,
                                       std::span<const BrickFate> fates) {
    const glm::ivec3 brickDims = (dims + (kBrickSize - 1)) / kBrickSize;
    const std::size_t count = static_cast<std::size_t>(brickDims.x) * brickDims.y * brickDims.z;
    auto grid = openvdb::FloatGrid::create(0.0f);
    // A slab of bricks at a time bounds what stands beside the finished tree.
    const std::size_t slab = static_cast<std::size_t>(brickDims.x) * brickDims.y;
    std::vector<BuiltBrick> built(slab);
    for (std::size_t first = 0; first < count; first += slab) {
        const auto base = [&](std::size_t i) {
            return kBrickSize * glm::ivec3(i % brickDims.x, i / brickDims.x % brickDims.y, i / slab);
        };
        parallelFor(slab, 16, 0, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const BrickFate* fate = fates.empty() ? nullptr : &fates[first + i];
                built[i] = buildBrick(dims, samples, base(first + i), tolerance, fate);
            }
        });
        for (std::size_t i = 0; i < slab; ++i) {
            const glm::ivec3 corner = base(first + i);
            if (built[i].leaf) {
                grid->tree().addLeaf(built[i].leaf.release());
            } else if (built[i].tile) {
                grid->tree().addTile(1, openvdb::Coord(corner.x, corner.y, corner.z), built[i].value, true);
            }
        }
    }
    grid->tree().prune();
    return grid;
}

openvdb::FloatGrid::Ptr makeSparseGrid(const KeyFrame& frame) {
    auto grid = openvdb::FloatGrid::create(0.0f);
    const glm::ivec3 bricks = frame.brickDims();
    const std::size_t layer = static_cast<std::size_t>(bricks.x) * bricks.y;
    for (std::size_t i = 0; i < frame.brickCount(); ++i) {
        const BrickView& brick = frame.brick(i);
        const glm::ivec3 base = kBrickSize * glm::ivec3(i % bricks.x, i / bricks.x % bricks.y, i / layer);
        const openvdb::Coord origin(base.x, base.y, base.z);
        if (brick.samples) {
            grid->tree().addLeaf(makeLeaf(brick, frame.dims() - base, origin).release());
        } else if (!brick.missing) {
            grid->tree().addTile(1, origin, brick.constant, true);
        }
    }
    return grid;
}

std::shared_ptr<const KeyFrame> makeKeyFrame(const openvdb::FloatGrid& grid, glm::ivec3 dims,
                                             glm::bvec3 periodic, bool inactiveIsMissing,
                                             std::shared_ptr<const KeyFrame> heights) {
    TableBuilder table(dims, inactiveIsMissing, grid.background());
    auto tile = grid.tree().cbeginValueAll();
    tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        table.addTile(box, tile.getValue(), tile.isValueOn());
    }
    table.pool.samples.reserve(grid.tree().leafCount() * kBrickSamples);
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) table.addLeaf(*leaf);
    table.pool.samples.shrink_to_fit();
    table.pointIntoPool();
    return std::make_shared<KeyFrame>(dims, periodic, std::move(table.pool), std::move(table.bricks),
                                      std::move(table.index), std::move(heights));
}

}  // namespace isoglass
