// Own data, as a series of key frames, played as pictures: a wave that runs through a box.
//
//     time_series_playback FOLDER

#include "pipeline/batch.h"
#include "render/png_file.h"
#include "volume/frame_source.h"
#include "volume/series_file.h"

#include <cmath>
#include <filesystem>
#include <iostream>

namespace {

using namespace isoglass;

/// Whatever holds samples becomes a series by saying where they lie and handing out one key frame after
/// the other. Here a formula holds them; key frames need not be evenly spaced.
class Wave final : public FrameSource {
  public:
    Wave() {
        series_.name = "height";
        series_.lattice = makeUniformLattice({80, 60, 24}, {-2, -1.5, -0.6}, glm::dvec3(0.05));
        series_.time = {.times = {0, 1, 2, 4}, .units = "s", .calendar = "", .period = {}};
        series_.provenance = "a formula";
    }

    const SeriesDescription& description() const override { return series_; }

    void read(std::size_t frame, std::span<float> samples) override {
        const double time = series_.time.times[frame];
        const auto& axes = series_.lattice.axes;
        std::size_t i = 0;
        for (const double z : axes[2].coordinates) {
            for (const double y : axes[1].coordinates) {
                for (const double x : axes[0].coordinates) {
                    const double wave = std::sin(3 * x - 0.4 * time) * std::cos(2 * y + 0.3 * time);
                    samples[i++] = static_cast<float>(0.3 * wave - z);
                }
            }
        }
    }

  private:
    SeriesDescription series_;
};

Scene makeScene(const std::filesystem::path& series) {
    Scene scene;
    Volume volume;
    volume.name = "wave";
    volume.series = series;
    // Inside is where the wave lies above z + iso.
    volume.surfaces = {{.iso = 0, .color = {0.1f, 0.45f, 0.6f}},
                       {.iso = -0.25, .color = {0.7f, 0.8f, 0.9f}, .opacity = 0.3f}};
    scene.volumes = {volume};
    scene.time = {.from = 0.0, .to = 4.0, .duration = 0.4, .fps = 25};
    scene.camera.pose = {.eye = {4, -6, 4}, .target = {0, 0, 0}};
    scene.image.size = {320, 200};
    return scene;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: time_series_playback FOLDER\n";
        return 2;
    }
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);
        Wave wave;
        writeSeries(wave, folder / "wave.vdb");

        const Scene scene = makeScene(folder / "wave.vdb");
        SceneExtractor extractor(scene, {});
        renderFrames(scene, extractor, {0, scene.time.frameCount() - 1}, [&](const RenderedFrame& frame) {
            std::size_t triangles = 0;
            for (const ExtractedSurface& surface : frame.meshes.surfaces) {
                triangles += surface.mesh->triangleCount();
            }
            writePng(folder / ("wave-" + std::to_string(frame.frame) + ".png"), frame.image);
            std::cout << "frame " << frame.frame << ": time " << frame.meshes.axisTimes[0] << ", "
                      << triangles << " triangles\n";
            return true;
        });
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "time_series_playback: " << error.what() << '\n';
        return 1;
    }
}
