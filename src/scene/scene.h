#pragma once

#include "scene/clip_solid.h"
#include "scene/field_color.h"
#include "scene/illustrative_style.h"
#include "scene/layer_style.h"
#include "scene/shell_opacity.h"
#include "scene/volume_style.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace isoglass {

/// Linear-light colour with components from 0 to 1; the scene file writes sRGB hex.
using LinearColor = glm::vec3;

/// Which side of an iso-surface is inside. The normal points outside.
enum class Inside { above, below };

/// How semi-transparent surfaces are composed (S. Roettger, "Volume rendering with libMini", 2007, section
/// 4).
enum class TransparencyMethod {
    automatic,  ///< exact where the quality asks for it, 2-pass where nothing can overlap, otherwise 4-pass
    twoPass,    ///< blended in the order of the scene: right where no ray meets two of them
    threePass,  ///< every surface dims what is opaque and adds its light
    fourPass,   ///< the same, with no light from beyond the nearest back face
    peel,       ///< in depth order, the nearest layers alone
    exact,      ///< in depth order, all of them
};

inline constexpr int kMostLayers = 256;  ///< of the method peel
inline constexpr int kMostSamples = 64;  ///< of a pixel

struct Transparency {
    TransparencyMethod method = TransparencyMethod::automatic;
    int layers = 4;  ///< nearest ones that the method peel shows
    /// The same bits on one driver for any order of volumes, surfaces and triangles: sums in integers.
    bool reproducible = false;

    friend bool operator==(const Transparency&, const Transparency&) = default;
};

/// One iso-surface of a volume.
struct Surface {
    double iso = 0;  ///< in the units of the samples
    Inside inside = Inside::above;
    LinearColor color{0.799102724f};  ///< #e7e7e7
    float opacity = 1;                ///< 1 is opaque: drawn in the opaque pass
    /// Opacity by the angle of view takes the place of the constant one; never opaque.
    std::optional<ShellOpacity> shell{};
    /// Colour by a value at each point takes the place of `color`.
    std::optional<FieldColor> fieldColor{};
    bool secondary = false;  ///< in the style "illustrative": see IllustrativeStyle

    bool opaque() const { return opacity >= 1 && !shell; }

    friend bool operator==(const Surface&, const Surface&) = default;
};

/// Placement of a volume: scale first, then rotate, then translate. World units.
struct Placement {
    glm::dvec3 translate{0};
    glm::dvec4 rotate{0, 0, 1, 0};  ///< axis x, y, z and angle in degrees
    glm::dvec3 scale{1};            ///< no component is 0; an odd number of negative ones mirrors

    friend bool operator==(const Placement&, const Placement&) = default;
};

/// Maps scene time to the time of a volume: volume seconds = offset + scale * scene seconds.
struct ClockMap {
    double offset = 0;  ///< seconds
    double scale = 1;

    friend bool operator==(const ClockMap&, const ClockMap&) = default;
};

/// A plane that cuts surfaces: where a x + b y + c z + d >= 0 is kept.
struct ClipPlane {
    glm::dvec4 plane{0, 0, 1, 0};  ///< a, b, c, d; the normal is not zero
    bool cap = true;               ///< fill what is inside on the cut

    friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// A solid that clips volumes which rays go through; what several solids and planes keep is what each of them
/// keeps.
struct ClipSolid {
    SolidShape shape = SolidShape::box;
    Keep keep = Keep::inside;
    Placement place{};

    friend bool operator==(const ClipSolid&, const ClipSolid&) = default;
};

struct Volume {
    std::string name;
    /// Absolute, or relative to the working directory. The name of the file may be a pattern with * and ?.
    std::filesystem::path series;
    std::vector<std::filesystem::path> moreSeries;  ///< more files or patterns: one series in all
    std::string grid;                               ///< name that the series must have; empty takes any
    Placement place;
    ClockMap time;
    std::vector<ClipPlane> clip{};    ///< in series coordinates
    std::vector<ClipSolid> solids{};  ///< likewise
    bool closed = false;              ///< what is inside is capped where the domain ends
    std::vector<Surface> surfaces;    ///< at least one, but for a volume of the style "volume"

    friend bool operator==(const Volume&, const Volume&) = default;
};

/// A mesh from a file, which does not change with time. Clip planes leave it whole.
struct MeshObject {
    std::string name;
    std::filesystem::path file;  ///< .ply, .obj, .stl or .off; as for Volume::series
    Placement place{};
    LinearColor color{0.799102724f};  ///< #e7e7e7
    float opacity = 1;
    bool secondary = false;  ///< as for Surface

    friend bool operator==(const MeshObject&, const MeshObject&) = default;
};

/// A moment of the scene: seconds on the clock of the series, or a date that every series translates by
/// its own reference date and calendar.
using SceneTime = std::variant<double, std::string>;

/// What part of the series is played, and how long that takes.
struct Timeline {
    SceneTime from = 0.0;
    SceneTime to = 0.0;
    double duration = 0;  ///< seconds of playback; 0 is a still
    double fps = 25;

    /// Displayed frames of the whole playback: `duration * fps` to the nearest, at least 1.
    std::int64_t frameCount() const;
    /// Where frame `frame` lies between `from` (0) and `to` (1): frames are evenly spaced and the last one
    /// is one step before `to`, so that a cyclic series loops without showing a moment twice.
    double position(std::int64_t frame) const;

    friend bool operator==(const Timeline&, const Timeline&) = default;
};

struct CameraPose {
    glm::dvec3 eye{3, 2, 2.5};
    glm::dvec3 target{0};

    friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// A pose that the camera passes `at` seconds of playback.
struct CameraKey {
    double at = 0;
    CameraPose pose;

    friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

struct Camera {
    CameraPose pose;  ///< used where `path` is empty
    glm::dvec3 up{0, 0, 1};
    double fovDegrees = 30;       ///< vertical
    std::vector<CameraKey> path;  ///< by increasing `at`; smooth through the keys, still outside them

    /// The pose at a moment of playback.
    ///
    /// The target moves straight in each coordinate; the eye orbits it: azimuth about `up` (the shorter
    /// way round from key to key), elevation and logarithm of the distance are interpolated, each by
    /// the monotone piecewise cubic of Fritsch and Butland (1984). So equal distances stay a circle,
    /// nothing overshoots a key, and where no key looks along `up` no pose between the keys does.
    CameraPose poseAt(double playbackSeconds) const;

    friend bool operator==(const Camera&, const Camera&) = default;
};

struct ImageSettings {
    glm::ivec2 size{1280, 720};
    LinearColor background{0.00518151652f, 0.00699541019f, 0.00913405884f};  ///< #101418
    float exposure = 1;           ///< linear factor before the sRGB curve
    int samples = 1;              ///< a pixel, 1 to kMostSamples, averaged in linear light
    float backgroundOpacity = 1;  ///< below 1 pictures have alpha
    bool legend = true;           ///< draws colour bars for colours by a value

    friend bool operator==(const ImageSettings&, const ImageSettings&) = default;
};

/// Weights of the light that a surface sends to the eye (Blinn and Phong); the light is at the eye.
struct Lighting {
    float ambient = 0.25f;
    float diffuse = 0.7f;
    float specular = 0.15f;
    float shininess = 40;

    friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// Accuracy and speed that the user wants; at most one of `pixels` and `errorPixels`. Without either surfaces
/// have full resolution, which satisfies any accuracy.
struct Quality {
    std::optional<double> pixels;             ///< size of a cell on the screen
    std::optional<double> errorPixels;        ///< displacement of the surface on the screen
    std::optional<double> frameMilliseconds;  ///< time a displayed frame may take
    bool exactOrder = false;                  ///< transparency that is left to `auto` is exact

    /// Whether meshes depend on the view.
    bool wantsDetail() const { return pixels || errorPixels; }

    friend bool operator==(const Quality&, const Quality&) = default;
};

/// What the user describes: scene file, version 1.
struct Scene {
    std::vector<Volume> volumes;  ///< at least one, or a mesh
    std::vector<MeshObject> meshes{};
    Timeline time;
    Camera camera;
    ImageSettings image;
    Lighting lighting;
    Quality quality;
    Transparency transparency;
    std::optional<LayerStyle> layers{};               ///< the style "layers": its volume exists
    std::optional<IllustrativeStyle> illustrative{};  ///< that style; never two of the three
    std::optional<VolumeStyle> shaded{};              ///< the style "volume": its volume exists
    std::vector<ClipPlane> clip;                      ///< of all volumes, in world coordinates
    std::vector<ClipSolid> solids{};                  ///< likewise; kMostSolids a volume with its own
    /// Keys that were understood but change nothing in this version, a sentence each.
    std::vector<std::string> notes;

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// Series coordinates to world, double precision.
glm::dmat4 worldFromSeries(const Placement& place);

/// Colours every surface by the level of detail of its cells, from 0 to 4, to look at the mesh.
void colorByLevel(Scene& scene);

}  // namespace isoglass
