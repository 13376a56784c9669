// Two key frames of a generated field, the surface halfway between them, and a mesh file of it.
//
//     between_key_frames OUT.ply

#include "mesh/mesh_check.h"
#include "meshio/mesh_file.h"
#include "surface/extract.h"
#include "volume/analytic.h"
#include "volume/time_axis.h"

#include <iostream>

int main(int argc, char** argv) {
    using namespace isoglass;
    if (argc != 2) {
        std::cerr << "usage: between_key_frames OUT.ply\n";
        return 2;
    }
    try {
        // Key frames of any origin will do; these are samples of a formula, at times 0 and 0.2.
        const Lattice lattice = makeUnitLattice(96);
        const TimeAxis time{.times = {0, 0.2}, .units = "s", .calendar = "", .period = {}};
        const auto before = makeAnalyticFrame(lattice, blobs, time.times[0]);
        const auto after = makeAnalyticFrame(lattice, blobs, time.times[1]);

        const TimeSample sample = locate(time, 0.1);
        const TimedField field{before, after, static_cast<float>(sample.fraction)};
        const SurfaceMesh mesh = extractSurface(lattice, field, {.iso = 0.5f}).mesh;

        const MeshTopology topology = checkTopology(mesh);
        writeMesh(argv[1], mesh);
        std::cout << mesh.triangleCount() << " triangles, " << topology.components << " components, "
                  << (topology.isClosed() && topology.isOrientedManifold() ? "closed manifold" : "not closed")
                  << '\n';
        return topology.isOrientedManifold() ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << "between_key_frames: " << error.what() << '\n';
        return 1;
    }
}
