#include "volume/grid_reader.h"

#include "base/error.h"

#include <algorithm>

namespace isoglass {

namespace {

/// Samples read at a time: the file's own type and the transposition need a copy of them.
constexpr std::size_t kSlabSamples = std::size_t{1} << 24;

/// Means of neighbours along the middle index of `data`, outer x (length + 1) x inner values, in place: what
/// is written lies never behind what is still to be read.
void meanOfNeighbours(std::span<float> data, std::size_t outer, std::size_t length, std::size_t inner) {
    for (std::size_t a = 0; a < outer; ++a) {
        const float* in = &data[a * (length + 1) * inner];
        float* out = &data[a * length * inner];
        // Magnitudes are at most kLargestValue, half of what a float holds: the sum does not overflow.
        for (std::size_t i = 0; i < length * inner; ++i) out[i] = 0.5f * (in[i] + in[i + inner]);
    }
}

std::string described(const CentredDimension& dimension) {
    return dimension.name + " (" + std::to_string(dimension.length) + ")";
}

std::string described(const GridDimensions& grid) {
    std::string text;
    if (grid.time) text = described(*grid.time) + ", ";
    return text + described(grid.axes[2]) + ", " + described(grid.axes[1]) + ", " + described(grid.axes[0]);
}

bool same(const CentredDimension& a, const CentredDimension& b) {
    return a.name == b.name && a.length == b.length;
}

}  // namespace

GridReader::GridReader(const NetcdfFile& file, const NetcdfVariable& variable, const GridDimensions& grid)
    : file_(file), variable_(variable), reader_(makeSampleReader(file, variable)) {
    for (std::size_t k = 0; k < 3; ++k) dims_[k] = grid.axes[k].length;
    for (std::size_t position = 0; position < variable.dimensions.size(); ++position) match(position, grid);
    std::size_t stride = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        axes_[k].stride = stride;
        stride *= axes_[k].length;
        if (axes_[k].position) continue;
        whole_ = false;
        notes_.push_back(variable.name + " has no dimension " + grid.axes[k].name +
                         " in the source: it is the same all along it.");
    }
    if (!whole_) compact_.resize(stride);
    stored_ = axes_;
    std::ranges::stable_sort(stored_, {}, [](const Extent& extent) { return extent.position; });
}

void GridReader::match(std::size_t position, const GridDimensions& grid) {
    const CentredDimension own = centredDimension(file_, variable_, position);
    for (std::size_t k = 0; k < 3; ++k) {
        if (!same(own, grid.axes[k]) || axes_[k].position) continue;
        axes_[k] = {.position = position, .length = own.length, .staggered = own.staggered ? 1u : 0u};
        if (own.staggered)
            notes_.push_back(variable_.name + " is staggered along " + own.name +
                             " in the source: samples are means of the two neighbours, at cell centres.");
        return;
    }
    if (grid.time && same(own, *grid.time)) {
        time_ = position;
    } else if (own.length != 1 || own.staggered) {
        throw Error("dimension " + described(own) + " is none of the volume's: " + described(grid),
                    file_.place(variable_), "variables of one expression must lie on one grid");
    }
}

void GridReader::read(std::size_t frame, std::span<float> samples) {
    std::vector<std::size_t> start(variable_.dimensions.size(), 0);
    std::vector<std::size_t> count(variable_.dimensions.size(), 1);
    if (time_) start[*time_] = frame;
    const auto& [slow, middle, fast] = stored_;
    const std::size_t plane = middle.stored(middle.length) * fast.stored(fast.length);
    const std::size_t thickness = std::max<std::size_t>(1, kSlabSamples / plane);
    for (std::size_t first = 0; first < slow.length; first += thickness) {
        const std::size_t planes = std::min(thickness, slow.length - first);
        readSlab(start, count, first, planes);
        scatter(first, planes, whole_ ? samples : std::span<float>(compact_));
    }
    if (!whole_) repeat(samples);
}

/// Reads `planes` planes of centres along the slowest axis, and brings them to the centres.
void GridReader::readSlab(std::vector<std::size_t>& start, std::vector<std::size_t>& count, std::size_t first,
                          std::size_t planes) {
    const auto& [slow, middle, fast] = stored_;
    const auto choose = [&](const Extent& extent, std::size_t from, std::size_t centres) {
        if (!extent.position) return;
        start[*extent.position] = from;
        count[*extent.position] = extent.stored(centres);
    };
    choose(slow, first, planes);
    choose(middle, 0, middle.length);
    choose(fast, 0, fast.length);
    const std::size_t rows = middle.stored(middle.length);
    const std::size_t row = fast.stored(fast.length);
    slab_.resize(slow.stored(planes) * rows * row);
    reader_->read(start, count, slab_);
    if (slow.staggered) meanOfNeighbours(slab_, 1, planes, rows * row);
    if (middle.staggered) meanOfNeighbours(slab_, planes, middle.length, row);
    if (fast.staggered) meanOfNeighbours(slab_, planes * middle.length, fast.length, 1);
}

void GridReader::scatter(std::size_t first, std::size_t planes, std::span<float> out) const {
    const auto& [slow, middle, fast] = stored_;
    const float* sample = slab_.data();
    for (std::size_t i = first; i < first + planes; ++i)
        for (std::size_t j = 0; j < middle.length; ++j)
            for (std::size_t k = 0; k < fast.length; ++k)
                out[i * slow.stride + j * middle.stride + k * fast.stride] = *sample++;
}

/// Fills a key frame from `compact_`.
void GridReader::repeat(std::span<float> samples) const {
    const auto offset = [this](std::size_t k, std::size_t i) {
        return axes_[k].position ? i * axes_[k].stride : 0;
    };
    float* out = samples.data();
    for (std::size_t z = 0; z < dims_[2]; ++z)
        for (std::size_t y = 0; y < dims_[1]; ++y)
            for (std::size_t x = 0; x < dims_[0]; ++x)
                *out++ = compact_[offset(0, x) + offset(1, y) + offset(2, z)];
}

}  // namespace isoglass
