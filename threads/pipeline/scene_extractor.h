#pragma once

#include "mesh/surface_mesh.h"
#include "pipeline/key_frame_cache.h"
#include "pipeline/played_series.h"
#include "pipeline/scene_samples.h"
#include "plan/work_plan.h"
#include "scene/scene.h"
#include "surface/extract.h"
#include "volume/time_axis.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// How the moments follow each other, for what is read ahead.
struct Course {
    bool forwards = true;
    bool loops = false;  ///< from the end of the timeline to its beginning, or back

    friend bool operator==(const Course&, const Course&) = default;
};

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
    /// One a volume, in its own coordinates: holds its surfaces with what of them was left out. May be empty.
    std::vector<std::array<glm::dvec3, 2>> bounds;
    std::vector<TimeSample> times;  ///< one a volume
    /// One a volume where meshes have velocities: what the fraction of the time between its key frames grows
    /// by while the position on the timeline grows by 1; 0 at key frames. Else empty.
    std::vector<double> fractionsPerPosition;
    std::vector<double> motionLimits;            ///< one a volume, likewise; see motion.h
    std::vector<double> axisTimes;               ///< one a volume, in its series' own units
    std::vector<std::vector<PlannedWork>> work;  ///< one a volume: what was done for it, and why
    /// One a volume: the stored level that was taken in place of its key frames, or of those that colour it,
    /// because they are not there yet; 0 where all is as the scene wants it.
    std::vector<int> substitutes;
    std::optional<SceneSamples> samples;  ///< where rays go through a volume that is not clipped away
    std::vector<std::shared_ptr<const SurfaceMesh>>
        objects{};  ///< one a `Scene::meshes`; the same ones always

    /// Those of the surfaces, then the objects.
    std::vector<std::shared_ptr<const SurfaceMesh>> meshes() const;

    /// The coarsest of `substitutes`.
    int substitute() const { return substitutes.empty() ? 0 : std::ranges::max(substitutes); }
};

/// Turns moments of a scene into meshes: reads, interpolates in time, extracts.
///
/// Use `extract` from one thread at a time, the extraction thread; the rest from any.
class SceneExtractor {
  public:
    struct Options {
        std::size_t memoryBytes = std::size_t{2} << 30;  ///< budget for key frames
        int threads = 0;                                 ///< for the inner loops; 0 takes all cores
        /// Leaves out what the picture does not show, but for this share of its width or height beyond each
        /// side, for the camera to move in. Without it all of every surface is there.
        std::optional<double> seenMargin = {};
        /// Gives meshes velocities, so that they can be shown at times that are not theirs.
        bool motion = false;
        /// Key frames that take longer than so many seconds to read are not waited for: a stored level that
        /// takes less is shown in their place, or the coarsest of use, until they are there. Without it, and
        /// where the budget does not hold a whole moment beside its levels, every moment is as the scene
        /// wants it.
        std::optional<double> patienceSeconds = {};
        /// Key frames came that may have been missed: the moment is worth another call. Runs on the reading
        /// thread; see KeyFrameCache.
        std::function<void()> arrived = {};
        /// How the series of a volume, or of a colour, is opened.
        std::function<std::shared_ptr<const SeriesFile>(const Volume&)> open = openSeries;
    };

    /// Opens every series of the scene and reads its meshes. Throws Error where one cannot be read, is not
    /// the grid that the scene names, or where the scene's times mean nothing to it.
    SceneExtractor(const Scene& scene, Options options);

    /// All surfaces at `position` (0 is the timeline's `from`, 1 its `to`), for a picture seen from
    /// `camera` of `imageSize` pixels. Key frames ahead in the `course` are read while this works.
    SceneMeshes extract(double position, const CameraPose& camera, glm::ivec2 imageSize, Course course = {});

    /// Moves the scene's planes (world coordinates) for the calls of `extract` that follow.
    void setClip(std::vector<ClipPlane> planes) { scene_.clip = std::move(planes); }

    /// One a volume, in the order of the scene.
    const std::vector<PlayedSeries>& series() const { return series_; }
    /// Of the volumes, then of the surfaces that are coloured by one.
    std::vector<std::shared_ptr<const SeriesFile>> files() const;
    /// What the user should know of the scene's meshes, a sentence each.
    const std::vector<std::string>& notes() const { return notes_; }
    const KeyFrameCache& cache() const { return *cache_; }

  private:
    /// A series that colours a surface.
    struct ColorSeries {
        std::size_t volume = 0;
        std::size_t surface = 0;
        PlayedSeries played;
    };

    /// What is known of one series at one moment, and where its samples are.
    struct Moment {
        TimedField field;
        Lattice lattice;
        int level = 0;  ///< the stored one that stands for the key frames
    };

    /// `series` numbers those of the volumes, then those that colour. Frames that are not needed are left
    /// out.
    /// No finer level than `finest` is taken, which must be stored unless it is 0.
    Moment momentAt(std::size_t series, const TimeSample& sample, bool first, bool second, int finest = 0);
    const PlayedSeries& played(std::size_t series) const;
    int levelNow(std::size_t series, const std::vector<std::size_t>& frames, int finest) const;
    std::vector<PlannedWork> planAt(std::size_t volume, const TimeSample& sample) const;
    std::vector<float> colorValues(const SurfaceMesh& mesh, const ExtractedSurface& place,
                                   const Moment& moment, const ExtractOptions& options, double position,
                                   int& substitute);
    std::vector<FrameKey> framesAhead(double position, Course course) const;
    std::vector<FrameKey> framesAt(double position) const;
    double keyPositionBeyond(double position, bool forwards) const;
    double shownPositionBeyond(double position, bool forwards) const;
    void addSamples(std::size_t volume, SceneMeshes& result);
    void addSurfaces(std::size_t volume, double position, View view, SceneMeshes& result);
    ExtractOptions optionsFor(const Volume& volume, const Surface& surface, const View& view) const;
    View viewOf(const Volume& volume, const CameraPose& camera, glm::ivec2 imageSize) const;

    Scene scene_;
    Options options_;
    std::vector<PlayedSeries> series_;
    std::vector<ColorSeries> colorSeries_;
    std::unique_ptr<KeyFrameCache> cache_;
    std::optional<std::size_t> sampled_;  ///< volume
    int finestSampled_ = 0;               ///< level
    DenseSamples denseSamples_;
    std::vector<std::shared_ptr<const SurfaceMesh>> objects_;
    std::vector<std::string> notes_;
};

}  // namespace isoglass
