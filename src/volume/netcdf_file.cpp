#include "volume/netcdf_file.h"

#include "base/error.h"
#include "volume/netcdf_classic.h"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <memory>

namespace isoglass {

namespace {

/// Longest axis whose coordinates are read; a header may announce any length in a few bytes.
constexpr std::size_t kLongestTable = std::size_t{1} << 24;
constexpr std::size_t kLongestRow = 256;

std::string trimmed(std::string text) {
    constexpr const char* kBlanks = " \t\n\r";
    // Text attributes written from C often count the terminating zero.
    text.resize(std::min(text.size(), text.find('\0')));
    text.erase(0, text.find_first_not_of(kBlanks));
    text.erase(text.find_last_not_of(kBlanks) + 1);
    return text;
}

void requireWholeFile(const std::filesystem::path& path) {
    const std::optional<std::uint64_t> promised = classicNetcdfSize(path);
    const std::uintmax_t found = std::filesystem::file_size(path);
    if (promised && found < *promised)
        throw Error("the file is cut off: " + std::to_string(found) + " bytes where its header announces " +
                        std::to_string(*promised),
                    path.string(), "copy or download it again");
}

}  // namespace

NetcdfFile::NetcdfFile(const std::filesystem::path& path) : path_(path) {
    // The library would take a name that looks like an address for one and go to the network.
    std::error_code unreadable;
    if (!std::filesystem::is_regular_file(path, unreadable)) throw Error("no such file", path.string());
    requireWholeFile(path);
    const int status = nc_open(std::filesystem::absolute(path).c_str(), NC_NOWRITE, &id_);
    if (status != NC_NOERR)
        throw Error("cannot be read as NetCDF: " + std::string(nc_strerror(status)), path.string(),
                    "the file may be damaged or in another format");
    try {
        int dimensionCount = 0;
        int variableCount = 0;
        check(nc_inq(id_, &dimensionCount, &variableCount, nullptr, nullptr));
        std::array<char, NC_MAX_NAME + 1> name{};
        std::vector<int> dimensionIds(static_cast<std::size_t>(dimensionCount));
        check(nc_inq_dimids(id_, nullptr, dimensionIds.data(), 0));
        for (const int id : dimensionIds) {
            std::size_t length = 0;
            check(nc_inq_dim(id_, id, name.data(), &length));
            dimensions_.push_back({name.data(), length});
        }
        for (int i = 0; i < variableCount; ++i) {
            nc_type type = NC_NAT;
            int rank = 0;
            check(nc_inq_var(id_, i, name.data(), &type, &rank, nullptr, nullptr));
            std::vector<int> dimensions(static_cast<std::size_t>(rank));
            check(nc_inq_vardimid(id_, i, dimensions.data()));
            for (int& dimension : dimensions)
                dimension =
                    static_cast<int>(std::ranges::find(dimensionIds, dimension) - dimensionIds.begin());
            variables_.push_back({i, name.data(), type, std::move(dimensions)});
        }
    } catch (...) {
        nc_close(id_);
        throw;
    }
}

NetcdfFile::~NetcdfFile() {
    nc_close(id_);
}

const NetcdfVariable* NetcdfFile::find(const std::string& name) const {
    const auto found = std::ranges::find(variables_, name, &NetcdfVariable::name);
    return found == variables_.end() ? nullptr : &*found;
}

std::optional<std::string> NetcdfFile::textOf(int variableId, const std::string& attribute) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(id_, variableId, attribute.c_str(), &type, &length) != NC_NOERR) return std::nullopt;
    if (type == NC_CHAR) {
        std::string text(length, '\0');
        check(nc_get_att_text(id_, variableId, attribute.c_str(), text.data()));
        return trimmed(std::move(text));
    }
    if (type != NC_STRING || length != 1) return std::nullopt;
    char* value = nullptr;
    check(nc_get_att_string(id_, variableId, attribute.c_str(), &value));
    std::string text = value ? value : "";
    nc_free_string(1, &value);
    return trimmed(std::move(text));
}

std::optional<std::string> NetcdfFile::text(const NetcdfVariable& variable,
                                            const std::string& attribute) const {
    return textOf(variable.id, attribute);
}

std::optional<std::string> NetcdfFile::globalText(const std::string& attribute) const {
    return textOf(NC_GLOBAL, attribute);
}

bool NetcdfFile::has(const NetcdfVariable& variable, const std::string& attribute) const {
    return nc_inq_attid(id_, variable.id, attribute.c_str(), nullptr) == NC_NOERR;
}

std::vector<double> NetcdfFile::numbersOf(int variableId, const std::string& attribute,
                                          const std::string& where) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(id_, variableId, attribute.c_str(), &type, &length) != NC_NOERR) return {};
    if (type == NC_CHAR || type > NC_UINT64) return {};
    std::vector<double> values(length);
    const int status = nc_get_att_double(id_, variableId, attribute.c_str(), values.data());
    if (status != NC_NOERR) throw Error(nc_strerror(status), where, "the file may be damaged");
    return values;
}

std::vector<double> NetcdfFile::numbers(const NetcdfVariable& variable, const std::string& attribute) const {
    return numbersOf(variable.id, attribute, place(variable));
}

std::vector<double> NetcdfFile::globalNumbers(const std::string& attribute) const {
    return numbersOf(NC_GLOBAL, attribute, path_.string());
}

std::vector<std::string> NetcdfFile::rows(const NetcdfVariable& variable) const {
    const std::size_t count = dimension(variable.dimensions.at(0)).length;
    const std::size_t length = dimension(variable.dimensions.at(1)).length;
    if (length > kLongestRow || count > kLongestTable / kLongestRow)
        throw Error(std::to_string(count) + " rows of " + std::to_string(length) + " characters are too many",
                    place(variable));
    std::string text(count * length, '\0');
    if (!text.empty()) check(nc_get_var_text(id_, variable.id, text.data()), variable);
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < count; ++i) rows.push_back(trimmed(text.substr(i * length, length)));
    return rows;
}

std::vector<double> NetcdfFile::values(const NetcdfVariable& variable) const {
    const std::size_t length = dimension(variable.dimensions.at(0)).length;
    if (length > kLongestTable)
        throw Error("an axis of " + std::to_string(length) + " values is too long", place(variable));
    std::vector<double> values(length);
    if (length > 0) check(nc_get_var_double(id_, variable.id, values.data()), variable);
    const std::vector<double> scale = numbers(variable, "scale_factor");
    const std::vector<double> offset = numbers(variable, "add_offset");
    for (double& value : values)
        value = value * (scale.empty() ? 1 : scale[0]) + (offset.empty() ? 0 : offset[0]);
    return values;
}

void NetcdfFile::check(int status, const NetcdfVariable& variable) const {
    if (status != NC_NOERR) throw Error(nc_strerror(status), place(variable), "the file may be damaged");
}

void NetcdfFile::check(int status) const {
    if (status != NC_NOERR) throw Error(nc_strerror(status), path_.string(), "the file may be damaged");
}

std::string NetcdfFile::place(const NetcdfVariable& variable) const {
    return path_.string() + ", variable " + variable.name;
}

}  // namespace isoglass
