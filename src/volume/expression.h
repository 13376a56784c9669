#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isoglass {

enum class ExpressionOp : std::uint8_t;

/// A formula over the samples of several variables, such as "sqrt(U^2 + V^2)".
///
/// Numbers, variables, `pi`, + - * / ^, unary + and -, parentheses, and the functions sqrt abs exp log log10
/// sin cos tan asin acos atan atan2 hypot floor ceil min max (the last two take two or more arguments).
/// Angles are radians, log is natural. As in mathematics ^ binds closest and from the right: -2^2 is -4,
/// 2^3^2 is 2^9. Names start with a letter or _ and go on with letters, digits, _ and dots; others stand
/// between back quotes: `air-temperature`.
///
/// Own code, because Debian's muParser brings OpenMP, which would run loops beside our one parallel seam,
/// and its min and max drop missing values. Immutable, so any number of threads may evaluate it.
class Expression {
  public:
    /// A variable of the formula.
    struct Name {
        std::string text;
        std::size_t column;  ///< where it first stands, from 1
    };

    /// Throws Error, which names `place` and the column (in bytes, from 1), where the text is no formula.
    /// `columnsBefore` is how much stands before `text` in what the user wrote.
    Expression(std::string_view text, const std::string& place, std::size_t columnsBefore = 0);

    /// The variables in the order in which they first appear, each once.
    const std::vector<Name>& names() const { return names_; }
    /// The formula is one variable and nothing else.
    bool isName() const;

    /// Evaluates in double precision, sample by sample: `operands[i]` are the samples of names()[i], as many
    /// as `results`. A sample that is missing (NaN) in any operand is missing in the result; so is a result
    /// that is not finite or of magnitude above kLargestValue. `results` may be one of the operands.
    void evaluate(std::span<const std::span<const float>> operands, std::span<float> results) const;

  private:
    friend class ExpressionParser;

    /// One step of a stack machine: takes one or two rows off the stack, or none, and puts one on it.
    struct Step {
        ExpressionOp op;
        double number = 0;         ///< of a number
        std::size_t variable = 0;  ///< of a variable: index into `names_`
    };

    void evaluateRow(std::span<const std::span<const float>> operands, std::size_t first,
                     std::span<float> results, std::vector<double>& stack) const;

    std::vector<Step> steps_;
    std::vector<Name> names_;
    std::size_t stackDepth_ = 0;  ///< most rows on the stack at a time
};

/// What `--variable` and `--height` take: "EXPRESSION" or "NAME = EXPRESSION".
struct NamedExpression {
    std::string name;               ///< empty where none is given
    std::string expression;         ///< without blanks at its ends
    std::size_t columnsBefore = 0;  ///< bytes of the text before `expression`
};

/// Splits at the first equals sign. Throws Error where what stands before it is no name.
NamedExpression splitNamedExpression(std::string_view text, const std::string& place);

}  // namespace isoglass
