#include "fuzz/fuzz.h"
#include "mesh/mesh_check.h"
#include "support/boundary_check.h"
#include "surface/extract.h"
#include "volume/series_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace isoglass::fuzz {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Values that a kernel may stumble over; the first half is ordinary, so that surfaces are common.
constexpr std::array<float, 32> kValues = {
    0,      1,       2,         3,          -1,      -2,       0.5f,      0.25f,         1,
    0,      1.5f,    -0.0f,     1,          -1,      0.1f,     7,         1e30f,         -1e30f,
    1e-30f, -1e-30f, 0x1p-149f, -0x1p-149f, 1.7e38f, -1.7e38f, 0x1p-126f, 0x1.000002p0f, 0x1.fffffep-1f,
    kNan,   kNan,    kInfinity, -kInfinity, 3.4e38f,
};

std::vector<float> takeSamples(Bytes& bytes, std::size_t count, bool raw) {
    std::vector<float> samples(count);
    for (float& sample : samples)
        sample = raw ? std::bit_cast<float>(bytes.word()) : kValues[bytes.next() % kValues.size()];
    return samples;
}

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void checkVertices(const SurfaceMesh& mesh, glm::ivec3 cells) {
    require(mesh.normals.size() == mesh.positions.size(), "every vertex has a normal");
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::vec3 position = mesh.positions[i];
        const glm::vec3 normal = mesh.normals[i];
        require(isFinite(position) && isFinite(normal), "vertices are finite");
        require(normal.x != 0 || normal.y != 0 || normal.z != 0, "no normal is zero");
        for (int k = 0; k < 3; ++k)
            require(position[k] >= 0 && position[k] <= static_cast<float>(cells[k]), "vertices lie inside");
    }
}

/// The samples as the engine may see them: what is not a usable number is missing at every time that the
/// key frame has a part in.
std::vector<float> missingIn(const std::vector<float>& a, const std::vector<float>& b, float fraction) {
    constexpr float kLargest = 1.7e38f;
    const auto usable = [](float value) { return std::abs(value) <= kLargest; };
    std::vector<float> result(a.size(), 0);
    for (std::size_t i = 0; i < a.size(); ++i) {
        if ((fraction < 1 && !usable(a[i])) || (fraction > 0 && !usable(b[i]))) result[i] = kNan;
    }
    return result;
}

}  // namespace

// Whatever the samples are, the mesh is finite, an oriented manifold, and open only where the domain ends or
// a sample is missing.
void run(std::span<const std::uint8_t> data) {
    Bytes bytes(data);
    const std::uint8_t flags = bytes.next();
    const glm::ivec3 dims(1 + bytes.next() % 11, 1 + bytes.next() % 11, 1 + bytes.next() % 11);
    const float iso = flags & 1 ? std::bit_cast<float>(bytes.word()) : kValues[bytes.next() % kValues.size()];
    const float fraction = static_cast<float>(bytes.next()) / 255;
    const bool below = flags & 2;
    const bool raw = flags & 4;
    Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const bool periodic = flags & 8;
    if (periodic) lattice.axes[flags >> 6 & 1].period = lattice.axes[flags >> 6 & 1].size();

    const auto a = takeSamples(bytes, sampleCount(dims), raw);
    const auto b = takeSamples(bytes, sampleCount(dims), raw);
    const SurfaceMesh mesh =
        extractSurface(lattice, {makeKeyFrame(lattice, a), makeKeyFrame(lattice, b), fraction},
                       {.iso = iso, .insideIsBelow = below, .threads = 1})
            .mesh;
    checkVertices(mesh, lattice.cells());
    const MeshTopology topology = checkTopology(mesh);
    require(topology.isOrientedManifold(), "the mesh is an oriented manifold");
    require(topology.unreferencedVertices == 0, "every vertex is used");
    if (periodic) return;
    const auto missing = missingIn(a, b, fraction);
    for (const test::MeshEdge& edge : test::boundaryEdges(mesh))
        require(test::liesOnTheEnd(mesh, edge, lattice.cells()) ||
                    test::liesBesideMissing(mesh, edge, dims, missing),
                "the mesh is open only where the domain ends or a sample is missing");
}

}  // namespace isoglass::fuzz
