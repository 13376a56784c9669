#include "base/error.h"
#include "volume/cf_axes.h"
#include "volume/cf_time.h"
#include "volume/frame_source.h"
#include "volume/heights.h"
#include "volume/netcdf_field.h"
#include "volume/netcdf_file.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace isoglass {

namespace {

/// A header announces any size in a few bytes; beyond these it is not believed.
constexpr std::size_t kLongestAxis = std::size_t{1} << 20;
constexpr std::size_t kMostSamples = std::size_t{1} << 34;

NetcdfFormula selectFormula(const NetcdfFile& file, const std::string& text) {
    if (!text.empty()) return readFormula(file, text, "--variable");
    const std::vector<const NetcdfVariable*> volumes = findVolumes(file);
    if (volumes.size() == 1) return {volumes.front()->name, volumes.front()->name, volumes, std::nullopt};
    if (!volumes.empty())
        throw Error("the file has several volumes", file.path().string(),
                    "choose one with --variable: " + listed(file, volumes));
    std::vector<const NetcdfVariable*> all;
    for (const NetcdfVariable& variable : file.variables()) all.push_back(&variable);
    throw Error("no variable has three axes longer than one sample", file.path().string(),
                "variables in the file: " + listed(file, all));
}

/// The variable that gives the lattice: the first one of the formula that is a volume.
const NetcdfVariable& referenceOf(const NetcdfFile& file, const NetcdfFormula& formula) {
    for (const NetcdfVariable* variable : formula.variables)
        if (findShape(file, *variable)) return *variable;
    const NetcdfVariable& first = *formula.variables.front();
    throw Error("the variable is no volume: " + listed(file, {&first}) +
                    " has not three axes longer than one sample (and time)",
                file.place(first), "volumes in the file: " + listed(file, findVolumes(file)));
}

GridShape shapeOf(const NetcdfFile& file, const NetcdfVariable& variable) {
    GridShape shape = findShape(file, variable).value();
    std::size_t samples = 1;
    for (const std::size_t position : shape.axes) {
        const CentredDimension& dimension = shape.dimensions[position];
        if (dimension.length > kLongestAxis || dimension.length > kMostSamples / samples)
            throw Error("the volume is too large: axis " + dimension.name + " has " +
                            std::to_string(dimension.length) + " samples",
                        file.place(variable));
        samples *= dimension.length;
    }
    return shape;
}

GridDimensions gridOf(const GridShape& shape) {
    GridDimensions grid;
    for (std::size_t k = 0; k < 3; ++k) grid.axes[k] = shape.dimensions[shape.axes[k]];
    if (shape.time) grid.time = shape.dimensions[*shape.time];
    return grid;
}

std::string provenanceOf(const NetcdfFile& file, const NetcdfFormula& formula, const std::string& heights) {
    std::string text = file.path().filename().string() + ", NetCDF, " +
                       (formula.isVariable() ? "variable " : "expression ") + formula.text;
    if (!heights.empty()) text += ", heights " + heights;
    for (const char* attribute : {"title", "source", "history"})
        if (const auto value = file.globalText(attribute); value && !value->empty())
            text += std::string("; ") + attribute + ": " + *value;
    return text;
}

class NetcdfSource final : public FrameSource {
  public:
    NetcdfSource(const std::filesystem::path& path, const ImportOptions& options) : file_(path) {
        NetcdfFormula formula = selectFormula(file_, options.variable);
        const NetcdfVariable& reference = referenceOf(file_, formula);
        const GridShape shape = shapeOf(file_, reference);
        field_.emplace(file_, std::move(formula), gridOf(shape));
        describe(reference, shape, options);
        description_.provenance =
            provenanceOf(file_, field_->formula(), heights_ ? heights_->formula().text : "");
    }

    const SeriesDescription& description() const override { return description_; }

    void read(std::size_t frame, std::span<float> samples) override { field_->read(frame, samples); }
    void readHeights(std::size_t frame, std::span<float> heights) override { heights_->read(frame, heights); }

  private:
    void describe(const NetcdfVariable& reference, const GridShape& shape, const ImportOptions& options) {
        const NetcdfFormula& formula = field_->formula();
        description_.name = formula.name;
        if (formula.isVariable()) {
            const auto standardName = file_.text(reference, "standard_name");
            description_.longName = file_.text(reference, "long_name").value_or(standardName.value_or(""));
            description_.units = file_.text(reference, "units").value_or("");
        } else if (formula.text != formula.name) {
            description_.longName = formula.text;
        }
        auto& axes = description_.lattice.axes;
        for (std::size_t k = 0; k < (options.height.empty() ? 3 : 2); ++k)
            axes[k] = readAxis(file_, shape, shape.axes[k], description_.notes);
        description_.time = readTimeAxis(file_, reference, shape, options.times, description_.notes);
        addNotes(*field_);
        if (!options.height.empty()) addHeights(gridOf(shape), options.height);
    }

    /// Opens the formula of the heights and makes the third axis of their means.
    void addHeights(const GridDimensions& grid, const std::string& text) {
        heights_.emplace(file_, readFormula(file_, text, "--height"), grid);
        addNotes(*heights_);
        const NetcdfFormula& formula = heights_->formula();
        HeightField heights;
        heights.name = formula.text;
        if (formula.isVariable())
            heights.units = file_.text(*formula.variables.front(), "units").value_or("");

        glm::ivec3 dims;
        for (int k = 0; k < 3; ++k) dims[k] = static_cast<int>(grid.axes[k].length);
        std::vector<float> first(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
        heights_->read(0, first);
        Axis& axis = description_.lattice.axes[2];
        axis.name = grid.axes[2].name;
        axis.units = heights.units;
        axis.coordinates = meanHeights(dims, first, heights.name);
        description_.notes.push_back("Samples lie at the heights " + heights.name + ": axis " + axis.name +
                                     " lists their mean on every level of the first key frame.");
        description_.lattice.heights = std::move(heights);
    }

    void addNotes(const NetcdfField& field) {
        for (std::string& note : field.notes()) description_.notes.push_back(std::move(note));
    }

    NetcdfFile file_;
    std::optional<NetcdfField> field_;
    std::optional<NetcdfField> heights_;
    SeriesDescription description_;
};

}  // namespace

std::unique_ptr<FrameSource> openNetcdf(const std::filesystem::path& file, const ImportOptions& options) {
    return std::make_unique<NetcdfSource>(file, options);
}

}  // namespace isoglass
