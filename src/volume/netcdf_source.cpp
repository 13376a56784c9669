#include "base/error.h"
#include "volume/cf_axes.h"
#include "volume/cf_packing.h"
#include "volume/cf_time.h"
#include "volume/frame_source.h"
#include "volume/netcdf_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <unordered_set>

namespace isoglass {

namespace {

/// A header announces any size in a few bytes; beyond these it is not believed.
constexpr std::size_t kLongestAxis = std::size_t{1} << 20;
constexpr std::size_t kMostSamples = std::size_t{1} << 34;
/// Samples read at a time: the file's own type and the transposition need a copy of them.
constexpr std::size_t kSlabSamples = std::size_t{1} << 24;

/// "TEMP(TIME, Z, Y, X)".
std::string signature(const NetcdfFile& file, const NetcdfVariable& variable) {
    std::string text = variable.name + "(";
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
        text += (i > 0 ? ", " : "") + file.dimension(variable.dimensions[i]).name;
    return text + ")";
}

/// Names that other variables refer to: coordinates and cell bounds are not data.
std::unordered_set<std::string> auxiliaryNames(const NetcdfFile& file) {
    std::unordered_set<std::string> names;
    for (const NetcdfVariable& variable : file.variables())
        for (const char* attribute : {"bounds", "climatology", "coordinates"}) {
            std::istringstream words(file.text(variable, attribute).value_or(""));
            for (std::string word; words >> word;) names.insert(word);
        }
    return names;
}

std::vector<const NetcdfVariable*> findVolumes(const NetcdfFile& file) {
    const std::unordered_set<std::string> auxiliary = auxiliaryNames(file);
    std::vector<const NetcdfVariable*> volumes;
    for (const NetcdfVariable& variable : file.variables())
        if (!auxiliary.contains(variable.name) && findShape(file, variable)) volumes.push_back(&variable);
    return volumes;
}

std::string listed(const NetcdfFile& file, const std::vector<const NetcdfVariable*>& variables) {
    std::string text;
    for (const NetcdfVariable* variable : variables)
        text += (text.empty() ? "" : ", ") + signature(file, *variable);
    return text.empty() ? "none" : text;
}

const NetcdfVariable& selectVariable(const NetcdfFile& file, const std::string& name) {
    const std::vector<const NetcdfVariable*> volumes = findVolumes(file);
    if (!name.empty()) {
        if (const NetcdfVariable* variable = file.find(name)) return *variable;
        throw Error("no variable \"" + name + "\"", file.path().string(),
                    "volumes in the file: " + listed(file, volumes));
    }
    if (volumes.size() == 1) return *volumes.front();
    if (!volumes.empty())
        throw Error("the file has several volumes", file.path().string(),
                    "choose one with --variable: " + listed(file, volumes));
    std::vector<const NetcdfVariable*> all;
    for (const NetcdfVariable& variable : file.variables()) all.push_back(&variable);
    throw Error("no variable has three axes longer than one sample", file.path().string(),
                "variables in the file: " + listed(file, all));
}

GridShape requireShape(const NetcdfFile& file, const NetcdfVariable& variable) {
    std::optional<GridShape> shape = findShape(file, variable);
    if (!shape)
        throw Error("the variable is no volume: " + signature(file, variable) +
                        " has not three axes longer than one sample (and time)",
                    file.place(variable), "volumes in the file: " + listed(file, findVolumes(file)));
    std::size_t samples = 1;
    for (const std::size_t position : shape->axes) {
        const NetcdfDimension& dimension = file.dimension(variable.dimensions[position]);
        if (dimension.length > kLongestAxis || dimension.length > kMostSamples / samples)
            throw Error("the volume is too large: axis " + dimension.name + " has " +
                            std::to_string(dimension.length) + " samples",
                        file.place(variable));
        samples *= dimension.length;
    }
    return std::move(*shape);
}

std::string provenanceOf(const NetcdfFile& file, const NetcdfVariable& variable) {
    std::string text = file.path().filename().string() + ", NetCDF, variable " + variable.name;
    for (const char* attribute : {"title", "source", "history"})
        if (const auto value = file.globalText(attribute); value && !value->empty())
            text += std::string("; ") + attribute + ": " + *value;
    return text;
}

class NetcdfSource final : public FrameSource {
  public:
    NetcdfSource(const std::filesystem::path& path, const ImportOptions& options)
        : file_(path),
          variable_(selectVariable(file_, options.variable)),
          shape_(requireShape(file_, variable_)),
          reader_(makeSampleReader(file_, variable_)) {
        description_.name = variable_.name;
        const auto standardName = file_.text(variable_, "standard_name");
        description_.longName = file_.text(variable_, "long_name").value_or(standardName.value_or(""));
        description_.units = file_.text(variable_, "units").value_or("");
        for (std::size_t i = 0; i < 3; ++i)
            description_.lattice.axes[i] =
                readAxis(file_, variable_, shape_, shape_.axes[i], description_.notes);
        description_.time = readTimeAxis(file_, variable_, shape_, options.times, description_.notes);
        description_.provenance = provenanceOf(file_, variable_);

        std::size_t stride = 1;
        for (std::size_t i = 0; i < 3; ++i) {
            order_[i] = {shape_.axes[i], lengthOf(shape_.axes[i]), stride};
            stride *= order_[i].length;
        }
        std::ranges::sort(order_, {}, &Extent::position);
    }

    const SeriesDescription& description() const override { return description_; }

    void read(std::size_t frame, std::span<float> samples) override {
        std::vector<std::size_t> start(variable_.dimensions.size(), 0);
        std::vector<std::size_t> count(variable_.dimensions.size(), 1);
        if (shape_.time) start[*shape_.time] = frame;
        const auto& [slow, middle, fast] = order_;
        count[middle.position] = middle.length;
        count[fast.position] = fast.length;

        const std::size_t plane = middle.length * fast.length;
        const std::size_t thickness = std::max<std::size_t>(1, kSlabSamples / plane);
        for (std::size_t first = 0; first < slow.length; first += thickness) {
            const std::size_t planes = std::min(thickness, slow.length - first);
            start[slow.position] = first;
            count[slow.position] = planes;
            slab_.resize(planes * plane);
            reader_->read(start, count, slab_);
            scatter(first, planes, samples);
        }
    }

  private:
    /// One axis as the file stores it: which dimension, how long, and how far apart its neighbours lie in
    /// a key frame (x fastest).
    struct Extent {
        std::size_t position;
        std::size_t length;
        std::size_t stride;
    };

    std::size_t lengthOf(std::size_t position) const {
        return file_.dimension(variable_.dimensions[position]).length;
    }

    void scatter(std::size_t first, std::size_t planes, std::span<float> samples) const {
        const auto& [slow, middle, fast] = order_;
        const float* sample = slab_.data();
        for (std::size_t i = first; i < first + planes; ++i)
            for (std::size_t j = 0; j < middle.length; ++j)
                for (std::size_t k = 0; k < fast.length; ++k)
                    samples[i * slow.stride + j * middle.stride + k * fast.stride] = *sample++;
    }

    NetcdfFile file_;
    const NetcdfVariable& variable_;
    GridShape shape_;
    std::unique_ptr<SampleReader> reader_;
    SeriesDescription description_;
    std::array<Extent, 3> order_{};  ///< slowest in the file first
    std::vector<float> slab_;
};

}  // namespace

std::unique_ptr<FrameSource> openNetcdf(const std::filesystem::path& file, const ImportOptions& options) {
    return std::make_unique<NetcdfSource>(file, options);
}

}  // namespace isoglass
