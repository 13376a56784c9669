#include "formats/file_source.h"

#include "base/error.h"
#include "volume/import_times.h"

#include <algorithm>

namespace isoglass {

namespace {

bool sameAxes(const Lattice& a, const Lattice& b) {
    return std::ranges::equal(a.axes, b.axes, [](const Axis& left, const Axis& right) {
        return left.coordinates == right.coordinates && left.period == right.period;
    });
}

class SequenceSource final : public FrameSource {
  public:
    SequenceSource(std::span<const std::filesystem::path> files, OpenFile open, const ImportOptions& options,
                   const std::string& format, const std::vector<double>& times)
        : files_(files.begin(), files.end()), open_(std::move(open)), variable_(options.variable) {
        if (files_.empty()) throw Error("no files", format);
        bool timesKnown = true;
        std::vector<double> ownTimes;
        for (std::size_t i = 0; i < files_.size(); ++i) {
            const FileSource& source = opened(i);
            const SeriesDescription& found = source.description();
            if (i == 0) description_ = found;
            requireSame(found, files_[i]);
            timesKnown = timesKnown && source.knowsTimes();
            for (std::size_t step = 0; step < found.time.times.size(); ++step) steps_.push_back({i, step});
            ownTimes.insert(ownTimes.end(), found.time.times.begin(), found.time.times.end());
        }
        setTimes(options.times, times, timesKnown ? ownTimes : std::vector<double>{});
        if (files_.size() > 1)
            description_.provenance = files_.front().filename().string() + " to " +
                                      files_.back().filename().string() + ", " + format + ", " +
                                      std::to_string(files_.size()) + " files";
    }

    const SeriesDescription& description() const override { return description_; }

    void read(std::size_t frame, std::span<float> samples) override {
        const Step step = steps_.at(frame);
        FileSource& source = opened(step.file);
        requireSame(source.description(), files_[step.file]);
        source.read(step.frame, samples);
    }

  private:
    /// Key frame of the sequence: which one of which file.
    struct Step {
        std::size_t file;
        std::size_t frame;
    };

    FileSource& opened(std::size_t file) {
        if (!source_ || openFile_ != file) {
            source_.reset();
            source_ = open_(files_[file], variable_);
            openFile_ = file;
        }
        return *source_;
    }

    void requireSame(const SeriesDescription& found, const std::filesystem::path& file) const {
        const std::string hint = "all files of a sequence must agree";
        if (found.lattice.dims() != description_.lattice.dims())
            throw Error("dimensions differ from those of the first file", file.string(), hint);
        if (!sameAxes(found.lattice, description_.lattice))
            throw Error("the places of the samples differ from those of the first file", file.string(), hint);
        if (found.units != description_.units)
            throw Error("the units differ from those of the first file", file.string(), hint);
    }

    void setTimes(const std::vector<double>& given, const std::vector<double>& indexed,
                  const std::vector<double>& own) {
        std::vector<double>& times = description_.time.times;
        if (!given.empty()) {
            times = given;
            requireTimes(times, steps_.size(), "--times");
        } else if (!indexed.empty()) {
            times = indexed;
            requireTimes(times, steps_.size(), "times of the index file");
        } else if (!own.empty()) {
            times = own;
            requireTimes(times, steps_.size(), "times in the files");
        } else {
            times.clear();
            for (std::size_t i = 0; i < steps_.size(); ++i) times.push_back(static_cast<double>(i));
        }
    }

    std::vector<std::filesystem::path> files_;
    OpenFile open_;
    std::string variable_;
    std::vector<Step> steps_;
    SeriesDescription description_;
    std::unique_ptr<FileSource> source_;  ///< the file that was asked for last
    std::size_t openFile_ = 0;
};

}  // namespace

std::uint64_t requireVolume(std::span<const std::uint64_t> dims, const std::string& place) {
    std::uint64_t samples = 1;
    for (const std::uint64_t length : dims) {
        if (length < 2 || length > kLongestAxis)
            throw Error("an axis of " + std::to_string(length) + " samples: 2 to 2^20 are possible", place,
                        "a volume has three axes longer than one sample");
        if (length > kMostSamples / samples)
            throw Error("the volume is too large: more than 2^34 samples", place);
        samples *= length;
    }
    return samples;
}

void refuseVariable(const std::string& variable, const std::string& format) {
    if (!variable.empty())
        throw Error(format + " files have no variables", "--variable " + variable, "leave it out");
}

std::unique_ptr<FrameSource> openSequence(std::span<const std::filesystem::path> files, const OpenFile& open,
                                          const ImportOptions& options, const std::string& format,
                                          const std::vector<double>& times) {
    return std::make_unique<SequenceSource>(files, open, options, format, times);
}

}  // namespace isoglass
