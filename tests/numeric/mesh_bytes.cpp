#include "numeric/hard_cases.h"

#include <cstdint>
#include <cstdio>
#include <span>

// Prints a hash of every hard case's mesh. Built once for each instruction set that the compiler may choose;
// the lines must be the same.

namespace {

/// FNV-1a, 64 bits.
class Hash {
  public:
    void add(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes)
            value_ = (value_ ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
    }
    unsigned long long value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

int main() {
    for (const isoglass::numeric::HardCase& hard : isoglass::numeric::hardCases()) {
        const auto mesh = isoglass::extractSurface(hard.lattice, hard.field(), hard.options()).mesh;
        Hash hash;
        hash.add(std::as_bytes(std::span(&mesh.origin, 1)));
        hash.add(std::as_bytes(std::span(mesh.positions)));
        hash.add(std::as_bytes(std::span(mesh.normals)));
        hash.add(std::as_bytes(std::span(mesh.triangles)));
        std::printf("%s %zu %016llx\n", hard.name.c_str(), mesh.triangleCount(), hash.value());
    }
    return 0;
}
