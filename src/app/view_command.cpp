#include "app/commands.h"
#include "app/view/viewer.h"
#include "base/error.h"

#include <algorithm>
#include <string>

namespace isoglass {

namespace {

constexpr int kLargestSide = 16384;
/// Longer than this a picture does not seem to follow at once.
constexpr double kPatienceSeconds = 0.1;

void check(glm::ivec2 size) {
    if (std::min(size.x, size.y) >= 1 && std::max(size.x, size.y) <= kLargestSide) return;
    throw Error("a window has 1 to " + std::to_string(kLargestSide) + " pixels a side", "--size");
}

}  // namespace

void runView(const ViewCommand& command, const CommonOptions& common) {
    const OpenOptions options{.scene = {.memoryBytes = common.memoryBytes,
                                        .threads = common.threads,
                                        .patienceSeconds = kPatienceSeconds,
                                        .arrived = [] { gl::Window::wake(); }},
                              .showLevels = command.showLevels};
    const glm::ivec2 firstSize = command.size.value_or(ImageSettings().size);
    check(firstSize);
    // Without a display there is no use in opening anything.
    gl::Window window("IsoGlass", firstSize);
    Opened opened = openForViewing(command.file, firstSize, options);
    if (!command.size) window.resize(opened.scene.image.size);
    Viewer viewer(window, std::move(opened), options);
    window.show();
    viewer.run();
}

}  // namespace isoglass
