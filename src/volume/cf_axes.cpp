#include "volume/cf_axes.h"

#include "base/error.h"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

namespace isoglass {

namespace {

enum class Role { x, y, z, time, unknown };

/// How far the closing step of a circle may be from the others, as a share of a step. Coordinates in
/// single precision are off by 2^-16 degree near 360, which is 4e-4 of a step of 1/25 degree.
constexpr double kClosingTolerance = 1e-3;

template <std::size_t count>
bool isOneOf(const std::string& text, const std::array<const char*, count>& words) {
    return std::ranges::find(words, text) != words.end();
}

std::string lowerCase(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

std::string lowerText(const NetcdfFile& file, const NetcdfVariable& variable, const char* attribute) {
    return lowerCase(file.text(variable, attribute).value_or(""));
}

bool isNumeric(const NetcdfVariable& variable) {
    return variable.type != NC_CHAR && variable.type >= NC_BYTE && variable.type <= NC_UINT64;
}

bool isDegreesEast(const std::string& lowerUnits) {
    return isOneOf(lowerUnits,
                   std::array{"degrees_east", "degree_east", "degrees_e", "degree_e", "degreese", "degreee"});
}

bool isDegreesNorth(const std::string& lowerUnits) {
    return isOneOf(lowerUnits, std::array{"degrees_north", "degree_north", "degrees_n", "degree_n",
                                          "degreesn", "degreen"});
}

Role roleByUnits(const std::string& units) {
    if (units.find(" since ") != std::string::npos) return Role::time;
    if (isDegreesEast(units)) return Role::x;
    if (isDegreesNorth(units)) return Role::y;
    if (isOneOf(units, std::array{"pa", "hpa", "kpa", "mb", "mbar", "millibar", "millibars", "bar", "dbar",
                                  "decibar", "atm", "level", "layer", "sigma_level"}))
        return Role::z;
    return Role::unknown;
}

Role roleByStandardName(const std::string& name) {
    if (name == "time") return Role::time;
    if (isOneOf(name, std::array{"longitude", "grid_longitude", "projection_x_coordinate"})) return Role::x;
    if (isOneOf(name, std::array{"latitude", "grid_latitude", "projection_y_coordinate"})) return Role::y;
    if (isOneOf(name, std::array{"height", "altitude", "depth", "air_pressure", "model_level_number"}) ||
        name.starts_with("atmosphere_") || name.starts_with("ocean_"))
        return Role::z;
    return Role::unknown;
}

Role roleByAttributes(const NetcdfFile& file, const NetcdfVariable& coordinate) {
    const std::string axis = lowerText(file, coordinate, "axis");
    if (axis == "x") return Role::x;
    if (axis == "y") return Role::y;
    if (axis == "z") return Role::z;
    if (axis == "t") return Role::time;
    const std::string positive = lowerText(file, coordinate, "positive");
    if (positive == "up" || positive == "down") return Role::z;
    const Role role = roleByUnits(lowerText(file, coordinate, "units"));
    if (role != Role::unknown) return role;
    return roleByStandardName(lowerText(file, coordinate, "standard_name"));
}

const NetcdfVariable* coordinatesOf(const NetcdfFile& file, const NetcdfVariable& variable, int dimension) {
    const auto fits = [&](const NetcdfVariable* candidate) {
        return candidate && isNumeric(*candidate) && candidate->dimensions == std::vector{dimension};
    };
    const NetcdfVariable* own = file.find(file.dimension(dimension).name);
    if (fits(own)) return own;
    std::istringstream names(file.text(variable, "coordinates").value_or(""));
    for (std::string name; names >> name;)
        if (const NetcdfVariable* auxiliary = file.find(name); fits(auxiliary)) return auxiliary;
    return nullptr;
}

Role roleOf(const NetcdfFile& file, int dimension, const NetcdfVariable* coordinate) {
    const Role role = coordinate ? roleByAttributes(file, *coordinate) : Role::unknown;
    if (role != Role::unknown) return role;
    const std::string name = lowerCase(file.dimension(dimension).name);
    return name == "time" || name == "t" ? Role::time : Role::unknown;
}

void requireMonotonic(const NetcdfFile& file, const NetcdfVariable& coordinate,
                      const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i]))
            throw Error("the coordinate at index " + std::to_string(i) + " is not finite",
                        file.place(coordinate));
        const bool breaks =
            i > 0 && (values[1] > values[0] ? !(values[i] > values[i - 1]) : !(values[i] < values[i - 1]));
        if (breaks)
            throw Error("coordinates must strictly increase or strictly decrease, but not so at index " +
                            std::to_string(i),
                        file.place(coordinate));
    }
}

std::optional<double> circleOf(const NetcdfFile& file, const NetcdfVariable& coordinate,
                               const std::vector<double>& values) {
    std::optional<double> circle = numericModulo(file, coordinate);
    if (!circle && isDegreesEast(lowerText(file, coordinate, "units"))) circle = 360;
    if (!circle) return std::nullopt;
    const double span = std::abs(values.back() - values.front());
    const double step = span / static_cast<double>(values.size() - 1);
    if (std::abs(*circle - span - step) > kClosingTolerance * step) return std::nullopt;
    return circle;
}

std::string formatted(double value) {
    std::ostringstream text;
    text.precision(12);
    text << value;
    return text.str();
}

/// Step of WRF's projected grid along a dimension, in metres; nothing for other dimensions and files.
std::optional<double> projectedStep(const NetcdfFile& file, const std::string& dimension) {
    const char* attribute = dimension == "west_east" ? "DX" : dimension == "south_north" ? "DY" : nullptr;
    if (!attribute) return std::nullopt;
    const std::vector<double> step = file.globalNumbers(attribute);
    if (step.size() != 1 || !std::isfinite(step[0]) || !(step[0] > 0)) return std::nullopt;
    return step[0];
}

Axis countedAxis(const NetcdfFile& file, const CentredDimension& dimension, std::vector<std::string>& notes) {
    const std::optional<double> step = projectedStep(file, dimension.name);
    Axis axis;
    axis.name = dimension.name;
    if (step) axis.units = "m";
    for (std::size_t i = 0; i < dimension.length; ++i)
        axis.coordinates.push_back(static_cast<double>(i) * step.value_or(1));
    const std::string missing = "Axis " + axis.name + " has no coordinates in the source: they are ";
    if (step) {
        notes.push_back(missing + "metres on the model's map projection, " + formatted(*step) +
                        " a step, from the first sample.");
    } else {
        notes.push_back(missing + "the sample numbers 0 to " + std::to_string(dimension.length - 1) + ".");
    }
    return axis;
}

/// From the faces to the centres between them.
void centre(std::vector<double>& coordinates) {
    for (std::size_t i = 0; i + 1 < coordinates.size(); ++i)
        coordinates[i] = 0.5 * (coordinates[i] + coordinates[i + 1]);
    coordinates.pop_back();
}

}  // namespace

std::optional<double> numericModulo(const NetcdfFile& file, const NetcdfVariable& variable) {
    double value = 0;
    if (const std::vector<double> numbers = file.numbers(variable, "modulo"); !numbers.empty()) {
        value = numbers[0];
    } else {
        const std::string text = file.text(variable, "modulo").value_or("");
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    }
    return std::isfinite(value) && value > 0 ? std::optional(value) : std::nullopt;
}

std::optional<GridShape> findShape(const NetcdfFile& file, const NetcdfVariable& variable) {
    if (!isNumeric(variable)) return std::nullopt;
    constexpr std::size_t kFree = ~std::size_t{0};
    std::array<std::size_t, 4> taken{kFree, kFree, kFree, kFree};
    GridShape shape{};
    std::vector<std::size_t> unlabelled;

    for (std::size_t position = 0; position < variable.dimensions.size(); ++position) {
        const int dimension = variable.dimensions[position];
        shape.coordinates.push_back(coordinatesOf(file, variable, dimension));
        shape.dimensions.push_back(centredDimension(file, variable, position));
        const NetcdfVariable* coordinate = shape.coordinates.back();
        const Role role = roleOf(file, dimension, coordinate);
        if (shape.dimensions.back().length == 1 && role != Role::time) continue;
        if (role == Role::unknown)
            unlabelled.push_back(position);
        else if (taken[static_cast<std::size_t>(role)] == kFree)
            taken[static_cast<std::size_t>(role)] = position;
        else
            return std::nullopt;
    }
    for (; !unlabelled.empty(); unlabelled.pop_back()) {
        const auto free = std::ranges::find(taken, kFree);
        if (free == taken.end()) return std::nullopt;
        *free = unlabelled.back();
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (taken[axis] == kFree || shape.dimensions[taken[axis]].length < 2) return std::nullopt;
        shape.axes[axis] = taken[axis];
    }
    if (taken[3] != kFree) shape.time = taken[3];
    return shape;
}

Axis readAxis(const NetcdfFile& file, const GridShape& shape, std::size_t position,
              std::vector<std::string>& notes) {
    const CentredDimension& dimension = shape.dimensions[position];
    const NetcdfVariable* coordinate = shape.coordinates[position];
    if (!coordinate) return countedAxis(file, dimension, notes);
    Axis axis;
    axis.name = dimension.staggered ? dimension.name : coordinate->name;
    axis.units = file.text(*coordinate, "units").value_or("");
    axis.coordinates = file.values(*coordinate);
    requireMonotonic(file, *coordinate, axis.coordinates);
    if (dimension.staggered) centre(axis.coordinates);
    axis.period = circleOf(file, *coordinate, axis.coordinates);
    if (axis.period)
        notes.push_back("Axis " + axis.name + " is a whole circle: it repeats after " +
                        formatted(*axis.period) + (axis.units.empty() ? "" : " " + axis.units) + ".");
    if (lowerText(file, *coordinate, "positive") == "down") {
        axis.negated = true;
        for (double& value : axis.coordinates) value = 0.0 - value;  // never -0
        notes.push_back("Axis " + axis.name + " points down in the source: its coordinates are negated.");
    } else if (axis.descending())
        notes.push_back("Axis " + axis.name + " descends and is kept so.");
    return axis;
}

}  // namespace isoglass
