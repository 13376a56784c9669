#pragma once

#include "support/surface_reference.h"
#include "surface/extract.h"
#include "volume/series_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace isoglass::test {

inline bool sameBytes(const SurfaceMesh& a, const SurfaceMesh& b) {
    const auto same = [](const auto& left, const auto& right) {
        return left.size() == right.size() &&
               (left.empty() || std::memcmp(left.data(), right.data(), left.size() * sizeof left[0]) == 0);
    };
    return std::memcmp(&a.origin, &b.origin, sizeof a.origin) == 0 && same(a.positions, b.positions) &&
           same(a.normals, b.normals) && same(a.triangles, b.triangles);
}

/// One key frame alone.
inline Extraction extractFrame(const Lattice& lattice, std::shared_ptr<const KeyFrame> frame,
                               const ExtractOptions& options) {
    return extractSurface(lattice, {std::move(frame), nullptr, 0}, options);
}

inline Extraction extractDense(const Lattice& lattice, std::span<const float> samples,
                               const ExtractOptions& options) {
    return extractFrame(lattice, makeKeyFrame(lattice, samples), options);
}

/// The field at one time between two dense frames, in the arithmetic that the method fixes.
inline std::vector<float> interpolated(const std::vector<float>& a, const std::vector<float>& b,
                                       float fraction) {
    std::vector<float> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] + fraction * (b[i] - a[i]);
    return result;
}

/// A vertex is computed in double and rounded once: half an ulp of its largest coordinate relative to
/// the origin, and as much again for the double arithmetic of both sides.
inline double positionTolerance(const Lattice& lattice, glm::dvec3 origin) {
    double largest = 0;
    for (const glm::dvec3& corner : lattice.bounds()) {
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(corner[k] - origin[k]));
    }
    return largest * std::numeric_limits<float>::epsilon();
}

/// A difference quotient has values of at most 2 * largest / step; between it and the normal lie the
/// rounding of the difference, of the axis factor, of their product, of the sum of two such products
/// and of the interpolation between two gradients: below 16 ulp of the quotient.
inline double normalTolerance(const Lattice& lattice, std::span<const float> samples) {
    double smallestStep = std::numeric_limits<double>::infinity();
    for (const Axis& axis : lattice.axes) {
        for (std::size_t i = 1; i <= axis.cells(); ++i) {
            smallestStep = std::min(smallestStep, std::abs(axis.coordinate(i) - axis.coordinate(i - 1)));
        }
    }
    double largest = 0;
    for (const float sample : samples) {
        if (!std::isnan(sample)) largest = std::max(largest, std::abs(static_cast<double>(sample)));
    }
    return 16 * std::numeric_limits<float>::epsilon() * 2 * largest / smallestStep;
}

/// The mesh is that of the reference, and the engine counts the same lost cells.
inline void expectAsReference(const Lattice& lattice, const std::vector<float>& samples, float iso,
                              bool insideIsBelow, const std::string& what) {
    const Extraction found =
        extractDense(lattice, samples, {.iso = iso, .insideIsBelow = insideIsBelow, .threads = 1});
    const ReferenceSurface wanted = extractReference(lattice, samples, iso, insideIsBelow);
    EXPECT_EQ(differenceFromReference(found.mesh, wanted, positionTolerance(lattice, found.mesh.origin),
                                      normalTolerance(lattice, samples)),
              "")
        << what;
    EXPECT_EQ(found.stats.lostCells, wanted.lostCells) << what;
}

}  // namespace isoglass::test
