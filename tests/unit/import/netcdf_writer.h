#pragma once

#include <netcdf.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace isoglass::test {

/// Writes a small NetCDF file; the file is whole after `close`.
class NetcdfWriter {
  public:
    explicit NetcdfWriter(const std::filesystem::path& path, int format = NC_NETCDF4);
    ~NetcdfWriter() { close(); }
    NetcdfWriter(const NetcdfWriter&) = delete;
    NetcdfWriter& operator=(const NetcdfWriter&) = delete;

    NetcdfWriter& dimension(const std::string& name, std::size_t length);
    NetcdfWriter& variable(const std::string& name, nc_type type, const std::vector<std::string>& dimensions);
    /// An empty variable name means the file itself.
    NetcdfWriter& text(const std::string& variable, const std::string& attribute, const std::string& value);
    NetcdfWriter& numbers(const std::string& variable, const std::string& attribute, nc_type type,
                          const std::vector<double>& values);
    NetcdfWriter& values(const std::string& variable, const std::vector<double>& values);
    /// Defines and fills a coordinate variable of the dimension's name.
    NetcdfWriter& coordinate(const std::string& name, const std::vector<double>& values,
                             const std::string& units = {});

    int id() const { return id_; }
    int variableId(const std::string& name) const;
    std::filesystem::path close();

  private:
    std::filesystem::path path_;
    int id_ = -1;
};

/// "T(time, lev, lat, lon)" with 2 x 2 x 3 x 4 samples of the value 1000 t + 100 z + 10 y + x; lev in
/// "m", lat in degrees_north, lon in degrees_east (0, 10, 20, 30: no circle), time in hours since
/// 2000-01-01 (0, 6). Coordinates may be replaced by writing `values` again.
NetcdfWriter& writeStandardVolume(NetcdfWriter& writer);

}  // namespace isoglass::test
