// Semi-transparent surfaces with IsoGlass and with VTK: the same triangles, size and renderer, in one run; at
// the end larger surfaces, of which IsoGlass draws the detail that each view asks for and VTK all.
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
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace isoglass {
namespace {

constexpr int kViews = 24;

/// Three surfaces of the blobs, for a view or at full resolution.
std::vector<PeerSurface> makeSurfaces(int samples = 128, const std::optional<View>& view = {}) {
    static std::map<int, std::shared_ptr<const KeyFrame>> frames;
    const Lattice lattice = makeUnitLattice(samples);
    if (!frames[samples]) frames[samples] = makeAnalyticFrame(lattice, blobs, 0);
    const TimedField field{frames[samples], nullptr, 0};
    std::vector<PeerSurface> surfaces;
    const LinearColor colors[] = {{0.2f, 0.5f, 1.0f}, {0.3f, 0.9f, 0.3f}, {1.0f, 0.4f, 0.2f}};
    const float isos[] = {0.3f, 0.5f, 0.8f};
    for (int i = 0; i < 3; ++i) {
        surfaces.push_back({extractSurface(lattice, field, {.iso = isos[i], .view = view, .threads = 1}).mesh,
                            colors[i], 0.3f});
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

std::size_t trianglesOf(const std::vector<PeerSurface>& surfaces) {
    std::size_t triangles = 0;
    for (const PeerSurface& surface : surfaces) triangles += surface.mesh.triangleCount();
    return triangles;
}

/// `draw` draws the view turned by so many degrees, to the end. `prepare` is not timed.
void report(
    const std::string& name, int side, std::size_t triangles, const std::function<void(double)>& draw,
    const std::function<void(double)>& prepare = [](double) {}) {
    std::vector<double> wall, cpu;
    prepare(0);
    draw(0);
    for (int view = 0; view < kViews; ++view) {
        prepare(5.0 * view);
        const double cpuBegin = cpuMilliseconds();
        const auto begin = std::chrono::steady_clock::now();
        draw(5.0 * view);
        wall.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
        cpu.push_back(cpuMilliseconds() - cpuBegin);
    }
    std::printf(R"({"name":"%s","size":%d,"median_ms":%.2f,"cpu_ms":%.2f,"triangles":%zu})"
                "\n",
                name.c_str(), side, median(wall), median(cpu), triangles);
}

void runVtk(const std::string& name, int side, VtkWay way, int samples = 128) {
    const std::vector<PeerSurface> surfaces = makeSurfaces(samples);
    VtkScene scene(surfaces, side, way);
    report(name, side, trianglesOf(surfaces), [&](double degrees) { scene.draw(degrees); });
}

/// Draws on the renderer's own thread.
class OurScene {
  public:
    OurScene(int side, TransparencyMethod method, bool reproducible) : renderer_(context_.context()) {
        frame_.camera = {.eye = {3, 2, 2.5}, .up = {0, 1, 0}, .fovDegrees = 30, .size = {side, side}};
        frame_.method = method;
        frame_.reproducible = reproducible;
        frame_.keepLinear = false;
    }

    void turn(double degrees) {
        const glm::dvec4 eye(3, 2, 2.5, 1);
        frame_.camera.eye =
            glm::dvec3(glm::rotate(glm::dmat4(1), glm::radians(degrees), frame_.camera.up) * eye);
    }
    void show(const std::vector<PeerSurface>& surfaces) {
        for (const SurfaceDraw& old : frame_.draws) renderer_.meshes().release(old.mesh);
        frame_.draws.clear();
        for (const PeerSurface& surface : surfaces) {
            frame_.draws.push_back({.mesh = renderer_.meshes().upload(surface.mesh),
                                    .color = surface.color,
                                    .opacity = surface.opacity});
        }
    }
    void draw() {
        renderer_.render(frame_);
        glFinish();
    }
    const CameraView& camera() const { return frame_.camera; }

  private:
    gl::HeadlessContext context_;
    Renderer renderer_;
    FrameDescription frame_;
};

void runOurs(const std::string& name, int side, TransparencyMethod method, bool reproducible) {
    OurScene scene(side, method, reproducible);
    const std::vector<PeerSurface> surfaces = makeSurfaces();
    scene.show(surfaces);
    report(name, side, trianglesOf(surfaces), [&](double degrees) {
        scene.turn(degrees);
        scene.draw();
    });
}

/// The meshes are those of each view, made and uploaded before its time is taken; their triangles are those
/// of the first one.
void runOurDetail(const std::string& name, int side, TransparencyMethod method, int samples,
                  double errorPixels) {
    OurScene scene(side, method, false);
    const auto surfacesOf = [&] {
        View view{.eye = scene.camera().eye, .errorPixels = errorPixels};
        view.pixelsPerUnit = side / (2 * std::tan(glm::radians(scene.camera().fovDegrees) / 2));
        return makeSurfaces(samples, view);
    };
    report(
        name, side, trianglesOf(surfacesOf()), [&](double) { scene.draw(); },
        [&](double degrees) {
            scene.turn(degrees);
            scene.show(surfacesOf());
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

void runDetail(int side) {
    constexpr int kSamples = 256;
    using enum TransparencyMethod;
    isolated([&] { runVtk("vtk weighted transparency, 256^3", side, {}, kSamples); });
    isolated([&] { runOurDetail("isoglass 3-pass, 256^3 at 0.5 px", side, threePass, kSamples, 0.5); });
    isolated([&] { runOurDetail("isoglass 3-pass, 256^3 in full", side, threePass, kSamples, 0); });
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1;
    for (int round = 0; round < rounds; ++round) {
        for (const int side : {512, 1024}) isoglass::runAll(side);
        isoglass::runDetail(720);
    }
}
