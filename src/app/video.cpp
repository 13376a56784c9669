#include "app/video.h"

#include "base/error.h"

#include <fstream>
#include <sstream>

namespace isoglass {

namespace {

/// A fixed number, because x264's output depends on it.
constexpr const char* kEncoderThreads = "2";

std::vector<std::string> encoderArguments(const std::string& file, glm::ivec2 size, double fps) {
    std::ostringstream rate;
    rate.precision(17);
    rate << fps;
    // H.264 with halved chroma wants even sides: an odd side gets one more line.
    return {"-f",
            "rawvideo",
            "-pixel_format",
            "rgba",
            "-video_size",
            std::to_string(size.x) + "x" + std::to_string(size.y),
            "-framerate",
            rate.str(),
            "-i",
            "pipe:0",
            "-vf",
            "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
            "-c:v",
            "libx264",
            "-preset",
            "medium",
            "-crf",
            "18",
            "-threads",
            kEncoderThreads,
            "-pix_fmt",
            "yuv420p",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "iec61966-2-1",
            "-movflags",
            "+faststart",
            "-fflags",
            "+bitexact",
            "-flags:v",
            "+bitexact",
            "-f",
            "mp4",
            file};
}

}  // namespace

VideoWriter::VideoWriter(const std::filesystem::path& file, glm::ivec2 size, double fps,
                         const std::filesystem::path& named)
    : target_(file),
      ffmpeg_(encoderArguments(target_.temporaryPath().string(), size, fps), named, target_.temporaryPath()) {
}

void VideoWriter::add(const Image& image) {
    ffmpeg_.write(image.pixels.data(), image.pixels.size() * sizeof(Rgba8));
}

void VideoWriter::finish() {
    ffmpeg_.finish();
    target_.commit();
}

void joinVideos(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& names,
                const std::filesystem::path& out) {
    AtomicFile list(folder / "list.txt");
    std::ofstream text(list.temporaryPath());
    // Names without a folder are looked for beside the list.
    for (const auto& name : names) text << "file '" << name.string() << "'\n";
    text.close();
    if (!text) throw Error("cannot write", out.string(), "free some space, or choose another place");
    AtomicFile whole(out);
    Ffmpeg ffmpeg({"-f", "concat", "-i", list.temporaryPath().string(), "-c", "copy", "-movflags",
                   "+faststart", "-fflags", "+bitexact", "-f", "mp4", whole.temporaryPath().string()},
                  out, whole.temporaryPath());
    ffmpeg.finish();
    whole.commit();
}

}  // namespace isoglass
