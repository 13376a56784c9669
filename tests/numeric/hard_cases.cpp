#include "numeric/hard_cases.h"

#include "numeric/case_fields.h"
#include "volume/frame_source.h"
#include "volume/series_file.h"

#include <cmath>
#include <limits>

namespace isoglass::numeric {

TimedField HardCase::field() const {
    return {makeKeyFrame(lattice, samples), later.empty() ? nullptr : makeKeyFrame(lattice, later), fraction};
}

ExtractOptions HardCase::options(int threads) const {
    return {.iso = iso, .insideIsBelow = below, .threads = threads};
}

std::vector<float> HardCase::samplesInTime() const {
    constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
    const auto known = [](float value) { return std::abs(value) <= kLargestValue ? value : kMissing; };
    std::vector<float> result;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const float a = known(samples[i]);
        if (later.empty() || fraction == 0) {
            result.push_back(a);
        } else {
            const float b = known(later[i]);
            result.push_back(fraction == 1 ? b : a + fraction * (b - a));
        }
    }
    return result;
}

const std::vector<HardCase>& hardCases() {
    static const std::vector<HardCase> cases = [] {
        std::vector<HardCase> all = equalSampleCases();
        for (auto make : {signCases, specialValueCases, latticeCases, timeCases}) {
            for (HardCase& hard : make()) all.push_back(std::move(hard));
        }
        return all;
    }();
    return cases;
}

std::string describe(const SurfaceMesh& mesh) {
    if (mesh.empty()) return "no surface";
    const MeshTopology topology = checkTopology(mesh);
    const MeshMeasures measures = measure(mesh);
    std::string text = std::to_string(mesh.triangleCount()) + " triangles";
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0) text += ", " + std::to_string(count) + what;
    };
    add(measures.zeroAreaTriangles, " of zero area");
    add(topology.degenerateTriangles, " degenerate");
    add(measures.nonFiniteVertices, " vertices not finite");
    add(topology.nonManifoldEdges, " non-manifold edges");
    add(topology.misorientedEdges, " misoriented edges");
    add(topology.nonManifoldVertices, " non-manifold vertices");
    if (topology.isOrientedManifold()) {
        text += topology.isClosed()
                    ? "; closed manifold"
                    : "; manifold, " + std::to_string(topology.boundaryEdges) + " boundary edges";
    } else {
        text += "; " + std::to_string(topology.boundaryEdges) + " boundary edges";
    }
    return text;
}

}  // namespace isoglass::numeric
