#include "surface/corner_grid.h"

#include "basis/parallel.h"

#include <algorithm>
#include <utility>

namespace isoglass {

namespace {

/// Rows that are worth a task: about 2^15 values.
std::size_t slicesPerTask(std::size_t valuesPerSlice) {
    return std::max<std::size_t>(1, (std::size_t{1} << 15) / std::max<std::size_t>(1, valuesPerSlice));
}

/// `row` of n values against the one before it.
void limitRow(const float* from, float growth, int n, float* row) {
    for (int x = 0; x < n; ++x) row[x] = std::min(row[x], from[x] + growth);
}

/// Rows along x, which lie behind each other: several at a time, since each step waits for the one before.
void limitAlongX(float* slice, glm::ivec3 dims, float growth) {
    constexpr int kRows = 8;
    for (int first = 0; first < dims.y; first += kRows) {
        const int rows = std::min(kRows, dims.y - first);
        float* const row = slice + static_cast<std::size_t>(first) * dims.x;
        for (int x = 1; x < dims.x; ++x) {
            for (int r = 0; r < rows; ++r) {
                float* const at = row + static_cast<std::size_t>(r) * dims.x + x;
                *at = std::min(*at, at[-1] + growth);
            }
        }
        for (int x = dims.x - 2; x >= 0; --x) {
            for (int r = 0; r < rows; ++r) {
                float* const at = row + static_cast<std::size_t>(r) * dims.x + x;
                *at = std::min(*at, at[1] + growth);
            }
        }
    }
}

/// Along an axis whose neighbours are `stride` rows of n values apart.
void limitRows(float* first, int count, std::size_t stride, int n, float growth) {
    for (int i = 1; i < count; ++i) limitRow(first + (i - 1) * stride, growth, n, first + i * stride);
    for (int i = count - 2; i >= 0; --i) limitRow(first + (i + 1) * stride, growth, n, first + i * stride);
}

}  // namespace

CornerGrid::CornerGrid(glm::ivec3 n, float value)
    : dims(n), values(static_cast<std::size_t>(n.x) * n.y * n.z, value) {}

void limitGrowth(CornerGrid& grid, float growth, int threads) {
    const glm::ivec3 dims = grid.dims;
    const std::size_t slice = static_cast<std::size_t>(dims.x) * dims.y;
    const std::size_t grain = slicesPerTask(slice);
    parallelFor(static_cast<std::size_t>(dims.z), grain, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t z = begin; z < end; ++z) {
            float* const first = grid.values.data() + z * slice;
            limitAlongX(first, dims, growth);
            limitRows(first, dims.y, static_cast<std::size_t>(dims.x), dims.x, growth);
        }
    });
    parallelFor(static_cast<std::size_t>(dims.y), slicesPerTask(static_cast<std::size_t>(dims.x) * dims.z),
                threads, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t y = begin; y < end; ++y)
                        limitRows(grid.values.data() + y * dims.x, dims.z, slice, dims.x, growth);
                });
}

std::vector<CornerGrid> smallestInCubes(const CornerGrid& grid, int threads) {
    std::vector<CornerGrid> cubes;
    cubes.emplace_back(grid.dims - 1, 0.0f);
    const glm::ivec3 dims = cubes[0].dims;
    const std::size_t grain = slicesPerTask(static_cast<std::size_t>(dims.x) * dims.y);
    parallelFor(static_cast<std::size_t>(dims.z), grain, threads, [&](std::size_t begin, std::size_t end) {
        std::vector<float> row(static_cast<std::size_t>(grid.dims.x));
        for (int z = static_cast<int>(begin); z < static_cast<int>(end); ++z) {
            for (int y = 0; y < dims.y; ++y) {
                const float* const a = &grid.values[grid.place({0, y, z})];
                const float* const b = &grid.values[grid.place({0, y + 1, z})];
                const float* const c = &grid.values[grid.place({0, y, z + 1})];
                const float* const d = &grid.values[grid.place({0, y + 1, z + 1})];
                for (int x = 0; x < grid.dims.x; ++x)
                    row[x] = std::min(std::min(a[x], b[x]), std::min(c[x], d[x]));
                float* const out = &cubes[0].values[cubes[0].place({0, y, z})];
                for (int x = 0; x < dims.x; ++x) out[x] = std::min(row[x], row[x + 1]);
            }
        }
    });
    while (cubes.back().dims != glm::ivec3(1)) {
        const CornerGrid& fine = cubes.back();
        CornerGrid coarse((fine.dims + 1) / 2, 0.0f);
        glm::ivec3 i;
        for (i.z = 0; i.z < coarse.dims.z; ++i.z) {
            for (i.y = 0; i.y < coarse.dims.y; ++i.y) {
                for (i.x = 0; i.x < coarse.dims.x; ++i.x) {
                    float value = fine.at(2 * i);
                    for (int part = 1; part < 8; ++part)
                        value =
                            std::min(value, fine.at(2 * i + glm::ivec3(part & 1, part >> 1 & 1, part >> 2)));
                    coarse.values[coarse.place(i)] = value;
                }
            }
        }
        cubes.push_back(std::move(coarse));
    }
    return cubes;
}

}  // namespace isoglass
