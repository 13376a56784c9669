#include "volume/wrf_times.h"

#include "base/error.h"
#include "volume/calendar.h"

#include <netcdf.h>

#include <algorithm>
#include <cstdint>

namespace isoglass {

namespace {

/// Milliseconds since 0000-01-01.
std::int64_t millisecondsOf(std::string text) {
    constexpr std::int64_t kMillisecondsPerDay = 86'400'000;
    std::ranges::replace(text, '_', 'T');
    const Date date = parseDate(text);
    return dayNumber(date, Calendar::standard) * kMillisecondsPerDay + date.millisecondOfDay;
}

}  // namespace

std::optional<TimeAxis> readWrfTimes(const NetcdfFile& file, int timeDimension,
                                     std::vector<std::string>& notes) {
    const NetcdfVariable* variable = file.find("Times");
    if (!variable || variable->type != NC_CHAR || variable->dimensions.size() != 2 ||
        variable->dimensions[0] != timeDimension)
        return std::nullopt;
    const std::vector<std::string> rows = file.rows(*variable);
    TimeAxis axis;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        try {
            const std::int64_t since = millisecondsOf(rows[i]) - millisecondsOf(rows.front());
            axis.times.push_back(static_cast<double>(since) / 60'000);
        } catch (const Error& error) {
            notes.push_back("Times[" + std::to_string(i) + "] is not understood as a date: " + error.what() +
                            ". The dates are left out.");
            return std::nullopt;
        }
    }
    if (rows.empty()) return std::nullopt;
    std::string first = rows.front();
    std::ranges::replace(first, '_', ' ');
    axis.units = "minutes since " + first;
    axis.calendar = "standard";
    notes.push_back("Times are the dates of the variable Times.");
    return axis;
}

}  // namespace isoglass
