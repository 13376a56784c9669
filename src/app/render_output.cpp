#include "app/render_output.h"

#include "app/text.h"
#include "app/video_sink.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "render/png_file.h"

#include <iomanip>
#include <set>
#include <sstream>

namespace isoglass {

namespace {

constexpr std::string_view kFrameMark = "{frame}";

bool hasMark(const std::string& name) {
    return name.find(kFrameMark) != std::string::npos;
}

std::string withMark(std::string name, const std::string& text) {
    return name.replace(name.find(kFrameMark), kFrameMark.size(), text);
}

class StillSink final : public FrameSink {
  public:
    explicit StillSink(std::filesystem::path file) : file_(std::move(file)) {}
    void add(std::int64_t, const Image& image) override { writePng(file_, image); }

  private:
    std::filesystem::path file_;
};

/// Frames stay as they are finished, and a journal beside them until all are there. It bears the range in
/// its name: the parts of a sequence may be rendered by several programs at once.
class SequenceSink final : public FrameSink {
  public:
    SequenceSink(RenderOutput output, FrameRange range, std::uint64_t identity)
        : output_(std::move(output)), range_(range), journal_(journalPath(output_.name, range), identity) {
        noteForeign(journal_);
        for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
            if (journal_.holds(frame, output_.fileOf(frame))) whole_.insert(frame);
        }
        if (!whole_.empty()) noteKept(count(), range_);
    }

    bool has(std::int64_t frame) const override { return whole_.contains(frame); }

    void add(std::int64_t frame, const Image& image) override {
        writePng(output_.fileOf(frame), image);
        journal_.add(frame, output_.fileOf(frame));
        whole_.insert(frame);
    }

    void finish() override { journal_.finish(); }

    std::string kept() const override { return keptText(count(), range_); }

  private:
    static std::filesystem::path journalPath(const std::string& pattern, FrameRange range) {
        return std::filesystem::path(withMark(pattern, rangeText(range))).replace_extension(".unfinished");
    }

    std::int64_t count() const { return static_cast<std::int64_t>(whole_.size()); }

    RenderOutput output_;
    FrameRange range_;
    RenderJournal journal_;
    std::set<std::int64_t> whole_;
};

}  // namespace

RenderOutput RenderOutput::fromName(const std::string& name) {
    const std::filesystem::path path(name);
    RenderOutput output{Kind::still, name};
    if (path.extension() == ".mp4") {
        output.kind = Kind::video;
    } else if (path.extension() != ".png") {
        throw Error("cannot tell what to write", name,
                    "end the name in .png (with {frame} for a sequence) or .mp4");
    } else if (hasMark(name)) {
        output.kind = Kind::sequence;
        if (!hasMark(path.filename().string())) {
            throw Error("{frame} stands in the name of a folder", name, "put it into the name of the file");
        }
    }
    const std::filesystem::path first = output.fileOf(0);
    if (!isSpecialFile(first)) checkPlace(first);
    return output;
}

std::filesystem::path RenderOutput::fileOf(std::int64_t frame) const {
    if (kind != Kind::sequence) return name;
    std::ostringstream digits;
    digits << std::setw(5) << std::setfill('0') << frame;
    return withMark(name, digits.str());
}

std::string rangeText(FrameRange range) {
    return std::to_string(range.first) + "-" + std::to_string(range.last);
}

std::string keptText(std::int64_t frames, FrameRange range) {
    if (frames == 0) return {};
    return std::to_string(frames) + " of " + std::to_string(range.last - range.first + 1) +
           " frames are there; the same command goes on from them";
}

void noteKept(std::int64_t frames, FrameRange range) {
    printNote(std::to_string(frames) + " of " + std::to_string(range.last - range.first + 1) +
              " frames from an earlier run are kept");
}

void noteForeign(const RenderJournal& journal) {
    if (!journal.isForeign()) return;
    printNote(
        "an earlier run was stopped, but its scene, series, program or driver was another one: every "
        "frame is rendered");
}

std::unique_ptr<FrameSink> makeSink(const RenderOutput& output, const Scene& scene, FrameRange range,
                                    const std::function<std::uint64_t()>& identity) {
    switch (output.kind) {
        case RenderOutput::Kind::sequence:
            return std::make_unique<SequenceSink>(output, range, identity());
        case RenderOutput::Kind::video:
            return makeVideoSink(output, scene, range, identity());
        case RenderOutput::Kind::still:
            break;
    }
    return std::make_unique<StillSink>(output.name);
}

}  // namespace isoglass
