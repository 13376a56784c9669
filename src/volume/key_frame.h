#pragma once

#include "volume/series_description.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace isoglass {

class DetailError;
class Pyramid;

/// Samples along one side of a brick; one OpenVDB leaf.
inline constexpr int kBrickSize = 8;
inline constexpr int kBrickSamples = kBrickSize * kBrickSize * kBrickSize;

/// The samples of one brick, in the order of an OpenVDB leaf: z fastest, sample (x,y,z) at (x*8 + y)*8 + z.
struct BrickView {
    /// 512 samples; null where the brick is constant or missing.
    const float* samples = nullptr;
    /// 8 words, bit y*8 + z of word x says that the sample is valid; null where all samples inside the
    /// domain are valid. Samples that are not valid have any value.
    const std::uint64_t* valid = nullptr;
    float constant = 0;    ///< the value of every sample where `samples` is null and not `missing`
    bool missing = false;  ///< no sample of the brick is valid
};

/// One key frame in memory: sparse samples in bricks of 8^3 and the range of every brick.
///
/// OpenVDB holds series in files and while they are built; here the samples of its leaves lie in one
/// block, without the nodes above them, which for small key frames weigh more than the samples.
/// Immutable, so any number of threads may read it. Bricks cover the samples: brick b holds the samples
/// 8b .. 8b+7 of each axis; the last brick of an axis may reach beyond the domain.
class KeyFrame {
  public:
    /// What the bricks point into.
    struct Pool {
        std::vector<float> samples;        ///< kBrickSamples a stored brick
        std::vector<std::uint64_t> valid;  ///< kBrickSize words a brick that has missing samples
    };

    /// `brickIndex` names the entry of `bricks` for every brick, x fastest; the entries point into `pool`.
    /// `periodic` says along which axes the first sample follows the last. `heights`, if any, are those of
    /// the same samples.
    KeyFrame(glm::ivec3 dims, glm::bvec3 periodic, Pool pool, std::vector<BrickView> bricks,
             std::vector<std::uint32_t> brickIndex, std::shared_ptr<const KeyFrame> heights = nullptr);
    ~KeyFrame();

    glm::ivec3 dims() const { return dims_; }
    glm::bvec3 periodic() const { return periodic_; }
    /// Cells along each axis: one less than the samples, as many where it is periodic.
    glm::ivec3 cells() const { return dims_ - 1 + glm::ivec3(periodic_); }
    glm::ivec3 brickDims() const { return brickDims_; }
    std::size_t brickCount() const { return brickIndex_.size(); }

    /// Position of brick (x,y,z) in the order of `brick` and `range`: x fastest.
    std::size_t linear(glm::ivec3 brick) const {
        return (static_cast<std::size_t>(brick.z) * brickDims_.y + brick.y) * brickDims_.x + brick.x;
    }
    const BrickView& brick(std::size_t linear) const { return bricks_[brickIndex_[linear]]; }

    /// Range over the valid samples of the closed brick: its own 8^3 and the first ones of the next
    /// bricks (9^3 in all), which bounds the field in the brick's cells.
    ValueRange range(std::size_t linear) const { return ranges_[linear]; }

    /// World z of every sample, as a second channel in the same bricks; null where the lattice's third axis
    /// table says it (`Lattice::heights`).
    const std::shared_ptr<const KeyFrame>& heights() const { return heights_; }

    /// Value of one sample, NaN where it is missing. For tests and probes, not for loops.
    float sample(glm::ivec3 index) const;

    /// Memory that the key frame holds: samples, masks and tables, with those of its heights, without the
    /// pyramid.
    std::size_t bytes() const;

    /// The coarser levels, built by the first call: about a seventh of the samples is copied. Any thread,
    /// but not from inside a parallel loop.
    const Pyramid& pyramid() const;
    /// What the coarser levels lack, with the pyramid built by the first call: looks at every sample. Called
    /// as `pyramid` is.
    const DetailError& detailError() const;

  private:
    void computeRanges(glm::bvec3 periodic);

    glm::ivec3 dims_;
    glm::bvec3 periodic_;
    glm::ivec3 brickDims_;
    Pool pool_;
    std::vector<BrickView> bricks_;
    std::vector<std::uint32_t> brickIndex_;
    std::vector<ValueRange> ranges_;
    std::shared_ptr<const KeyFrame> heights_;
    mutable std::once_flag pyramidOnce_;
    mutable std::unique_ptr<const Pyramid> pyramid_;
    mutable std::once_flag detailErrorOnce_;
    mutable std::unique_ptr<const DetailError> detailError_;
};

}  // namespace isoglass
