#include "numeric/case_fields.h"
#include "support/random_fields.h"

#include <array>
#include <initializer_list>

namespace isoglass::numeric {

namespace {

/// One cell with the corners of `pattern` inside, at 1, and everything around it outside, at -1.
std::vector<float> oneCell(int pattern) {
    return fill({4, 4, 4}, [=](glm::ivec3 i) {
        const glm::ivec3 corner = i - 1;
        for (int k = 0; k < 3; ++k) {
            if (corner[k] < 0 || corner[k] > 1) return -1.0f;
        }
        return pattern >> (corner.x | corner.y << 1 | corner.z << 2) & 1 ? 1.0f : -1.0f;
    });
}

HardCase cell(std::string name, std::string danger, int pattern, std::size_t components, int euler,
              std::string reason) {
    return {.name = std::move(name),
            .danger = std::move(danger),
            .reason = std::move(reason),
            .lattice = unitLattice({4, 4, 4}),
            .samples = oneCell(pattern),
            .answer = {.closed = true, .components = components, .eulerNumber = euler}};
}

}  // namespace

std::vector<HardCase> signCases() {
    std::vector<HardCase> cases;
    cases.push_back(cell("FaceDiagonalJoined", "the two cells at an ambiguous face disagree", 0x09, 1, 2,
                         "corners 0 and 3 are the ends of the face's Kuhn edge: they are joined"));
    cases.push_back(cell("FaceDiagonalApart", "the two cells at an ambiguous face disagree", 0x06, 2, 4,
                         "corners 1 and 2 share no Kuhn edge: the outside joins between them, two spheres"));
    cases.push_back(cell("BodyDiagonalJoined", "the inside of an ambiguous cell is guessed", 0x81, 1, 2,
                         "corners 0 and 7 are the ends of the body edge: one sphere"));
    cases.push_back(cell("BodyDiagonalApart", "the inside of an ambiguous cell is guessed", 0x42, 2, 4,
                         "corners 1 and 6 share no Kuhn edge: two spheres"));
    cases.push_back(cell("TunnelAlongTheBodyDiagonal", "the tunnel is closed, or its walls cross", 0x7e, 1, 0,
                         "six corners inside form a ring around the outside edge from 0 to 7: a torus"));
    cases.push_back(cell("NoTunnelAcrossTheBodyDiagonal", "a tunnel appears where the lattice has none", 0xbd,
                         1, 2,
                         "corners 1 and 6 are outside and share no Kuhn edge: two dents in one sphere"));
    cases.push_back(cell("ThreeCornersApart", "loops of one cell are joined", 0x16, 3, 6,
                         "corners 1, 2, 4: no two of them share a Kuhn edge, three spheres"));
    cases.push_back({.name = "RandomSigns",
                     .danger = "all 256 sign cases meet each other",
                     .reason = "no pattern is ambiguous on tetrahedra",
                     .lattice = unitLattice({20, 17, 18}),
                     .samples = randomFloats({20, 17, 18}, 5)});
    return cases;
}

}  // namespace isoglass::numeric
