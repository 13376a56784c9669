#include "numeric/digital_topology.h"

#include "support/random_fields.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace isoglass::numeric {

namespace {

glm::ivec3 direction(int bits) {
    return {bits & 1, bits >> 1 & 1, bits >> 2};
}

class SignField {
  public:
    SignField(glm::ivec3 dims, std::span<const float> samples, float iso, bool below)
        : dims_(dims), inside_(samples.size()), label_(samples.size()) {
        for (std::size_t i = 0; i < samples.size(); ++i)
            inside_[i] = below ? samples[i] <= iso : samples[i] >= iso;
    }

    bool inDomain(glm::ivec3 i) const {
        for (int k = 0; k < 3; ++k) {
            if (i[k] < 0 || i[k] >= dims_[k]) return false;
        }
        return true;
    }
    bool onTheEnd(glm::ivec3 i) const {
        for (int k = 0; k < 3; ++k) {
            if (i[k] == 0 || i[k] == dims_[k] - 1) return true;
        }
        return false;
    }
    bool inside(glm::ivec3 i) const { return inside_[sampleAt(dims_, i)] != 0; }

    /// Marks everything of the same sign that `seed` is joined to; false where it was marked before.
    bool flood(glm::ivec3 seed) {
        if (label_[sampleAt(dims_, seed)]) return false;
        std::vector<glm::ivec3> open{seed};
        label_[sampleAt(dims_, seed)] = 1;
        while (!open.empty()) {
            const glm::ivec3 at = open.back();
            open.pop_back();
            for (int bits = 1; bits < 8; ++bits) {
                for (const int sign : {-1, 1}) {
                    const glm::ivec3 next = at + sign * direction(bits);
                    if (!inDomain(next) || inside(next) != inside(seed) || label_[sampleAt(dims_, next)])
                        continue;
                    label_[sampleAt(dims_, next)] = 1;
                    open.push_back(next);
                }
            }
        }
        return true;
    }

    /// Simplices with `low` as their lowest corner and all corners inside, each with its sign: chains of
    /// directions 0 < d1 < d2 < 7 by inclusion of bits.
    std::ptrdiff_t eulerShare(glm::ivec3 low) const {
        if (!inside(low)) return 0;
        const auto holds = [&](int bits) {
            const glm::ivec3 corner = low + direction(bits);
            return inDomain(corner) && inside(corner);
        };
        std::ptrdiff_t sum = 1;
        for (int a = 1; a < 8; ++a) {
            if (!holds(a)) continue;
            --sum;
            for (int b = a + 1; b < 8; ++b) {
                if ((a & b) != a || !holds(b)) continue;
                ++sum;
                for (int c = b + 1; c < 8; ++c) sum -= (b & c) == b && holds(c);
            }
        }
        return sum;
    }

  private:
    glm::ivec3 dims_;
    std::vector<std::uint8_t> inside_;
    std::vector<std::uint8_t> label_;
};

}  // namespace

DigitalTopology digitalTopology(glm::ivec3 dims, std::span<const float> samples, float iso, bool below) {
    SignField field(dims, samples, iso, below);
    DigitalTopology result;
    result.closed = true;
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            for (int x = 0; x < dims.x; ++x) {
                const glm::ivec3 i(x, y, z);
                const bool inside = field.inside(i);
                if (std::isnan(samples[sampleAt(dims, i)]) || (inside && field.onTheEnd(i)))
                    result.closed = false;
                if (field.flood(i)) ++(inside ? result.insideComponents : result.outsideComponents);
                result.insideEulerNumber += field.eulerShare(i);
            }
        }
    }
    const std::size_t regions = result.insideComponents + result.outsideComponents;
    result.surfaceComponents = regions > 0 ? regions - 1 : 0;
    result.surfaceEulerNumber = 2 * result.insideEulerNumber;
    return result;
}

}  // namespace isoglass::numeric
