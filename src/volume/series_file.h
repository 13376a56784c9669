#pragma once

#include "volume/frame_source.h"
#include "volume/key_frame.h"
#include "volume/series_description.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace isoglass {

/// A series in an OpenVDB file that IsoGlass wrote: one float grid a key frame and, where they are stored,
/// one for each of its coarser levels (pyramid.h); each has a second one with its heights where the lattice
/// has them.
///
/// Every member may be called from any thread; reads of key frames are serialised, and so are reads of
/// coarser levels, but neither waits for the other.
class SeriesFile {
  public:
    enum class Check {
        whole,
        /// For a file that was checked before and is still the same.
        description,
    };
    /// Reads the description, after the whole file was read once to check that it is undamaged: about a
    /// second a gigabyte. Throws Error where the file cannot be read, is no OpenVDB file, holds no
    /// IsoGlass series, or is damaged.
    explicit SeriesFile(const std::filesystem::path& path, Check check = Check::whole);

    /// Reads one level of a key frame; level 0 is the key frame itself.
    using ReadFrame = std::function<std::shared_ptr<const KeyFrame>(std::size_t frame, int level)>;
    /// A series whose key frames come from `read`, such as several files in a row (series_set.h). `read` may
    /// be called from any thread, several at a time, for the levels that the description lists. `name` stands
    /// for the path.
    SeriesFile(std::filesystem::path name, SeriesDescription description, ReadFrame read);
    ~SeriesFile();

    const SeriesDescription& description() const;
    const std::filesystem::path& path() const;

    /// Reads key frame `frame` and builds its brick table. Throws Error where the file is damaged: the
    /// checksum of the samples is compared with the one in the description.
    std::shared_ptr<const KeyFrame> read(std::size_t frame) const { return readLevel(frame, 0); }

    /// Reads one stored level of a key frame alone, from 1 to `description().frames[frame].levels.size()`:
    /// its samples are those of `coarseLattice` (pyramid.h), and the same as in the key frame's pyramid.
    /// Level 0 is the key frame. Throws Error as `read` does.
    std::shared_ptr<const KeyFrame> readLevel(std::size_t frame, int level) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// What an import may give up to make a series or its file smaller.
struct SparsityOptions {
    /// Bricks whose samples span at most twice this become one value; no sample moves by more.
    double tolerance = 0;
    /// Keep only what surfaces with iso-values in [min, max] need: bricks that are on one side of the
    /// interval, with their neighbours in space and time, become one value. Those surfaces and their
    /// normals stay as in the source.
    std::optional<ValueRange> keep = {};
    /// Store the coarser levels, too: about a fifth more, thin bands a third, and a slow disk can show
    /// something sooner.
    bool levels = true;
};

/// Called after each key frame with how many are done.
using ImportProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Writes the whole source to `out` as a sparse series and returns its description.
///
/// Constant regions become active tiles, missing samples are inactive. The file is written under
/// another name and renamed when it is whole, so a failure leaves nothing behind and an older file as
/// it was. The same source and options give the same bytes. Throws Error.
SeriesDescription writeSeries(FrameSource& source, const std::filesystem::path& out,
                              const SparsityOptions& options = {}, const ImportProgress& progress = {});

/// Builds a key frame in memory from dense samples (x fastest; NaN, infinity, beyond kLargestValue: missing)
/// for generated fields, with dense heights where `lattice` has them.
std::shared_ptr<const KeyFrame> makeKeyFrame(const Lattice& lattice, std::span<const float> samples,
                                             std::span<const float> heights = {});

}  // namespace isoglass
