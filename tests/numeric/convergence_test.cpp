#include "mesh/mesh_check.h"
#include "numeric/case_fields.h"
#include "numeric/table_row.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>

namespace isoglass::numeric {
namespace {

/// A Gaussian of width w that moves along x with speed 1; its surface at `kIso` is the sphere of radius R
/// around (t, 0, 0).
constexpr double kWidth = 0.4;
constexpr double kRadius = 0.3;

float bump(glm::dvec3 p, double time) {
    const glm::dvec3 d = p - glm::dvec3(time, 0, 0);
    return static_cast<float>(std::exp(-glm::dot(d, d) / (2 * kWidth * kWidth)));
}

const float kIso = static_cast<float>(std::exp(-kRadius * kRadius / (2 * kWidth * kWidth)));

/// `cells` along each axis of [-1/2, 1/2], stretched smoothly by up to a third.
Lattice stretchedLattice(int cells) {
    Lattice lattice = unitLattice(glm::ivec3(cells + 1));
    for (Axis& axis : lattice.axes) {
        for (int i = 0; i <= cells; ++i) {
            const double u = static_cast<double>(i) / cells;
            axis.coordinates[i] = u - 0.5 + std::sin(2 * std::numbers::pi * u) / (6 * std::numbers::pi);
        }
    }
    return lattice;
}

/// The surface at time 0 between key frames at -interval/2 and interval/2; from one exact key frame where
/// `interval` is 0.
SurfaceMesh meshBetween(const Lattice& lattice, double interval) {
    const auto before = makeAnalyticFrame(lattice, bump, -interval / 2);
    if (interval == 0) return extractSurface(lattice, {before, nullptr, 0}, {.iso = kIso}).mesh;
    const auto after = makeAnalyticFrame(lattice, bump, interval / 2);
    return extractSurface(lattice, {before, after, 0.5f}, {.iso = kIso}).mesh;
}

double rootMeanSquareDistance(const SurfaceMesh& mesh) {
    double sum = 0;
    for (const glm::vec3& p : mesh.positions) {
        const double distance = glm::length(glm::dvec3(p) + mesh.origin) - kRadius;
        sum += distance * distance;
    }
    return std::sqrt(sum / static_cast<double>(mesh.vertexCount()));
}

/// Root mean square of the angle between normal and radius, in radians.
double rootMeanSquareAngle(const SurfaceMesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::dvec3 radius = glm::normalize(glm::dvec3(mesh.positions[i]) + mesh.origin);
        const double sine = glm::length(glm::cross(radius, glm::normalize(glm::dvec3(mesh.normals[i]))));
        sum += sine * sine;
    }
    return std::sqrt(sum / static_cast<double>(mesh.vertexCount()));
}

double volumeOf(const SurfaceMesh& mesh) {
    return measure(mesh).volume;
}

/// Prints the errors and returns the observed orders, one between each two refinements by 2.
std::vector<double> orders(const std::string& what, const std::vector<double>& errors) {
    std::vector<double> result;
    std::cout << what << ": errors";
    for (const double error : errors) std::cout << ' ' << error;
    std::cout << ", observed orders";
    for (std::size_t i = 1; i < errors.size(); ++i) {
        result.push_back(std::log2(errors[i - 1] / errors[i]));
        std::cout << ' ' << result.back();
    }
    std::cout << '\n';
    return result;
}

std::string listed(const std::vector<double>& values) {
    std::ostringstream text;
    text.precision(3);
    for (const double value : values) text << (text.tellp() > 0 ? ", " : "") << value;
    return text.str();
}

// A crossing is off by (h^2/8) f''/|f'| (1 + O(h/R)) with h the steps around it; the steps are a smooth
// function of the place, so the mean is c h^2 (1 + O(h/R)) for a fixed c. Largest step 4/3 of the mean: h/R
// is 0.19, 0.09 and 0.05 for 24, 48 and 96 cells; even terms only by symmetry of the mean over edge
// positions, but let the first count in full: log2 (1 + 0.19) = 0.25 and log2 (1 + 0.09) = 0.13.
TEST(Convergence, PositionsNormalsAndVolumeAreOfSecondOrderInSpace) {
    std::vector<double> distance;
    std::vector<double> angle;
    std::vector<double> volume;
    for (const int cells : {24, 48, 96}) {
        const SurfaceMesh mesh = meshBetween(stretchedLattice(cells), 0);
        distance.push_back(rootMeanSquareDistance(mesh));
        angle.push_back(rootMeanSquareAngle(mesh));
        volume.push_back(std::abs(volumeOf(mesh) - 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3)));
    }
    const auto positions = orders("positions", distance);
    const auto normals = orders("normals", angle);
    const auto volumes = orders("volume", volume);
    for (const auto& observed : {positions, normals, volumes}) {
        EXPECT_NEAR(observed[0], 2, 0.25);
        EXPECT_NEAR(observed[1], 2, 0.13);
    }
    addTableRow("OrderInSpace", "accuracy is lost on uneven steps",
                "observed orders: positions " + listed(positions) + ", normals " + listed(normals) +
                    ", volume " + listed(volumes) + " (2 expected)");
}

// Half way between f(-d/2) and f(d/2) the mean is f + (d^2/8) f_tt + (d^4/384) f_tttt: the volume is off by
// c d^2 (1 + e). Of e, the second term gives (d^2/48) f_tttt/f_tt, where f_tttt/f_tt is at most 3/w^2 near
// the center of a Gaussian: 0.016 for d = 0.2; the displacement's own square, delta/R with delta = d^2/(8 R),
// gives d^2/(8 R^2): 0.056. Over twice that, 0.14, the order may be off by log2(1.14) = 0.19, by a quarter
// for half d. The same lattice on both sides takes the error in space away.
TEST(Convergence, IsOfSecondOrderInTime) {
    const Lattice lattice = stretchedLattice(48);
    const double exact = volumeOf(meshBetween(lattice, 0));
    std::vector<double> errors;
    for (const double interval : {0.2, 0.1, 0.05})
        errors.push_back(std::abs(volumeOf(meshBetween(lattice, interval)) - exact));
    const auto observed = orders("volume in time", errors);
    EXPECT_NEAR(observed[0], 2, 0.19);
    EXPECT_NEAR(observed[1], 2, 0.05);
    addTableRow("OrderInTime", "smooth motion jerks between key frames",
                "observed orders " + listed(observed) + " (2 expected)");
}

// Space and time refined together: the sum of two errors of second order.
TEST(Convergence, OfTheWholeChainIsOfSecondOrder) {
    std::vector<double> errors;
    for (const int refinement : {1, 2, 4})
        errors.push_back(
            rootMeanSquareDistance(meshBetween(stretchedLattice(24 * refinement), 0.2 / refinement)));
    const auto observed = orders("positions in space and time", errors);
    // The larger of the two bounds above.
    EXPECT_NEAR(observed[0], 2, 0.25);
    EXPECT_NEAR(observed[1], 2, 0.13);
    addTableRow("OrderOfTheWholeChain", "a step of first order hides between others",
                "observed orders " + listed(observed) + " (2 expected)");
}

}  // namespace
}  // namespace isoglass::numeric
