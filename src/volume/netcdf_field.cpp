#include "volume/netcdf_field.h"

#include "base/error.h"

#include <algorithm>
#include <sstream>
#include <unordered_set>

namespace isoglass {

namespace {

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

const NetcdfVariable& requireVariable(const NetcdfFile& file, const std::string& name,
                                      const std::string& place) {
    if (const NetcdfVariable* variable = file.find(name)) return *variable;
    throw Error("no variable \"" + name + "\"", place,
                "volumes in the file: " + listed(file, findVolumes(file)));
}

}  // namespace

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

NetcdfFormula readFormula(const NetcdfFile& file, const std::string& text, const std::string& option) {
    if (const NetcdfVariable* variable = file.find(text)) return {text, text, {variable}, std::nullopt};
    const std::string place = file.path().string() + ", " + option;
    const NamedExpression named = splitNamedExpression(text, place);
    Expression expression(named.expression, place, named.columnsBefore);
    NetcdfFormula formula{named.name.empty() ? named.expression : named.name, named.expression, {}, {}};
    for (const Expression::Name& name : expression.names())
        formula.variables.push_back(
            &requireVariable(file, name.text, place + ", column " + std::to_string(name.column)));
    if (formula.variables.empty())
        throw Error("the expression has no variable", place,
                    "volumes in the file: " + listed(file, findVolumes(file)));
    if (!expression.isName()) formula.expression = std::move(expression);
    return formula;
}

NetcdfField::NetcdfField(const NetcdfFile& file, NetcdfFormula formula, const GridDimensions& grid)
    : formula_(std::move(formula)) {
    for (const NetcdfVariable* variable : formula_.variables) readers_.emplace_back(file, *variable, grid);
    operands_.resize(readers_.size() - 1);
}

void NetcdfField::read(std::size_t frame, std::span<float> samples) {
    readers_.front().read(frame, samples);
    if (!formula_.expression) return;
    std::vector<std::span<const float>> rows = {samples};
    for (std::size_t i = 0; i < operands_.size(); ++i) {
        operands_[i].resize(samples.size());
        readers_[i + 1].read(frame, operands_[i]);
        rows.emplace_back(operands_[i]);
    }
    formula_.expression->evaluate(rows, samples);
}

std::vector<std::string> NetcdfField::notes() const {
    std::vector<std::string> notes;
    for (const GridReader& reader : readers_)
        notes.insert(notes.end(), reader.notes().begin(), reader.notes().end());
    return notes;
}

}  // namespace isoglass
