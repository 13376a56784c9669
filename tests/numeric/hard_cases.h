#pragma once

#include "mesh/mesh_check.h"
#include "surface/extract.h"
#include "volume/lattice.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isoglass::numeric {

/// A field that is hard on surface extraction, with the answer that it must give and why.
struct HardCase {
    std::string name;    ///< CamelCase, part of test names
    std::string danger;  ///< what could go wrong, a clause
    std::string reason;  ///< why the expected answer is the right one

    Lattice lattice;
    std::vector<float> samples;  ///< dense, x fastest; NaN, infinite and beyond 1.7e38 are missing
    float iso = 0;
    bool below = false;
    /// Where not empty, the field is that of `fraction` between `samples` and these.
    std::vector<float> later = {};
    float fraction = 0;

    /// What is expected beyond the contract that holds for every case (finite, oriented manifold, open only
    /// where the domain ends or samples are missing); nothing where the reference alone decides.
    struct Answer {
        std::optional<bool> closed = {};
        std::optional<std::size_t> triangles = {};
        std::optional<std::size_t> components = {};
        std::optional<std::ptrdiff_t> eulerNumber = {};
        std::optional<double> area = {};    ///< exact but for float rounding of the positions
        std::optional<double> volume = {};  ///< likewise
        bool loses = false;                 ///< cells are lost to missing samples
    } answer = {};

    TimedField field() const;
    ExtractOptions options(int threads = 1) const;
    /// The samples at the case's time, by the arithmetic that the method fixes; NaN where missing.
    std::vector<float> samplesInTime() const;
};

/// All cases, made once.
const std::vector<HardCase>& hardCases();

/// What a mesh is like, for people: "96 triangles, 24 of zero area; closed manifold".
std::string describe(const SurfaceMesh& mesh);

}  // namespace isoglass::numeric
