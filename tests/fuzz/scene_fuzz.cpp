#include "base/error.h"
#include "fuzz/fuzz.h"
#include "scene/scene_file.h"

#include <cmath>

namespace isoglass::fuzz {

// A text is refused with an Error, or it is a scene: one that survives its own text, and whose camera and
// clock give finite numbers.
void run(std::span<const std::uint8_t> data) {
    Scene scene;
    try {
        scene = parseScene(asText(data), "/folder", "fuzz");
    } catch (const Error&) {
        return;
    }
    Scene again = parseScene(toJson(scene, "/folder"), "/folder", "fuzz");
    // Notes are about the text and not about the scene.
    scene.notes.clear();
    again.notes.clear();
    require(again == scene, "a scene survives being written and read");

    for (const double moment : {-1.0, 0.0, 0.5 * scene.time.duration, scene.time.duration, 1e9}) {
        const CameraPose pose = scene.camera.poseAt(moment);
        for (int k = 0; k < 3; ++k)
            require(std::isfinite(pose.eye[k]) && std::isfinite(pose.target[k]), "a camera pose is finite");
        require(pose.eye != pose.target, "a camera looks somewhere");
    }
    require(scene.time.frameCount() >= 1, "there is a frame to show");
    for (const Volume& volume : scene.volumes) {
        const glm::dmat4 place = worldFromSeries(volume.place);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                require(std::isfinite(place[column][row]), "a placement is finite");
    }
}

}  // namespace isoglass::fuzz
