#include "volume/analytic.h"

#include "basis/parallel.h"
#include "volume/series_file.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace isoglass {

namespace {

constexpr int kBlobs = 8;

glm::dvec3 blobCentre(int i, double time) {
    return {0.6 * std::cos(1.7 * i) + time, 0.6 * std::sin(2.3 * i), 0.6 * std::cos(3.1 * i + 1)};
}

/// At a squared distance.
double gaussian(double square) {
    constexpr double kWidth = 0.12;
    return std::exp(-square / (2 * kWidth * kWidth));
}

/// What the blobs are made of, by sample of each axis.
class BlobTables {
  public:
    BlobTables(const Lattice& lattice, double time) {
        for (int k = 0; k < 3; ++k) {
            const std::vector<double>& at = lattice.axes[k].coordinates;
            for (int i = 0; i < kBlobs; ++i) {
                const double centre = blobCentre(i, time)[k];
                for (const double coordinate : at)
                    values_[k][i].push_back(
                        static_cast<float>(gaussian((coordinate - centre) * (coordinate - centre))));
            }
        }
    }

    /// No sample from `low` up to `high` is larger.
    float bound(glm::ivec3 low, glm::ivec3 high) const {
        float sum = 0;
        for (int i = 0; i < kBlobs; ++i) {
            float product = 1;
            for (int k = 0; k < 3; ++k) {
                const auto begin = values_[k][i].begin();
                product *= *std::max_element(begin + low[k], begin + high[k] + 1);
            }
            sum += product;
        }
        return sum;
    }

    /// 8^3 samples in the order of a BrickView, beyond the end those at it.
    void fill(glm::ivec3 low, glm::ivec3 last, float floor, float* out) const {
        for (int x = 0; x < kBrickSize; ++x) {
            for (int y = 0; y < kBrickSize; ++y) {
                for (int i = 0; i < kBlobs; ++i) {
                    const float xy = values_[0][i][std::min(low.x + x, last.x)] *
                                     values_[1][i][std::min(low.y + y, last.y)];
                    for (int z = 0; z < kBrickSize; ++z)
                        out[z] = (i == 0 ? 0 : out[z]) + xy * values_[2][i][std::min(low.z + z, last.z)];
                }
                for (int z = 0; z < kBrickSize; ++z) out[z] = std::max(out[z], floor);
                out += kBrickSize;
            }
        }
    }

  private:
    std::array<std::array<std::vector<float>, kBlobs>, 3> values_;
};

}  // namespace

float blobs(glm::dvec3 position, double time) {
    double sum = 0;
    for (int i = 0; i < kBlobs; ++i) {
        const glm::dvec3 offset = position - blobCentre(i, time);
        sum += gaussian(glm::dot(offset, offset));
    }
    return static_cast<float>(sum);
}

float growingSphere(glm::dvec3 position, double time) {
    return static_cast<float>(1 - glm::length(position) + 0.3 * time);
}

float gyroid(glm::dvec3 position, double time) {
    const glm::dvec3 p = 8.0 * position;
    const double drift = 4 * time;
    return static_cast<float>(std::cos(p.x + drift) * std::sin(p.y) + std::cos(p.y) * std::sin(p.z) +
                              std::cos(p.z) * std::sin(p.x + drift));
}

std::vector<float> sampleField(const Lattice& lattice, const AnalyticField& field, double time) {
    const glm::ivec3 dims = lattice.dims();
    const auto& axes = lattice.axes;
    std::vector<float> samples(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    parallelFor(dims.z, 1, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t z = begin; z < end; ++z) {
            float* out = &samples[z * dims.x * dims.y];
            for (int y = 0; y < dims.y; ++y) {
                for (int x = 0; x < dims.x; ++x) {
                    *out++ =
                        field({axes[0].coordinates[x], axes[1].coordinates[y], axes[2].coordinates[z]}, time);
                }
            }
        }
    });
    return samples;
}

std::shared_ptr<const KeyFrame> makeAnalyticFrame(const Lattice& lattice, const AnalyticField& field,
                                                  double time) {
    return makeKeyFrame(lattice, sampleField(lattice, field, time));
}

std::shared_ptr<const KeyFrame> makeSparseBlobs(const Lattice& lattice, double time, float floor) {
    const BlobTables tables(lattice, time);
    const glm::ivec3 last = lattice.dims() - 1;
    const glm::ivec3 dims = last / kBrickSize + 1;
    std::vector<std::uint32_t> index;
    std::vector<glm::ivec3> stored;
    glm::ivec3 brick;
    for (brick.z = 0; brick.z < dims.z; ++brick.z) {
        for (brick.y = 0; brick.y < dims.y; ++brick.y) {
            for (brick.x = 0; brick.x < dims.x; ++brick.x) {
                const glm::ivec3 low = brick * kBrickSize;
                const bool isFloor = tables.bound(low, glm::min(low + (kBrickSize - 1), last)) <= floor;
                if (!isFloor) stored.push_back(low);
                index.push_back(isFloor ? 0 : static_cast<std::uint32_t>(stored.size()));
            }
        }
    }
    KeyFrame::Pool pool;
    pool.samples.resize(stored.size() * kBrickSamples);
    std::vector<BrickView> bricks(1 + stored.size());
    bricks[0].constant = floor;
    for (std::size_t i = 0; i < stored.size(); ++i) {
        float* const samples = pool.samples.data() + i * kBrickSamples;
        tables.fill(stored[i], last, floor, samples);
        bricks[1 + i].samples = samples;
    }
    return std::make_shared<const KeyFrame>(lattice.dims(), glm::bvec3(false), std::move(pool),
                                            std::move(bricks), std::move(index));
}

Lattice makeUnitLattice(int count) {
    return makeUniformLattice(glm::ivec3(count), glm::dvec3(-1), glm::dvec3(2.0 / (count - 1)));
}

}  // namespace isoglass
