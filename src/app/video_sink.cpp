#include "app/video_sink.h"

#include "app/render_journal.h"
#include "app/text.h"
#include "app/video.h"
#include "base/error.h"
#include "base/signal_cleanup.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace isoglass {

namespace {

/// Whole microseconds at 24, 25, 30, 50, 60 and 30000/1001 frames a second: where segments are put
/// together their lengths are counted in those, and nothing is rounded.
constexpr std::int64_t kSegmentFrames = 120;

/// A folder that goes where nothing is in it at the end.
class FolderWhileUsed {
  public:
    explicit FolderWhileUsed(std::filesystem::path path) : path_(std::move(path)), noted_(path_) {
        std::error_code failure;
        std::filesystem::create_directory(path_, failure);
        if (failure) throw Error("cannot make a folder: " + failure.message(), path_.string());
    }
    ~FolderWhileUsed() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);  // not where it holds anything
    }
    FolderWhileUsed(const FolderWhileUsed&) = delete;
    FolderWhileUsed& operator=(const FolderWhileUsed&) = delete;

    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    NotedFile noted_;
};

class VideoSink final : public FrameSink {
  public:
    VideoSink(const RenderOutput& output, const Scene& scene, FrameRange range, std::uint64_t identity)
        : file_(output.name),
          size_(scene.image.size),
          fps_(scene.time.fps),
          range_(range),
          folder_(folderPath(file_, range)),
          journal_(folder_ / "journal", identity),
          whole_(static_cast<std::size_t>(segmentOf(range.last)) + 1) {
        noteForeign(journal_);
        for (std::size_t i = 0; i < whole_.size(); ++i)
            whole_[i] = journal_.holds(static_cast<std::int64_t>(i), folder_ / nameOf(i));
        if (wholeFrames() > 0) noteKept(wholeFrames(), range_);
    }

    bool has(std::int64_t frame) const override { return whole_[segmentOf(frame)]; }

    void add(std::int64_t frame, const Image& image) override {
        const std::size_t segment = segmentOf(frame);
        if (!writer_) writer_.emplace(folder_ / nameOf(segment), size_, fps_, file_);
        writer_->add(image);
        if (frame != lastOf(segment)) return;
        writer_->finish();
        writer_.reset();
        journal_.add(static_cast<std::int64_t>(segment), folder_ / nameOf(segment));
        whole_[segment] = true;
    }

    void finish() override {
        std::vector<std::filesystem::path> names;
        for (std::size_t i = 0; i < whole_.size(); ++i) names.push_back(nameOf(i));
        joinVideos(folder_.path(), names, file_);
        for (const auto& name : names) std::filesystem::remove(folder_ / name);
        journal_.finish();
    }

    std::string kept() const override { return keptText(wholeFrames(), range_); }

  private:
    static std::filesystem::path folderPath(const std::filesystem::path& file, FrameRange range) {
        std::filesystem::path folder = file;
        return folder.replace_extension("." + rangeText(range) + ".unfinished");
    }

    static std::filesystem::path nameOf(std::size_t segment) {
        return "segment-" + std::to_string(segment) + ".mp4";
    }

    std::size_t segmentOf(std::int64_t frame) const {
        return static_cast<std::size_t>((frame - range_.first) / kSegmentFrames);
    }

    std::int64_t lastOf(std::size_t segment) const {
        return std::min(range_.last,
                        range_.first + (static_cast<std::int64_t>(segment) + 1) * kSegmentFrames - 1);
    }

    std::int64_t wholeFrames() const {
        std::int64_t count = 0;
        for (std::int64_t frame = range_.first; frame <= range_.last; ++frame) count += has(frame) ? 1 : 0;
        return count;
    }

    std::filesystem::path file_;
    glm::ivec2 size_;
    double fps_;
    FrameRange range_;
    FolderWhileUsed folder_;
    RenderJournal journal_;
    std::vector<bool> whole_;  ///< one a segment
    std::optional<VideoWriter> writer_;
};

}  // namespace

std::unique_ptr<FrameSink> makeVideoSink(const RenderOutput& output, const Scene& scene, FrameRange range,
                                         std::uint64_t identity) {
    return std::make_unique<VideoSink>(output, scene, range, identity);
}

}  // namespace isoglass
