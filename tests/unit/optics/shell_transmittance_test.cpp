#include "optics/shell_transmittance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace isoglass {
namespace {

constexpr int kRays = 400;

/// Extinction along a ray that passes the centre of a ball at distance `sine`, summed in `steps` midpoints
/// from the middle of its way to beyond the ball. The matter fills radii `inner` to 1.
double integratedTransmittance(double sine, double extinction, double inner, int steps) {
    const double length = 1;
    double inside = 0;
    for (int i = 0; i < steps; ++i) {
        const double along = length * (i + 0.5) / steps;
        const double radius = std::hypot(sine, along);
        inside += radius >= inner && radius <= 1 ? length / steps : 0;
    }
    return std::exp(-extinction * inside);
}

TEST(ShellTransmittance, IsTheIntegralAlongTheRay) {
    constexpr int kSteps = 20000;
    for (const double thickness : {0.05, 0.3, 0.9}) {
        for (const double extinction : {0.5, 10.0}) {
            for (int i = 0; i <= kRays; ++i) {
                const double sine = static_cast<double>(i) / kRays;
                // Midpoints miss the two ends of the shell by up to half a step each.
                EXPECT_NEAR(shellTransmittance(sine, extinction, thickness),
                            integratedTransmittance(sine, extinction, 1 - thickness, kSteps),
                            extinction / kSteps);
            }
        }
    }
}

/// Figure 4 of the paper: extinction 10, shell between the radii 1 and 0.95, power exp(-10 * 0.05).
TEST(CosineFit, ReproducesTheExampleOfThePaper) {
    const CosineFit fit = fitCosine(10, 0.05, std::exp(-0.5));
    // The figures are known to three digits.
    EXPECT_NEAR(fit.power, 0.607, 5e-4);
    EXPECT_NEAR(fit.offset, 0.360, 5e-4);
    EXPECT_NEAR(fit.rms, 0.027, 5e-4);
}

TEST(CosineFit, AFreePowerFitsThePaperExampleBetter) {
    const CosineFit fit = fitCosine(10, 0.05);
    EXPECT_NEAR(fit.power, 0.49, 5e-3);
    EXPECT_NEAR(fit.offset, 0.38, 5e-3);
    EXPECT_NEAR(fit.rms, 0.018, 5e-4);
}

double rmsOf(double power, double offset, double extinction, double thickness) {
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
        const double sine = (1 - thickness) * (i + 0.5) / 1000;
        const double residual = std::pow(std::sqrt(1 - sine * sine), power) - offset -
                                shellTransmittance(sine, extinction, thickness);
        sum += residual * residual;
    }
    return std::sqrt(sum / 1000);
}

TEST(CosineFit, IsAMinimumForAnyShell) {
    for (const double thickness : {0.01, 0.05, 0.2, 0.5, 0.9}) {
        for (const double extinction : {0.01, 1.0, 10.0, 100.0}) {
            const CosineFit fit = fitCosine(extinction, thickness);
            ASSERT_TRUE(std::isfinite(fit.power) && std::isfinite(fit.offset));
            EXPECT_NEAR(fit.rms, rmsOf(fit.power, fit.offset, extinction, thickness), 1e-12);
            EXPECT_GE(fit.largest, fit.rms);
            for (const double step : {-1e-3, 1e-3}) {
                // At a minimum a small step gains at most what the solver leaves, about sqrt(epsilon) of
                // the sum of squares.
                const double slack = 1e-7;
                EXPECT_GE(rmsOf(fit.power + step, fit.offset, extinction, thickness), fit.rms * (1 - slack));
                EXPECT_GE(rmsOf(fit.power, fit.offset + step, extinction, thickness), fit.rms * (1 - slack));
            }
        }
    }
}

TEST(ShellOpacity, OfEveryModelIsAShareForEveryAngleAndGradient) {
    const std::vector<ShellOpacity> shells{
        {.model = ShellOpacity::Model::slab, .extinction = 10, .thickness = 0.05f},
        {.model = ShellOpacity::Model::slab, .extinction = 3, .isoWidth = 0.1f, .maxThickness = 0.5f},
        {.model = ShellOpacity::Model::cosine, .extinction = 10, .thickness = 0.05f},
        {.model = ShellOpacity::Model::cosine, .extinction = 200, .thickness = 0.9f, .power = 3.0f},
        {.model = ShellOpacity::Model::isoSpectrum, .extinction = 10, .thickness = 0.05f}};
    for (const ShellOpacity& shell : shells) {
        const PreparedShell prepared = prepareShell(shell);
        for (const double gradient : {0.0, 1e-30, 1.0, 1e30}) {
            for (int i = -100; i <= 100; ++i) {
                const double opacity = shellOpacity(prepared, i / 100.0, gradient);
                EXPECT_GE(opacity, 0);
                EXPECT_LE(opacity, 1);
                EXPECT_EQ(opacity, shellOpacity(prepared, -i / 100.0, gradient)) << "both sides are alike";
            }
        }
    }
}

/// The slab is the shell seen from straight above, and its thickness follows the gradient up to the limit.
TEST(ShellOpacity, OfASlabFollowsItsThickness) {
    const PreparedShell fixed = prepareShell({.extinction = 10, .thickness = 0.05f});
    EXPECT_NEAR(shellOpacity(fixed, 1, 7), 1 - shellTransmittance(0, 10, 0.05), 1e-7);
    const PreparedShell data = prepareShell({.extinction = 2, .isoWidth = 0.5f, .maxThickness = 1});
    EXPECT_NEAR(shellOpacity(data, 1, 2), 1 - std::exp(-2 * 0.25), 1e-12);
    EXPECT_NEAR(shellOpacity(data, 0.5, 2), 1 - std::exp(-2 * 0.25 / 0.5), 1e-12);
    EXPECT_NEAR(shellOpacity(data, 1, 0.1), 1 - std::exp(-2.0), 1e-12) << "limited";
    EXPECT_NEAR(shellOpacity(data, 1, 0), 1 - std::exp(-2.0), 1e-12) << "a vanishing gradient";
}

/// How far each model is from the ray integral through the paper's shell, up to the inner radius: what the
/// manual says of them.
TEST(ShellOpacity, ModelsAreAsCloseToTheIsoSpectrumAsStated) {
    const auto rms = [](const ShellOpacity& shell) {
        const PreparedShell prepared = prepareShell(shell);
        double sum = 0;
        for (int i = 0; i < kRays; ++i) {
            const double sine = 0.95 * (i + 0.5) / kRays;
            const double truth = 1 - integratedTransmittance(sine, 10, 0.95, 20000);
            const double error = shellOpacity(prepared, std::sqrt(1 - sine * sine), 1) - truth;
            sum += error * error;
        }
        return std::sqrt(sum / kRays);
    };
    using Model = ShellOpacity::Model;
    // 5e-4 for figures of three digits, and as much for the integral, which is known to 10 / 20000.
    EXPECT_NEAR(rms({.model = Model::slab, .extinction = 10, .thickness = 0.05f}), 0.022, 1e-3);
    EXPECT_NEAR(rms({.model = Model::cosine, .extinction = 10, .thickness = 0.05f}), 0.018, 1e-3);
    EXPECT_NEAR(rms({.model = Model::isoSpectrum, .extinction = 10, .thickness = 0.05f}), 0, 5e-4);
}

}  // namespace
}  // namespace isoglass
