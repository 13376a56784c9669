#pragma once

#include "pipeline/extraction_worker.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace isoglass::test {

inline constexpr std::size_t kKeyFrames = 6;

/// Displayed frames of a lap through the looped series.
inline constexpr std::uint64_t kFramesPerLap = 40;

/// ISOGLASS_SOAK_FRAMES, else what takes a few seconds.
inline std::uint64_t soakFrames() {
    const char* frames = std::getenv("ISOGLASS_SOAK_FRAMES");
    return frames ? std::strtoull(frames, nullptr, 10) : 5 * kFramesPerLap;
}

/// Blobs that swing through six key frames and begin anew, in two surfaces, at half a pixel of detail.
inline Scene makeSoakScene(const std::filesystem::path& series, int samples = 41) {
    const Lattice lattice = makeUnitLattice(samples);
    SeriesDescription description = describe(lattice, kKeyFrames);
    description.time.period = kKeyFrames;
    std::vector<std::vector<float>> frames;
    for (std::size_t i = 0; i < kKeyFrames; ++i)
        frames.push_back(sampleField(lattice, blobs, 0.2 * std::sin(2 * M_PI * i / kKeyFrames)));
    MemorySource source(description, std::move(frames));
    writeSeries(source, series);

    Scene scene;
    Volume volume;
    volume.name = "swing";
    volume.series = series;
    volume.surfaces = {{.iso = 0.7, .opacity = 1}, {.iso = 0.3, .opacity = 0.4f}};
    scene.volumes = {std::move(volume)};
    scene.time = {.from = 0.0, .to = double{kKeyFrames}, .duration = kFramesPerLap / 25.0, .fps = 25};
    scene.quality.errorPixels = 0.5;
    scene.image.size = {96, 64};
    return scene;
}

/// Request number `frame`: the eye goes round once a lap, near and far.
inline FrameRequest soakRequest(std::uint64_t frame, glm::ivec2 size) {
    const double lap = static_cast<double>(frame % kFramesPerLap) / kFramesPerLap;
    const double angle = 2 * M_PI * lap;
    FrameRequest request;
    request.number = frame;
    request.position = lap;
    request.camera.eye = (3 + 2 * std::sin(angle)) * glm::dvec3(std::cos(angle), std::sin(angle), 0.4);
    request.camera.target = glm::dvec3(0);
    request.imageSize = size;
    return request;
}

}  // namespace isoglass::test
