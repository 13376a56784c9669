#pragma once

#include "volume/cf_axes.h"
#include "volume/expression.h"
#include "volume/grid_reader.h"
#include "volume/netcdf_file.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isoglass {

/// What an import option such as `--variable` asks for: one variable of a file, or a formula over several.
struct NetcdfFormula {
    std::string name;  ///< of the variable, or as given before the equals sign; else the formula itself
    std::string text;  ///< the formula without that name
    std::vector<const NetcdfVariable*> variables;
    std::optional<Expression> expression;  ///< over `variables`; nothing where it is a single one

    bool isVariable() const { return !expression; }
};

/// Reads "VARIABLE", "EXPRESSION" or "NAME = EXPRESSION"; the name of a variable is always that variable,
/// whatever characters it has. `option` names the place in messages. Throws Error, with the column, where
/// it is no formula or names what is not in the file.
NetcdfFormula readFormula(const NetcdfFile& file, const std::string& text, const std::string& option);

/// Evaluates a formula on the lattice of a series. Use from one thread at a time; `file` must outlive it.
class NetcdfField {
  public:
    /// Throws Error where a variable does not lie on the lattice.
    NetcdfField(const NetcdfFile& file, NetcdfFormula formula, const GridDimensions& grid);

    /// Reads key frame `frame` into `samples`: x fastest, missing samples as NaN. Holds a key frame more for
    /// every variable but the first. Throws Error.
    void read(std::size_t frame, std::span<float> samples);

    const NetcdfFormula& formula() const { return formula_; }
    /// What was done to bring the variables to the lattice, a sentence each.
    std::vector<std::string> notes() const;

  private:
    NetcdfFormula formula_;
    std::vector<GridReader> readers_;  ///< one a variable
    std::vector<std::vector<float>> operands_;
};

/// Variables that can be a series by themselves: three axes and perhaps time, and no other's coordinates.
std::vector<const NetcdfVariable*> findVolumes(const NetcdfFile& file);

/// "TEMP(TIME, Z, Y, X), ..." or "none".
std::string listed(const NetcdfFile& file, const std::vector<const NetcdfVariable*>& variables);

}  // namespace isoglass
