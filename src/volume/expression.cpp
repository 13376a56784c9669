#include "volume/expression.h"

#include "basis/parallel.h"
#include "volume/expression_op.h"
#include "volume/frame_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

using Op = ExpressionOp;

/// Samples evaluated at a time: their rows stay in the first-level cache.
constexpr std::size_t kRow = 256;
constexpr std::size_t kRowsPerTask = 64;

template <typename Function>
void mapOne(double* a, std::size_t count, Function function) {
    for (std::size_t i = 0; i < count; ++i) a[i] = function(a[i]);
}

/// The result takes the place of the first operand.
template <typename Function>
void mapTwo(double* a, const double* b, std::size_t count, Function function) {
    for (std::size_t i = 0; i < count; ++i) a[i] = function(a[i], b[i]);
}

/// Applies an operation to the rows below `top`; returns the new top of the stack.
double* apply(Op op, double* top, std::size_t count) {
    double* a = top - kRow;
    const auto one = [&](auto function) { return mapOne(a, count, function), top; };
    const auto two = [&](auto function) { return mapTwo(a - kRow, a, count, function), a; };
    switch (op) {
        case Op::negate:
            return one([](double x) { return 0.0 - x; });  // never -0
        case Op::squareRoot:
            return one([](double x) { return std::sqrt(x); });
        case Op::absolute:
            return one([](double x) { return std::abs(x); });
        case Op::exponential:
            return one([](double x) { return std::exp(x); });
        case Op::logarithm:
            return one([](double x) { return std::log(x); });
        case Op::logarithm10:
            return one([](double x) { return std::log10(x); });
        case Op::sine:
            return one([](double x) { return std::sin(x); });
        case Op::cosine:
            return one([](double x) { return std::cos(x); });
        case Op::tangent:
            return one([](double x) { return std::tan(x); });
        case Op::arcSine:
            return one([](double x) { return std::asin(x); });
        case Op::arcCosine:
            return one([](double x) { return std::acos(x); });
        case Op::arcTangent:
            return one([](double x) { return std::atan(x); });
        case Op::roundDown:
            return one([](double x) { return std::floor(x); });
        case Op::roundUp:
            return one([](double x) { return std::ceil(x); });
        case Op::add:
            return two([](double x, double y) { return x + y; });
        case Op::subtract:
            return two([](double x, double y) { return x - y; });
        case Op::multiply:
            return two([](double x, double y) { return x * y; });
        case Op::divide:
            return two([](double x, double y) { return x / y; });
        case Op::power:
            return two([](double x, double y) { return std::pow(x, y); });
        case Op::arcTangent2:
            return two([](double x, double y) { return std::atan2(x, y); });
        case Op::hypotenuse:
            return two([](double x, double y) { return std::hypot(x, y); });
        case Op::minimum:
            return two([](double x, double y) { return y < x ? y : x; });
        case Op::maximum:
            return two([](double x, double y) { return x < y ? y : x; });
        case Op::number:
        case Op::variable:
            break;
    }
    return top;
}

}  // namespace

void Expression::evaluateRow(std::span<const std::span<const float>> operands, std::size_t first,
                             std::span<float> results, std::vector<double>& stack) const {
    const std::size_t count = results.size();
    double* top = stack.data();
    for (const Step& step : steps_) {
        if (step.op == Op::number) {
            std::fill_n(top, count, step.number);
            top += kRow;
        } else if (step.op == Op::variable) {
            std::copy_n(operands[step.variable].begin() + static_cast<std::ptrdiff_t>(first), count, top);
            top += kRow;
        } else {
            top = apply(step.op, top, count);
        }
    }
    constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < count; ++i) {
        // min, max and x^0 hide a missing operand.
        bool missing = !(std::abs(stack[i]) <= kLargestValue);
        for (const std::span<const float> operand : operands)
            missing = missing || std::isnan(operand[first + i]);
        results[i] = missing ? kMissing : static_cast<float>(stack[i]);
    }
}

void Expression::evaluate(std::span<const std::span<const float>> operands, std::span<float> results) const {
    parallelFor((results.size() + kRow - 1) / kRow, kRowsPerTask, 0, [&](std::size_t begin, std::size_t end) {
        std::vector<double> stack(stackDepth_ * kRow);
        for (std::size_t row = begin; row < end; ++row) {
            const std::size_t first = row * kRow;
            const std::size_t count = std::min(kRow, results.size() - first);
            evaluateRow(operands, first, results.subspan(first, count), stack);
        }
    });
}

bool Expression::isName() const {
    return steps_.size() == 1 && steps_.front().op == Op::variable;
}

}  // namespace isoglass
