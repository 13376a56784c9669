// Two series that overlap in one picture, each with its own place and clock. No order is given: the
// composition does not depend on one.
//
//     overlapping_volumes FOLDER

#include "pipeline/batch.h"
#include "render/png_file.h"
#include "volume/analytic.h"
#include "volume/series_file.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>

namespace {

using namespace isoglass;

/// A formula, sampled at the times of the key frames.
class Sampled final : public FrameSource {
  public:
    Sampled(std::string name, AnalyticField field, std::vector<double> times) : field_(std::move(field)) {
        series_.name = std::move(name);
        series_.lattice = makeUnitLattice(64);
        series_.time = {.times = std::move(times), .units = "s", .calendar = "", .period = {}};
    }

    const SeriesDescription& description() const override { return series_; }

    void read(std::size_t frame, std::span<float> samples) override {
        std::ranges::copy(sampleField(series_.lattice, field_, series_.time.times[frame]), samples.begin());
    }

  private:
    AnalyticField field_;
    SeriesDescription series_;
};

Volume show(Sampled source, const std::filesystem::path& file) {
    writeSeries(source, file);
    Volume volume;
    volume.name = source.description().name;
    volume.series = file;
    return volume;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: overlapping_volumes FOLDER\n";
        return 2;
    }
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);

        Volume drops = show({"drops", blobs, {0, 0.5, 1}}, folder / "drops.vdb");
        drops.surfaces = {{.iso = 0.5, .color = {0.85f, 0.15f, 0.1f}, .opacity = 0.6f}};
        Volume bubble = show({"bubble", growingSphere, {0, 1}}, folder / "bubble.vdb");
        bubble.surfaces = {{.iso = 0.4, .color = {0.1f, 0.35f, 0.8f}, .opacity = 0.4f}};
        bubble.place.translate = {0.5, 0.3, 0};
        bubble.time = {.offset = 0.25, .scale = 0.5};  // half as fast, and a quarter of a second ahead

        Scene scene;
        scene.volumes = {drops, bubble};
        scene.time = {.from = 0.5, .to = 0.5};
        scene.camera.pose = {.eye = {3, -4, 2.5}, .target = {0.2, 0.1, 0}};
        scene.image.size = {320, 240};

        SceneExtractor extractor(scene, {});
        renderFrames(scene, extractor, {0, 0}, [&](const RenderedFrame& frame) {
            writePng(folder / "overlap.png", frame.image);
            std::cout << "drops at " << frame.meshes.axisTimes[0] << " s, bubble at "
                      << frame.meshes.axisTimes[1] << " s\n";
            return true;
        });
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "overlapping_volumes: " << error.what() << '\n';
        return 1;
    }
}
