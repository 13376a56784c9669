#pragma once

#include "scene/scene.h"
#include "volume/series_file.h"

#include <memory>

namespace isoglass {

/// What is known of a volume's series and of the time that it plays.
struct PlayedSeries {
    std::shared_ptr<const SeriesFile> file;
    double from = 0;  ///< in the series' own units
    double to = 0;

    double timeAt(double position) const { return from + position * (to - from); }
};

/// Opens the volume's series. Throws Error where it cannot be read or is damaged.
std::shared_ptr<const SeriesFile> openSeries(const Volume& volume);

/// Throws Error where the series is not the grid that the volume asks for.
void checkGrid(const Volume& volume, const SeriesDescription& series);

/// What of an open series the timeline plays. Throws Error where the scene's times mean nothing to it.
PlayedSeries playSeries(const Volume& volume, const Timeline& timeline,
                        std::shared_ptr<const SeriesFile> file);

/// The nearest position beyond `position` (by 1e-9 at least) at which the series has a key frame: after it,
/// or before it where not `forwards`. The end of the timeline, 1 or 0, where none comes before that.
double keyPositionBeyond(const PlayedSeries& played, double position, bool forwards);

}  // namespace isoglass
