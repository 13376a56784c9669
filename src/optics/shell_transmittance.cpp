#include "optics/shell_transmittance.h"

#include <Eigen/Core>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>

namespace isoglass {
namespace {

/// Enough that the fit is that of the curve: twice as many change no digit of those that are printed.
constexpr int kSamples = 1000;
/// Below it a ray along the surface would divide by zero; the opacity is 1 long before.
constexpr double kSmallestCosine = 1e-6;

/// cosine^power - offset against the shell's transmittance, without clamping: the transmittance lies in
/// (0, 1], so the clamp of the drawn opacity brings no sample farther from it.
class Residuals {
  public:
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;

    Residuals(double extinction, double thickness, std::optional<double> power)
        : power_(power), cosines_(kSamples), wanted_(kSamples) {
        for (int i = 0; i < kSamples; ++i) {
            const double sine = (1 - thickness) * (i + 0.5) / kSamples;
            cosines_[i] = std::sqrt(1 - sine * sine);
            wanted_[i] = shellTransmittance(sine, extinction, thickness);
        }
    }

    int inputs() const { return power_ ? 1 : 2; }
    int values() const { return kSamples; }

    /// Parameters: the offset, and the power where it is free.
    double powerOf(const Eigen::VectorXd& parameters) const { return power_ ? *power_ : parameters[1]; }

    int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals) const {
        residuals = cosines_.pow(powerOf(parameters)) - parameters[0] - wanted_;
        return 0;
    }

    int df(const Eigen::VectorXd& parameters, Eigen::MatrixXd& jacobian) const {
        jacobian.col(0).setConstant(-1);
        if (!power_) jacobian.col(1) = cosines_.pow(parameters[1]) * cosines_.log();
        return 0;
    }

  private:
    std::optional<double> power_;
    Eigen::ArrayXd cosines_;
    Eigen::ArrayXd wanted_;
};

double clampedShare(double value) {
    return std::clamp(value, 0.0, 1.0);
}

double slabThickness(const ShellOpacity& shell, double gradient) {
    if (shell.thickness > 0) return shell.thickness;
    const double most = shell.maxThickness;
    return gradient > 0 ? std::min(shell.isoWidth / gradient, most) : most;
}

}  // namespace

double shellChord(double sine, double thickness) {
    const double inner = 1 - thickness;
    return std::sqrt(std::max(0.0, 1 - sine * sine)) - std::sqrt(std::max(0.0, inner * inner - sine * sine));
}

double shellTransmittance(double sine, double extinction, double thickness) {
    return std::exp(-extinction * shellChord(sine, thickness));
}

CosineFit fitCosine(double extinction, double thickness, std::optional<double> power) {
    Residuals residuals(extinction, thickness, power);
    Eigen::VectorXd parameters(residuals.inputs());
    parameters[0] = 0;
    if (!power) parameters[1] = 1;
    Eigen::LevenbergMarquardt<Residuals> solver(residuals);
    solver.minimize(parameters);
    Eigen::VectorXd left(kSamples);
    residuals(parameters, left);
    return {residuals.powerOf(parameters), parameters[0], std::sqrt(left.squaredNorm() / kSamples),
            left.cwiseAbs().maxCoeff()};
}

PreparedShell prepareShell(const ShellOpacity& shell) {
    PreparedShell prepared{shell};
    if (shell.model == ShellOpacity::Model::cosine)
        prepared.fit = fitCosine(shell.extinction, shell.thickness, shell.power);
    return prepared;
}

double shellOpacity(const PreparedShell& prepared, double cosine, double gradient) {
    const ShellOpacity& shell = prepared.shell;
    cosine = std::min(std::abs(cosine), 1.0);
    switch (shell.model) {
        case ShellOpacity::Model::slab:
            return 1 - std::exp(-shell.extinction * slabThickness(shell, gradient) /
                                std::max(cosine, kSmallestCosine));
        case ShellOpacity::Model::cosine:
            return 1 - clampedShare(std::pow(cosine, prepared.fit.power) - prepared.fit.offset);
        case ShellOpacity::Model::isoSpectrum:
            break;
    }
    return 1 - shellTransmittance(std::sqrt(1 - cosine * cosine), shell.extinction, shell.thickness);
}

}  // namespace isoglass
