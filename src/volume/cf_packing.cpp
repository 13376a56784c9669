#include "volume/cf_packing.h"

#include "base/error.h"
#include "volume/frame_source.h"

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace isoglass {

namespace {

struct Limits {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();

    bool contain(double value) const { return value >= min && value <= max; }
};

nc_type attributeType(const NetcdfFile& file, const NetcdfVariable& variable, const char* name) {
    nc_type type = NC_NAT;
    nc_inq_atttype(file.id(), variable.id, name, &type);
    return type;
}

std::size_t typeBytes(const NetcdfFile& file, nc_type type) {
    std::size_t bytes = 0;
    nc_inq_type(file.id(), type, nullptr, &bytes);
    return bytes;
}

/// `Stored` is the type in the file, `Value` what it means: they differ where `_Unsigned` is set.
template <typename Stored, typename Value>
class TypedReader final : public SampleReader {
  public:
    TypedReader(const NetcdfFile& file, const NetcdfVariable& variable) : file_(file), variable_(variable) {
        readFill();
        readMissing();
        const std::vector<double> scale = file.numbers(variable, "scale_factor");
        const std::vector<double> offset = file.numbers(variable, "add_offset");
        if (!scale.empty()) scale_ = scale[0];
        if (!offset.empty()) offset_ = offset[0];
        packed_ = !scale.empty() || !offset.empty();
        readLimits();
    }

    void read(const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
              std::span<float> samples) override {
        buffer_.resize(samples.size());
        file_.check(nc_get_vara(file_.id(), variable_.id, start.data(), count.data(), buffer_.data()),
                    variable_);
        std::ranges::transform(buffer_, samples.begin(),
                               [this](Stored stored) { return sample(static_cast<Value>(stored)); });
    }

  private:
    float sample(Value stored) const {
        constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
        if (std::ranges::find(missing_, stored) != missing_.end()) return kMissing;
        const auto value = static_cast<double>(stored);
        const double unpacked = packed_ ? value * scale_ + offset_ : value;
        if (!storedLimits_.contain(value) || !unpackedLimits_.contain(unpacked)) return kMissing;
        return std::abs(unpacked) <= kLargestValue ? static_cast<float>(unpacked) : kMissing;
    }

    void readFill() {
        const bool byteLong = sizeof(Stored) == 1;
        const bool given = file_.has(variable_, "_FillValue");
        if (byteLong && !given) return;
        // The library copies the attribute as it is, whatever room its type and length need.
        if (given && !isOneValue("_FillValue")) return addMissing("_FillValue");
        int noFill = 0;
        Stored fill{};
        file_.check(nc_inq_var_fill(file_.id(), variable_.id, &noFill, &fill), variable_);
        if (!noFill || given) missing_.push_back(static_cast<Value>(fill));
    }

    void readMissing() {
        if constexpr (sizeof(Stored) == 8 && std::is_integral_v<Stored>) {
            // Doubles do not hold every 64-bit integer.
            if (attributeType(file_, variable_, "missing_value") == variable_.type) {
                std::size_t length = 0;
                file_.check(nc_inq_attlen(file_.id(), variable_.id, "missing_value", &length), variable_);
                std::vector<Stored> values(length);
                file_.check(nc_get_att(file_.id(), variable_.id, "missing_value", values.data()), variable_);
                for (const Stored value : values) missing_.push_back(static_cast<Value>(value));
                return;
            }
        }
        addMissing("missing_value");
    }

    void addMissing(const char* attribute) {
        for (const double number : file_.numbers(variable_, attribute))
            if (const auto value = asValue(number)) missing_.push_back(*value);
    }

    /// Whether an attribute is one number of the variable's own type.
    bool isOneValue(const char* attribute) const {
        std::size_t length = 0;
        return attributeType(file_, variable_, attribute) == variable_.type &&
               nc_inq_attlen(file_.id(), variable_.id, attribute, &length) == NC_NOERR && length == 1;
    }

    /// The value that a number in an attribute stands for; nothing where no stored value can equal it.
    static std::optional<Value> asValue(double number) {
        if constexpr (std::is_floating_point_v<Value>) {
            if (!(std::abs(number) <= std::numeric_limits<Value>::max())) return std::nullopt;
            return static_cast<Value>(number);
        } else {
            if (number != std::floor(number)) return std::nullopt;
            // 2^digits: the first number above the type's largest, exact as a double.
            const double above = std::ldexp(1.0, std::numeric_limits<Value>::digits);
            const double shifted =
                number < 0 && std::is_unsigned_v<Value> && std::is_signed_v<Stored> ? number + above : number;
            const double least = static_cast<double>(std::numeric_limits<Value>::min());
            if (!(shifted >= least && shifted < above)) return std::nullopt;
            return static_cast<Value>(shifted);
        }
    }

    /// A limit of the valid range in the stored type, which a number of single precision needs: as a
    /// double 0.1 excludes the sample 0.1f.
    static double storedLimit(double number) {
        const std::optional<Value> value = asValue(number);
        return value ? static_cast<double>(*value) : number;
    }

    void readLimits() {
        for (const char* name : {"valid_range", "valid_min", "valid_max"}) {
            const std::vector<double> numbers = file_.numbers(variable_, name);
            const std::string attribute = name;
            const std::size_t expected = attribute == "valid_range" ? 2 : 1;
            if (numbers.size() != expected) continue;
            const bool unpacked = countsUnpacked(name);
            Limits& limits = unpacked ? unpackedLimits_ : storedLimits_;
            const auto limit = [&](double number) { return unpacked ? number : storedLimit(number); };
            if (attribute != "valid_max") limits.min = limit(numbers.front());
            if (attribute != "valid_min") limits.max = limit(numbers.back());
        }
    }

    bool countsUnpacked(const char* name) const {
        if (!packed_) return false;
        const nc_type type = attributeType(file_, variable_, name);
        return typeBytes(file_, type) > sizeof(Stored) &&
               (type == attributeType(file_, variable_, "scale_factor") ||
                type == attributeType(file_, variable_, "add_offset"));
    }

    const NetcdfFile& file_;
    const NetcdfVariable& variable_;
    std::vector<Value> missing_;
    bool packed_ = false;
    double scale_ = 1;
    double offset_ = 0;
    Limits storedLimits_;
    Limits unpackedLimits_;
    std::vector<Stored> buffer_;
};

template <typename Signed>
std::unique_ptr<SampleReader> makeIntegerReader(const NetcdfFile& file, const NetcdfVariable& variable) {
    const std::string flag = file.text(variable, "_Unsigned").value_or("false");
    if (flag == "true" || flag == "TRUE" || flag == "True")
        return std::make_unique<TypedReader<Signed, std::make_unsigned_t<Signed>>>(file, variable);
    return std::make_unique<TypedReader<Signed, Signed>>(file, variable);
}

template <typename Type>
std::unique_ptr<SampleReader> makeReader(const NetcdfFile& file, const NetcdfVariable& variable) {
    return std::make_unique<TypedReader<Type, Type>>(file, variable);
}

}  // namespace

std::unique_ptr<SampleReader> makeSampleReader(const NetcdfFile& file, const NetcdfVariable& variable) {
    switch (variable.type) {
        case NC_BYTE:
            return makeIntegerReader<std::int8_t>(file, variable);
        case NC_UBYTE:
            return makeReader<std::uint8_t>(file, variable);
        case NC_SHORT:
            return makeIntegerReader<std::int16_t>(file, variable);
        case NC_USHORT:
            return makeReader<std::uint16_t>(file, variable);
        case NC_INT:
            return makeIntegerReader<std::int32_t>(file, variable);
        case NC_UINT:
            return makeReader<std::uint32_t>(file, variable);
        case NC_INT64:
            return makeIntegerReader<std::int64_t>(file, variable);
        case NC_UINT64:
            return makeReader<std::uint64_t>(file, variable);
        case NC_FLOAT:
            return makeReader<float>(file, variable);
        case NC_DOUBLE:
            return makeReader<double>(file, variable);
        default:
            throw Error("the samples are not numbers", file.place(variable));
    }
}

}  // namespace isoglass
