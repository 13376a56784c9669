#include "surface/size_field.h"

#include "volume/pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

/// A size may grow by the cell size h over the diagonal of 8^3 cells of it. Then sizes stay below 4 h in
/// the bricks of size h, bricks that touch are at most one level apart, and blending looks at most two
/// levels up. The rest of this factor below 1 makes up for kMargin.
constexpr double kLargestGrowth = 0.9968;
/// Share by which sizes must exceed that of a coarse brick's cells, against rounding where it touches
/// finer ones.
constexpr float kMargin = 1.0f / 1024;

/// The same for sizes by the error metric. Slower growth keeps more cells compact: they are where a brick's
/// sizes lie between 1 + growth and 1.85 times its cells.
constexpr double kErrorGrowth = 0.25;

/// Growth of the size along one brick side, in a function that is linear in the tetrahedra between brick
/// corners: its gradient is then at most sqrt(3) times this per 8 cells, as much as sizes may grow.
constexpr float kGrowthPerBrick = static_cast<float>(kLargestGrowth / 3);
constexpr float kErrorGrowthPerBrick = static_cast<float>(kErrorGrowth / 3);

/// The largest cell in the world.
struct CellExtent {
    double edge = 0;
    double diagonal = 0;
};

CellExtent largestCell(const LevelSpace& space, const View& view) {
    CellExtent extent;
    for (int k = 0; k < 3; ++k) {
        const double step = space.largestStep[k] * std::abs(view.worldPerUnit[k]);
        extent.edge = std::max(extent.edge, step);
        extent.diagonal += step * step;
    }
    extent.diagonal = std::sqrt(extent.diagonal);
    return extent;
}

}  // namespace

std::vector<const MissingDistance*> missingIn(const TimedField& field) {
    std::vector<const MissingDistance*> missing;
    if (field.fraction < 1) missing.push_back(&field.a->pyramid().missing());
    if (field.fraction > 0) missing.push_back(&field.b->pyramid().missing());
    return missing;
}

SizeField::SizeField(const LevelSpace& space, const View& view, std::vector<const MissingDistance*> missing)
    : missing_(std::move(missing)) {
    std::erase_if(missing_, [](const MissingDistance* distance) { return distance->empty(); });
    const CellExtent cell = largestCell(space, view);
    // Size per world length: what the view asks for, as far as it is allowed.
    const bool byError = view.errorPixels > 0;
    const double cellPixels = byError ? view.errorPixels / kErrorPerCell : view.cellPixels;
    const double factor = std::min(cellPixels / (view.pixelsPerUnit * cell.edge),
                                   (byError ? kErrorGrowth : kLargestGrowth) / (kBrickSize * cell.diagonal));
    growthPerBrick_ =
        static_cast<float>(missing_.empty() ? factor * kBrickSize * cell.diagonal : kLargestGrowth);
    for (int k = 0; k < 3; ++k) {
        const double eye = view.eye[k] - space.levels[0].origin[k];
        for (const double coordinate : space.coordinate[k]) {
            const double part = (coordinate - eye) * view.worldPerUnit[k] * factor;
            squares_[k].push_back(static_cast<float>(part * part));
        }
        nearest_[k] =
            static_cast<int>(std::min_element(squares_[k].begin(), squares_[k].end()) - squares_[k].begin());
    }
}

SizeField::SizeField(const LevelSpace& space, const View& view, const TimedField& field, float iso,
                     int threads)
    : SizeField(space, view, missingIn(field)) {
    if (!(view.errorPixels > 0)) return;
    errors_.emplace(space, view, field, iso, kErrorGrowthPerBrick, threads);
    growthPerBrick_ = std::max(growthPerBrick_, static_cast<float>(kErrorGrowth));
}

float SizeField::at(glm::ivec3 index) const {
    const float sum = squares_[0][index.x] + squares_[1][index.y] + squares_[2][index.z];
    float size = std::max(1.0f, std::sqrt(sum));
    if (errors_) size = std::min(size, errors_->at(index));
    return missing_.empty() ? size : std::min(size, missingLimit(index));
}

void SizeField::inBrick(LevelBrick node, std::span<float> sizes) const {
    constexpr int kSide = kBrickSize + 1;
    const glm::ivec3 first = node.brick * (kBrickSize << node.level);
    std::array<std::array<float, kSide>, 3> squares;
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < kSide; ++i) squares[k][i] = squares_[k][first[k] + (i << node.level)];
    }
    float* row = sizes.data();
    for (int x = 0; x < kSide; ++x) {
        for (int y = 0; y < kSide; ++y, row += kSide) {
            const float sum = squares[0][x] + squares[1][y];
            for (int z = 0; z < kSide; ++z) row[z] = std::max(1.0f, std::sqrt(sum + squares[2][z]));
        }
    }
    if (errors_) errors_->lower(node.level, first, sizes);
    if (missing_.empty()) return;
    float* size = sizes.data();
    for (int x = 0; x < kSide; ++x) {
        for (int y = 0; y < kSide; ++y) {
            for (int z = 0; z < kSide; ++z, ++size)
                *size = std::min(*size, missingLimit(first + (glm::ivec3(x, y, z) << node.level)));
        }
    }
}

/// Linear in each of the six tetrahedra of a brick that go from its first corner to its last.
float SizeField::missingLimit(glm::ivec3 index) const {
    const glm::ivec3 brick = index / kBrickSize;
    const glm::ivec3 part = index % kBrickSize;
    std::array<int, 3> order = {0, 1, 2};
    std::ranges::stable_sort(order, [&](int a, int b) { return part[a] > part[b]; });
    int smallest = std::numeric_limits<int>::max();
    for (const MissingDistance* distance : missing_) {
        glm::ivec3 corner = brick;
        int sum = (kBrickSize - part[order[0]]) * distance->at(corner);
        for (int k = 0; k < 3; ++k) {
            ++corner[order[k]];
            sum += (part[order[k]] - (k < 2 ? part[order[k + 1]] : 0)) * distance->at(corner);
        }
        smallest = std::min(smallest, sum);
    }
    return 1 + kGrowthPerBrick / kBrickSize * static_cast<float>(smallest);
}

float SizeField::smallest(LevelBrick node) const {
    glm::ivec3 index;
    for (int k = 0; k < 3; ++k) {
        const Range range = indices(node, k);
        index[k] = std::clamp(nearest_[k], range.begin, range.end);
    }
    const float sum = squares_[0][index.x] + squares_[1][index.y] + squares_[2][index.z];
    float size = std::max(1.0f, std::sqrt(sum));
    if (errors_)
        size = std::min(size, errors_->smallest(node.level, node.brick * (kBrickSize << node.level)));
    for (const MissingDistance* distance : missing_) {
        const int bricks = distance->smallest(node.level, node.brick);
        size = std::min(size, 1 + kGrowthPerBrick * static_cast<float>(bricks));
    }
    return size;
}

float SizeField::largestByDistance(LevelBrick node) const {
    glm::ivec3 index;
    for (int k = 0; k < 3; ++k) {
        const Range range = indices(node, k);
        index[k] = squares_[k][range.begin] > squares_[k][range.end] ? range.begin : range.end;
    }
    const float sum = squares_[0][index.x] + squares_[1][index.y] + squares_[2][index.z];
    return std::max(1.0f, std::sqrt(sum));
}

float SizeField::largest(LevelBrick node) const {
    const float byDistance = largestByDistance(node);
    if (!errors_) return byDistance;
    // In between sizes are rounded differently than at the corners of which this is the largest.
    constexpr float kRounded = 1 + 0x1p-20f;
    return std::min(byDistance,
                    kRounded * errors_->largest(node.level, node.brick * (kBrickSize << node.level)));
}

bool SizeField::isCoarseEnough(LevelBrick node) const {
    return node.level == 0 || smallest(node) >= (1 + kMargin) * static_cast<float>(1 << node.level);
}

}  // namespace isoglass
