#pragma once

#include "mesh/surface_mesh.h"
#include "pipeline/key_frame_cache.h"
#include "pipeline/played_series.h"
#include "plan/work_plan.h"
#include "scene/scene.h"
#include "surface/extract.h"
#include "volume/time_axis.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isoglass {

/// One surface of the scene at one moment.
struct ExtractedSurface {
    std::size_t volume = 0;                   ///< index into `Scene::volumes`
    std::size_t surface = 0;                  ///< index into its `surfaces`
    std::shared_ptr<const SurfaceMesh> mesh;  ///< empty where the plan leaves its extraction out
    ExtractStats stats;
    bool caps = false;  ///< what fills the surface's cuts; comes after the surface, where there are cuts
};

/// All surfaces of the scene at one moment, in the order of the scene. Always whole.
struct SceneMeshes {
    std::vector<ExtractedSurface> surfaces;
    std::vector<TimeSample> times;               ///< one a volume
    std::vector<double> axisTimes;               ///< one a volume, in its series' own units
    std::vector<std::vector<PlannedWork>> work;  ///< one a volume: what was done for it, and why
};

/// Turns moments of a scene into meshes: reads, interpolates in time, extracts.
///
/// Use `extract` from one thread at a time, the extraction thread; the rest from any.
class SceneExtractor {
  public:
    struct Options {
        std::size_t memoryBytes = std::size_t{2} << 30;  ///< budget for key frames
        int threads = 0;                                 ///< for the inner loops; 0 takes all cores
    };

    /// Opens every series of the scene. Throws Error where one cannot be read, is not the grid that the
    /// scene names, or where the scene's times mean nothing to it.
    SceneExtractor(const Scene& scene, Options options);

    /// All surfaces at `position` (0 is the timeline's `from`, 1 its `to`), for a picture seen from
    /// `camera` of `imageHeight` pixels. Key frames ahead are read while this works.
    SceneMeshes extract(double position, const CameraPose& camera, int imageHeight);

    /// Moves the scene's planes (world coordinates) for the calls of `extract` that follow.
    void setClip(std::vector<ClipPlane> planes) { scene_.clip = std::move(planes); }

    /// One a volume, in the order of the scene.
    const std::vector<PlayedSeries>& series() const { return series_; }
    /// Of the volumes, then of the surfaces that are coloured by one.
    std::vector<std::shared_ptr<const SeriesFile>> files() const;
    const KeyFrameCache& cache() const { return *cache_; }

  private:
    /// A series that colours a surface.
    struct ColorSeries {
        std::size_t volume = 0;
        std::size_t surface = 0;
        PlayedSeries played;
    };

    /// `series` numbers those of the volumes, then those that colour.
    TimedField fieldAt(std::size_t series, const TimeSample& sample, bool first, bool second);
    std::vector<PlannedWork> planAt(std::size_t volume, const TimeSample& sample) const;
    std::vector<float> colorValues(const SurfaceMesh& mesh, const ExtractedSurface& place,
                                   const TimedField& field, double position);
    std::vector<FrameKey> framesAhead(double position) const;
    View viewOf(const Volume& volume, const CameraPose& camera, int imageHeight) const;

    Scene scene_;
    Options options_;
    std::vector<PlayedSeries> series_;
    std::vector<ColorSeries> colorSeries_;
    std::unique_ptr<KeyFrameCache> cache_;
};

}  // namespace isoglass
