#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

namespace isoglass::numeric {

/// Adds a row to the table of hard cases: `scripts/numeric_table` names the file in ISOGLASS_NUMERIC_TABLE,
/// elsewhere nothing is written. `outcome` is what was measured in this run.
inline void addTableRow(const std::string& name, const std::string& danger, const std::string& outcome) {
    if (const char* path = std::getenv("ISOGLASS_NUMERIC_TABLE"))
        std::ofstream(path, std::ios::app) << name << '\t' << danger << '\t' << outcome << '\n';
}

}  // namespace isoglass::numeric
