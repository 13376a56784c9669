#include "unit/import/netcdf_writer.h"

#include <stdexcept>

namespace isoglass::test {

namespace {

void require(int status) {
    if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
}

}  // namespace

NetcdfWriter::NetcdfWriter(const std::filesystem::path& path, int format) : path_(path) {
    require(nc_create(path.c_str(), format | NC_CLOBBER, &id_));
}

NetcdfWriter& NetcdfWriter::dimension(const std::string& name, std::size_t length) {
    nc_redef(id_);
    int dimension = 0;
    require(nc_def_dim(id_, name.c_str(), length, &dimension));
    return *this;
}

NetcdfWriter& NetcdfWriter::variable(const std::string& name, nc_type type,
                                     const std::vector<std::string>& dimensions) {
    nc_redef(id_);
    std::vector<int> ids(dimensions.size());
    for (std::size_t i = 0; i < ids.size(); ++i) require(nc_inq_dimid(id_, dimensions[i].c_str(), &ids[i]));
    int variable = 0;
    require(nc_def_var(id_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &variable));
    return *this;
}

NetcdfWriter& NetcdfWriter::text(const std::string& variable, const std::string& attribute,
                                 const std::string& value) {
    nc_redef(id_);
    require(nc_put_att_text(id_, variableId(variable), attribute.c_str(), value.size(), value.data()));
    return *this;
}

NetcdfWriter& NetcdfWriter::numbers(const std::string& variable, const std::string& attribute, nc_type type,
                                    const std::vector<double>& values) {
    nc_redef(id_);
    require(
        nc_put_att_double(id_, variableId(variable), attribute.c_str(), type, values.size(), values.data()));
    return *this;
}

NetcdfWriter& NetcdfWriter::values(const std::string& variable, const std::vector<double>& values) {
    nc_enddef(id_);
    nc_type type = NC_NAT;
    require(nc_inq_vartype(id_, variableId(variable), &type));
    if (type == NC_FLOAT) {
        // The library refuses to convert an infinite double.
        const std::vector<float> floats(values.begin(), values.end());
        require(nc_put_var_float(id_, variableId(variable), floats.data()));
        return *this;
    }
    require(nc_put_var_double(id_, variableId(variable), values.data()));
    return *this;
}

NetcdfWriter& NetcdfWriter::coordinate(const std::string& name, const std::vector<double>& coordinates,
                                       const std::string& units) {
    variable(name, NC_DOUBLE, {name});
    if (!units.empty()) text(name, "units", units);
    return values(name, coordinates);
}

int NetcdfWriter::variableId(const std::string& name) const {
    if (name.empty()) return NC_GLOBAL;
    int variable = 0;
    require(nc_inq_varid(id_, name.c_str(), &variable));
    return variable;
}

std::filesystem::path NetcdfWriter::close() {
    if (id_ >= 0) nc_close(id_);
    id_ = -1;
    return path_;
}

NetcdfWriter& writeStandardVolume(NetcdfWriter& writer) {
    writer.dimension("time", 2).dimension("lev", 2).dimension("lat", 3).dimension("lon", 4);
    writer.variable("T", NC_FLOAT, {"time", "lev", "lat", "lon"});
    writer.coordinate("time", {0, 6}, "hours since 2000-01-01");
    writer.coordinate("lev", {0, 50}, "m");
    writer.coordinate("lat", {-10, 0, 10}, "degrees_north");
    writer.coordinate("lon", {0, 10, 20, 30}, "degrees_east");
    std::vector<double> samples;
    for (int t = 0; t < 2; ++t)
        for (int z = 0; z < 2; ++z)
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 4; ++x) samples.push_back(1000 * t + 100 * z + 10 * y + x);
    return writer.values("T", samples);
}

}  // namespace isoglass::test
