#include "volume/staggering.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace isoglass {

namespace {

bool isCentreOf(const NetcdfFile& file, const std::string& name, std::size_t staggeredLength) {
    const auto found = std::ranges::find(file.dimensions(), name, &NetcdfDimension::name);
    if (found != file.dimensions().end()) return found->length + 1 == staggeredLength;
    constexpr std::array kWrfCentres = {"west_east", "south_north", "bottom_top"};
    return std::ranges::find(kWrfCentres, name) != kWrfCentres.end();
}

}  // namespace

CentredDimension centredDimension(const NetcdfFile& file, const NetcdfVariable& variable,
                                  std::size_t position) {
    constexpr std::string_view kSuffix = "_stag";
    const NetcdfDimension& dimension = file.dimension(variable.dimensions[position]);
    const CentredDimension plain{dimension.name, dimension.length};
    if (!dimension.name.ends_with(kSuffix) || dimension.length < 2) return plain;
    if (file.text(variable, "stagger") == "") return plain;
    const std::string centre = dimension.name.substr(0, dimension.name.size() - kSuffix.size());
    if (!isCentreOf(file, centre, dimension.length)) return plain;
    return {centre, dimension.length - 1, true};
}

}  // namespace isoglass
