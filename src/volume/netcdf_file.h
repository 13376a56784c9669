#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

struct NetcdfDimension {
    std::string name;
    std::size_t length;
};

struct NetcdfVariable {
    int id;
    std::string name;
    int type;                     ///< nc_type
    std::vector<int> dimensions;  ///< indices into `NetcdfFile::dimensions`, slowest first
};

/// An open NetCDF file (classic, 64-bit or NetCDF-4), its root group only.
///
/// Every failure is an Error that names the file and the variable. Use from one thread at a time.
class NetcdfFile {
  public:
    /// Opens for reading. Throws Error where it is no local NetCDF file or a classic file is too short
    /// for what its header announces (the library would read zeros there).
    explicit NetcdfFile(const std::filesystem::path& path);
    ~NetcdfFile();
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    const std::vector<NetcdfDimension>& dimensions() const { return dimensions_; }
    const std::vector<NetcdfVariable>& variables() const { return variables_; }
    const NetcdfDimension& dimension(int index) const { return dimensions_[index]; }
    /// Null where there is none.
    const NetcdfVariable* find(const std::string& name) const;

    /// Text of an attribute without blanks at its ends; nothing where it is absent or not text.
    std::optional<std::string> text(const NetcdfVariable& variable, const std::string& attribute) const;
    std::optional<std::string> globalText(const std::string& attribute) const;
    bool has(const NetcdfVariable& variable, const std::string& attribute) const;
    /// Values of a numeric attribute; empty where it is absent or text.
    std::vector<double> numbers(const NetcdfVariable& variable, const std::string& attribute) const;

    std::vector<double> globalNumbers(const std::string& attribute) const;

    /// All values of a numeric variable with one dimension, unpacked.
    std::vector<double> values(const NetcdfVariable& variable) const;

    /// The rows of a variable of characters with two dimensions. Throws Error where a row is longer than 256.
    std::vector<std::string> rows(const NetcdfVariable& variable) const;

    /// Throws Error about `variable` where `status` is a failure of the library.
    void check(int status, const NetcdfVariable& variable) const;
    /// "FILE, variable NAME".
    std::string place(const NetcdfVariable& variable) const;
    int id() const { return id_; }

  private:
    void check(int status) const;
    std::optional<std::string> textOf(int variableId, const std::string& attribute) const;
    std::vector<double> numbersOf(int variableId, const std::string& attribute,
                                  const std::string& where) const;

    std::filesystem::path path_;
    int id_ = -1;
    std::vector<NetcdfDimension> dimensions_;
    std::vector<NetcdfVariable> variables_;
};

}  // namespace isoglass
