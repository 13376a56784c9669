// Semi-transparent surfaces with IsoGlass and with VTK: the same triangles, size and renderer, in one run.
// usage: transparency_peer [ROUNDS]
#include "gl/headless_context.h"
#include "render/renderer.h"
#include "surface/extract.h"
#include "volume/analytic.h"
#include "vtk_scene.h"

#include <epoxy/gl.h>
#include <glm/ext/matrix_transform.hpp>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

namespace isoglass {
namespace {

constexpr int kViews = 24;

std::vector<PeerSurface> makeSurfaces() {
    const Lattice lattice = makeUnitLattice(128);
    const TimedField field{makeAnalyticFrame(lattice, blobs, 0), nullptr, 0};
    std::vector<PeerSurface> surfaces;
    const LinearColor colors[] = {{0.2f, 0.5f, 1.0f}, {0.3f, 0.9f, 0.3f}, {1.0f, 0.4f, 0.2f}};
    const float isos[] = {0.3f, 0.5f, 0.8f};
    for (int i = 0; i < 3; ++i) {
        surfaces.push_back(
            {extractSurface(lattice, field, {.iso = isos[i], .threads = 1}).mesh, colors[i], 0.3f});
    }
    return surfaces;
}

double cpuMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// `draw` draws the view turned by so many degrees, to the end.
void report(const std::string& name, int side, const std::function<void(double)>& draw) {
    std::vector<double> wall, cpu;
    draw(0);
    for (int view = 0; view < kViews; ++view) {
        const double cpuBegin = cpuMilliseconds();
        const auto begin = std::chrono::steady_clock::now();
        draw(5.0 * view);
        wall.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
        cpu.push_back(cpuMilliseconds() - cpuBegin);
    }
    std::size_t triangles = 0;
    for (const PeerSurface& surface : makeSurfaces()) triangles += surface.mesh.triangleCount();
    std::printf(R"({"name":"%s","size":%d,"median_ms":%.2f,"cpu_ms":%.2f,"triangles":%zu})"
                "\n",
                name.c_str(), side, median(wall), median(cpu), triangles);
}

void runVtk(const std::string& name, int side, VtkWay way) {
    VtkScene scene(makeSurfaces(), side, way);
    report(name, side, [&](double degrees) { scene.draw(degrees); });
}

void runOurs(const std::string& name, int side, TransparencyMethod method, bool reproducible) {
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    FrameDescription frame;
    frame.camera = {.eye = {3, 2, 2.5}, .up = {0, 1, 0}, .fovDegrees = 30, .size = {side, side}};
    frame.method = method;
    frame.reproducible = reproducible;
    frame.keepLinear = false;
    for (const PeerSurface& surface : makeSurfaces()) {
        frame.draws.push_back({.mesh = renderer.meshes().upload(surface.mesh),
                               .color = surface.color,
                               .opacity = surface.opacity});
    }
    const glm::dvec4 eye(frame.camera.eye, 1);
    report(name, side, [&](double degrees) {
        frame.camera.eye =
            glm::dvec3(glm::rotate(glm::dmat4(1), glm::radians(degrees), frame.camera.up) * eye);
        renderer.render(frame);
        glFinish();
    });
}

/// In a child: a context, threads and memory of its own.
void isolated(const std::function<void()>& run) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        run();
        std::fflush(stdout);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (status != 0) std::fprintf(stderr, "a case ended with status %d\n", status);
}

void runAll(int side) {
    using enum TransparencyMethod;
    isolated([&] { runVtk("vtk weighted transparency", side, {}); });
    isolated([&] { runOurs("isoglass 3-pass", side, threePass, false); });
    isolated([&] { runOurs("isoglass 4-pass", side, fourPass, false); });
    isolated([&] { runVtk("vtk dual depth peeling 4", side, {4}); });
    isolated([&] { runVtk("vtk dual depth peeling 8", side, {8}); });
    isolated([&] { runOurs("isoglass exact", side, exact, false); });
    isolated([&] { runOurs("isoglass 2-pass", side, twoPass, false); });
    isolated([&] { runOurs("isoglass peel 4", side, peel, false); });
    isolated([&] { runOurs("isoglass 3-pass reproducible", side, threePass, true); });
    isolated([&] { runOurs("isoglass 4-pass reproducible", side, fourPass, true); });
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1;
    for (int round = 0; round < rounds; ++round) {
        for (const int side : {512, 1024}) isoglass::runAll(side);
    }
}
