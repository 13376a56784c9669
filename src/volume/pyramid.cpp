#include "volume/pyramid.h"

#include "basis/parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace isoglass {

namespace {

constexpr ValueRange kEmptyRange{std::numeric_limits<float>::infinity(),
                                 -std::numeric_limits<float>::infinity()};
constexpr std::size_t kBricksPerTask = 64;

std::size_t count(glm::ivec3 n) {
    return static_cast<std::size_t>(n.x) * n.y * n.z;
}

glm::ivec3 placeOf(std::size_t linear, glm::ivec3 n) {
    return {linear % n.x, linear / n.x % n.y, linear / (static_cast<std::size_t>(n.x) * n.y)};
}

glm::ivec3 halved(glm::ivec3 n) {
    return (n + 1) / 2;
}

/// One brick of the coarser level, made from the finer one.
struct CoarseBrick {
    enum class Kind { stored, constant, missing };
    Kind kind = Kind::missing;
    float constant = 0;
    std::vector<float> samples;
    std::vector<std::uint64_t> valid;  ///< empty where all samples inside the domain are valid
};

/// Makes level l + 1 from level l.
class Coarsening {
  public:
    Coarsening(const KeyFrame& fine, glm::ivec3 fineCells, glm::bvec3 finePeriodic)
        : fine_(fine), fineCells_(fineCells), finePeriodic_(finePeriodic), dims_(halved(fineCells) + 1) {}

    std::shared_ptr<const KeyFrame> run() const {
        const glm::ivec3 bricks = (dims_ + (kBrickSize - 1)) / kBrickSize;
        std::vector<CoarseBrick> made(count(bricks));
        parallelFor(made.size(), kBricksPerTask, 0, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) made[i] = make(placeOf(i, bricks));
        });
        return assemble(made);
    }

  private:
    /// Index on the finer level of a sample of the coarser one.
    int source(int axis, int i) const {
        const int index = std::min(2 * i, fineCells_[axis]);
        return finePeriodic_[axis] ? index % fineCells_[axis] : index;
    }

    /// Value of all samples that the brick is made of, where they are one value or all missing.
    std::optional<CoarseBrick> uniform(glm::ivec3 first, glm::ivec3 last) const {
        std::optional<CoarseBrick> found;
        glm::ivec3 b;
        for (b.z = first.z; b.z <= last.z; ++b.z) {
            for (b.y = first.y; b.y <= last.y; ++b.y) {
                for (b.x = first.x; b.x <= last.x; ++b.x) {
                    const BrickView& view = fine_.brick(fine_.linear(b));
                    if (view.samples) return std::nullopt;
                    const auto kind = view.missing ? CoarseBrick::Kind::missing : CoarseBrick::Kind::constant;
                    const float value = view.missing ? 0 : view.constant;
                    if (!found) found = CoarseBrick{kind, value, {}, {}};
                    if (found->kind != kind || found->constant != value) return std::nullopt;
                }
            }
        }
        return found;
    }

    CoarseBrick make(glm::ivec3 brick) const {
        const glm::ivec3 base = brick * kBrickSize;
        const glm::ivec3 inside = glm::min(dims_ - base, glm::ivec3(kBrickSize));
        glm::ivec3 first;
        glm::ivec3 last;
        bool wraps = false;
        for (int k = 0; k < 3; ++k) {
            first[k] = source(k, base[k]) / kBrickSize;
            last[k] = source(k, base[k] + inside[k] - 1) / kBrickSize;
            wraps = wraps || last[k] < first[k];
        }
        if (!wraps) {
            if (auto same = uniform(first, last)) return std::move(*same);
        }
        return gather(base, inside);
    }

    CoarseBrick gather(glm::ivec3 base, glm::ivec3 inside) const {
        CoarseBrick made;
        made.kind = CoarseBrick::Kind::stored;
        made.samples.assign(kBrickSamples, 0);
        std::vector<std::uint64_t> valid(kBrickSize, 0);
        bool anyMissing = false;
        bool anyValid = false;
        for (int x = 0; x < inside.x; ++x) {
            for (int y = 0; y < inside.y; ++y) {
                for (int z = 0; z < inside.z; ++z) {
                    const float value =
                        fine_.sample({source(0, base.x + x), source(1, base.y + y), source(2, base.z + z)});
                    const bool isValid = value == value;
                    anyMissing |= !isValid;
                    anyValid |= isValid;
                    if (!isValid) continue;
                    made.samples[(x * kBrickSize + y) * kBrickSize + z] = value;
                    valid[x] |= std::uint64_t{1} << (y * kBrickSize + z);
                }
            }
        }
        if (!anyValid) return {};
        if (anyMissing) made.valid = std::move(valid);
        return made;
    }

    std::shared_ptr<const KeyFrame> assemble(const std::vector<CoarseBrick>& made) const {
        KeyFrame::Pool pool;
        std::vector<BrickView> views(1);
        views[0].missing = true;
        std::vector<std::uint32_t> index(made.size(), 0);
        const auto stored = std::count_if(made.begin(), made.end(), [](const CoarseBrick& brick) {
            return brick.kind == CoarseBrick::Kind::stored;
        });
        const auto masked = std::count_if(made.begin(), made.end(),
                                          [](const CoarseBrick& brick) { return !brick.valid.empty(); });
        // Reserved once: the views point into the pool.
        pool.samples.reserve(stored * kBrickSamples);
        pool.valid.reserve(masked * kBrickSize);
        for (std::size_t i = 0; i < made.size(); ++i) {
            const CoarseBrick& brick = made[i];
            if (brick.kind == CoarseBrick::Kind::missing) continue;
            BrickView view;
            view.constant = brick.constant;
            if (brick.kind == CoarseBrick::Kind::stored) {
                view.samples = pool.samples.data() + pool.samples.size();
                pool.samples.insert(pool.samples.end(), brick.samples.begin(), brick.samples.end());
                if (!brick.valid.empty()) {
                    view.valid = pool.valid.data() + pool.valid.size();
                    pool.valid.insert(pool.valid.end(), brick.valid.begin(), brick.valid.end());
                }
            }
            index[i] = static_cast<std::uint32_t>(views.size());
            views.push_back(view);
        }
        return std::make_shared<const KeyFrame>(dims_, glm::bvec3(false), std::move(pool), std::move(views),
                                                std::move(index));
    }

    const KeyFrame& fine_;
    glm::ivec3 fineCells_;
    glm::bvec3 finePeriodic_;
    glm::ivec3 dims_;
};

ValueRange joined(ValueRange a, ValueRange b) {
    return {std::min(a.min, b.min), std::max(a.max, b.max)};
}

}  // namespace

int topLevel(glm::ivec3 cells) {
    const int largest = std::max({cells.x, cells.y, cells.z});
    int level = 0;
    while (largest > kBrickSize << level) ++level;
    return level;
}

Lattice coarseLattice(const Lattice& lattice, int level) {
    Lattice coarse = lattice;
    if (level == 0) return coarse;
    for (std::size_t k = 0; k < 3; ++k) {
        const Axis& fine = lattice.axes[k];
        const std::size_t cells = fine.cells();
        const std::size_t stride = std::size_t{1} << level;
        std::vector<double>& coordinates = coarse.axes[k].coordinates;
        coordinates.clear();
        for (std::size_t i = 0; i < cells; i += stride) coordinates.push_back(fine.coordinate(i));
        coordinates.push_back(fine.coordinate(cells));
        coarse.axes[k].period.reset();
    }
    return coarse;
}

Pyramid::Pyramid(const KeyFrame& base) : missing_(base) {
    glm::ivec3 cells = base.cells();
    const int top = topLevel(cells);
    Hulls hulls{(cells + (kBrickSize - 1)) / kBrickSize, {}};
    hulls.ranges.resize(count(hulls.bricks));
    for (std::size_t i = 0; i < hulls.ranges.size(); ++i)
        hulls.ranges[i] = base.range(base.linear(placeOf(i, hulls.bricks)));
    hulls_.push_back(std::move(hulls));

    glm::bvec3 periodic = base.periodic();
    const KeyFrame* fine = &base;
    for (int level = 1; level <= top; ++level) {
        levels_.push_back(Coarsening(*fine, cells, periodic).run());
        fine = levels_.back().get();
        cells = halved(cells);
        periodic = glm::bvec3(false);
        const Hulls& below = hulls_.back();
        Hulls next{halved(below.bricks), {}};
        next.ranges.assign(count(next.bricks), kEmptyRange);
        for (std::size_t i = 0; i < below.ranges.size(); ++i) {
            const glm::ivec3 parent = placeOf(i, below.bricks) / 2;
            ValueRange& range =
                next.ranges[(static_cast<std::size_t>(parent.z) * next.bricks.y + parent.y) * next.bricks.x +
                            parent.x];
            range = joined(range, below.ranges[i]);
        }
        hulls_.push_back(std::move(next));
    }
}

std::size_t Pyramid::bytes() const {
    std::size_t sum = missing_.bytes();
    for (const auto& level : levels_) sum += level->bytes();
    for (const Hulls& hulls : hulls_) sum += hulls.ranges.size() * sizeof(ValueRange);
    return sum;
}

std::size_t Pyramid::largestBytes(glm::ivec3 dims, std::size_t baseBytes) {
    // A brick with samples, its mask, and its places in the tables of views, indices and ranges.
    constexpr std::size_t kBrickBytes = kBrickSamples * sizeof(float) + kBrickSize * sizeof(std::uint64_t);
    constexpr std::size_t kTableBytes = sizeof(BrickView) + sizeof(std::uint32_t) + sizeof(ValueRange);
    // A coarse brick has samples only where a fine one under it has; at a brick's faces it may need eight
    // of them, but no fine brick serves more than eight coarse ones.
    glm::ivec3 cells = dims;
    std::size_t sum = 0;
    std::size_t finerStored = baseBytes / (kBrickSamples * sizeof(float)) + 1;
    const int top = topLevel(cells);
    for (int level = 0; level <= top; ++level) {
        const std::size_t hulls = count((cells + (kBrickSize - 1)) / kBrickSize) * sizeof(ValueRange);
        // One more byte for every corner and every brick of a level: the distances from missing samples.
        sum += hulls + 2 * count((cells + (kBrickSize - 1)) / kBrickSize + 1);
        if (level > 0) {
            const std::size_t bricks = count((cells + kBrickSize) / kBrickSize);
            finerStored = std::min(bricks, 8 * finerStored);
            sum += finerStored * kBrickBytes + (bricks + 1) * kTableBytes;
        }
        cells = halved(cells);
    }
    return sum;
}

}  // namespace isoglass
