#include "volume/heights.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isoglass {

namespace {

std::string text(double value) {
    std::ostringstream out;
    out.precision(9);  // enough to tell any two floats apart
    out << value;
    return out.str();
}

}  // namespace

std::vector<double> meanHeights(glm::ivec3 dims, std::span<const float> heights, const std::string& name) {
    const std::size_t level = static_cast<std::size_t>(dims.x) * dims.y;
    double sum = 0;
    std::size_t count = 0;
    for (const float height : heights.first(level)) {
        if (std::isnan(height)) continue;
        sum += height;
        ++count;
    }
    std::vector<double> means = {count > 0 ? sum / static_cast<double>(count) : 0.0};
    for (int k = 0; k + 1 < dims.z; ++k) {
        double steps = 0;
        count = 0;
        for (std::size_t i = 0; i < level; ++i) {
            const double step = static_cast<double>(heights[(k + 1) * level + i]) - heights[k * level + i];
            if (std::isnan(step)) continue;
            steps += step;
            ++count;
        }
        const std::string place =
            "heights " + name + ", levels " + std::to_string(k) + " and " + std::to_string(k + 1);
        if (count == 0) throw Error("no column has a height at two successive levels", place);
        means.push_back(means.back() + steps / static_cast<double>(count));
        const bool ordered = means[1] > means[0] ? means[k + 1] > means[k] : means[k + 1] < means[k];
        if (!ordered)
            throw Error(
                "heights must strictly increase or strictly decrease along every column, but their means "
                "are " +
                    text(means[k]) + ", then " + text(means[k + 1]),
                place);
    }
    return means;
}

HeightCheck::HeightCheck(const Lattice& lattice)
    : dims_(lattice.dims()), name_(lattice.heights->name), descending_(lattice.axes[2].descending()) {}

std::string HeightCheck::place(std::size_t frame, glm::ivec3 sample) const {
    return "heights " + name_ + ", key frame " + std::to_string(frame) + ", sample x " +
           std::to_string(sample.x) + ", y " + std::to_string(sample.y) + ", z " + std::to_string(sample.z);
}

void HeightCheck::add(std::size_t frame, std::span<const float> samples, std::span<const float> heights) {
    const std::size_t level = static_cast<std::size_t>(dims_.x) * dims_.y;
    std::size_t i = 0;
    for (int z = 0; z < dims_.z; ++z)
        for (int y = 0; y < dims_.y; ++y)
            for (int x = 0; x < dims_.x; ++x, ++i) {
                const float height = heights[i];
                if (std::isnan(height)) {
                    if (!std::isnan(samples[i]))
                        throw Error("the sample has a value, but its height is missing",
                                    place(frame, {x, y, z}));
                    continue;
                }
                min_ = std::min<double>(min_, height);
                max_ = std::max<double>(max_, height);
                if (z > 0 && !std::isnan(heights[i - level]))
                    addStep(frame, {x, y, z - 1}, heights[i - level], height);
            }
}

void HeightCheck::addStep(std::size_t frame, glm::ivec3 lower, float below, float above) {
    const double step = descending_ ? static_cast<double>(below) - above : static_cast<double>(above) - below;
    if (!(step > 0))
        throw Error(std::string("heights must strictly ") + (descending_ ? "decrease" : "increase") +
                        " along every column, but here they go from " + text(below) + " to " + text(above),
                    place(frame, lower));
    if (step >= smallestStep_) return;
    smallestStep_ = step;
    smallestStepPlace_ = place(frame, lower);
}

void HeightCheck::finish() const {
    if (min_ > max_) throw Error("no sample has a height", "heights " + name_);
    // Between key frames a height is a + s (b - a) with magnitudes of at most M: three roundings of at most
    // 2 M, 2 M and M times eps/2, 2.5 M eps together, so two heights come closer by at most 5 M eps.
    constexpr double kRoundings = 6;
    const double magnitude = std::max(std::abs(min_), std::abs(max_));
    if (!(smallestStep_ <= kRoundings * std::numeric_limits<float>::epsilon() * magnitude)) return;
    throw Error("two successive heights of a column are " + text(smallestStep_) +
                    " apart, too close for floats of up to " + text(magnitude),
                smallestStepPlace_, "subtract a constant height");
}

}  // namespace isoglass
