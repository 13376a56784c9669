#include "base/error.h"
#include "volume/expression.h"
#include "volume/expression_op.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>

namespace isoglass {

namespace {

using Op = ExpressionOp;

/// Deeper nesting is not a formula but an attack on the stack.
constexpr int kDeepest = 200;
constexpr std::size_t kTwoOrMore = 0;

struct Function {
    std::string_view name;
    Op op;
    std::size_t arguments;  ///< or kTwoOrMore
};

constexpr std::array<Function, 17> kFunctions = {{
    {"sqrt", Op::squareRoot, 1},
    {"abs", Op::absolute, 1},
    {"exp", Op::exponential, 1},
    {"log", Op::logarithm, 1},
    {"log10", Op::logarithm10, 1},
    {"sin", Op::sine, 1},
    {"cos", Op::cosine, 1},
    {"tan", Op::tangent, 1},
    {"asin", Op::arcSine, 1},
    {"acos", Op::arcCosine, 1},
    {"atan", Op::arcTangent, 1},
    {"atan2", Op::arcTangent2, 2},
    {"hypot", Op::hypotenuse, 2},
    {"floor", Op::roundDown, 1},
    {"ceil", Op::roundUp, 1},
    {"min", Op::minimum, kTwoOrMore},
    {"max", Op::maximum, kTwoOrMore},
}};

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Letters, and every byte of a letter beyond ASCII.
bool startsName(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}

bool continuesName(char c) {
    return startsName(c) || isDigit(c) || c == '.';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

std::string functionNames() {
    std::string names;
    for (const Function& function : kFunctions)
        names += (names.empty() ? "" : " ") + std::string(function.name);
    return names;
}

}  // namespace

/// Recursive descent; every function reads one rule of the grammar and appends its steps.
class ExpressionParser {
  public:
    ExpressionParser(std::string_view text, const std::string& place, std::size_t columnsBefore,
                     Expression& out)
        : text_(text), place_(place), columnsBefore_(columnsBefore), out_(out) {}

    void parse() {
        sum();
        skipBlanks();
        if (at_ < text_.size()) fail(std::string("expected an operator, not '") + text_[at_] + "'");
    }

  private:
    [[noreturn]] void failAt(std::size_t at, const std::string& what) const {
        throw Error(what, place_ + ", column " + std::to_string(columnsBefore_ + at + 1),
                    "the expression is '" + std::string(text_) + "'");
    }
    [[noreturn]] void fail(const std::string& what) const { failAt(at_, what); }

    void skipBlanks() {
        while (at_ < text_.size() && isBlank(text_[at_])) ++at_;
    }

    /// Takes `c` where it comes next.
    bool take(char c) {
        skipBlanks();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    void push(Expression::Step step) {
        const bool operand = step.op == Op::number || step.op == Op::variable;
        if (operand) {
            out_.stackDepth_ = std::max(out_.stackDepth_, ++depth_);
        } else if (isBinary(step.op)) {
            --depth_;
        }
        out_.steps_.push_back(step);
    }

    static bool isBinary(Op op) {
        constexpr std::array kBinary = {Op::add,         Op::subtract,   Op::multiply, Op::divide, Op::power,
                                        Op::arcTangent2, Op::hypotenuse, Op::minimum,  Op::maximum};
        return std::ranges::find(kBinary, op) != kBinary.end();
    }

    void sum() {
        if (++nesting_ > kDeepest) fail("nested more than " + std::to_string(kDeepest) + " deep");
        product();
        for (;;) {
            if (take('+')) {
                product();
                push({.op = Op::add});
            } else if (take('-')) {
                product();
                push({.op = Op::subtract});
            } else {
                break;
            }
        }
        --nesting_;
    }

    void product() {
        signedPower();
        for (;;) {
            if (take('*')) {
                signedPower();
                push({.op = Op::multiply});
            } else if (take('/')) {
                signedPower();
                push({.op = Op::divide});
            } else {
                break;
            }
        }
    }

    void signedPower() {
        bool negative = false;
        for (;;) {
            if (take('-'))
                negative = !negative;
            else if (!take('+'))
                break;
        }
        power();
        if (negative) push({.op = Op::negate});
    }

    void power() {
        primary();
        if (!take('^')) return;
        if (++nesting_ > kDeepest) fail("nested more than " + std::to_string(kDeepest) + " deep");
        signedPower();
        --nesting_;
        push({.op = Op::power});
    }

    void primary() {
        skipBlanks();
        if (at_ == text_.size())
            fail("expected a number, a variable or a parenthesis, but the expression ends");
        const char c = text_[at_];
        if (isDigit(c) || c == '.') return number();
        if (c == '`') return quotedName();
        if (startsName(c)) return nameOrFunction();
        if (!take('(')) fail(std::string("expected a number, a variable or a parenthesis, not '") + c + "'");
        const std::size_t open = at_ - 1;
        sum();
        if (!take(')')) {
            if (at_ == text_.size()) failAt(open, "the parenthesis that opens here is never closed");
            fail(std::string("expected an operator or ')', not '") + text_[at_] + "'");
        }
    }

    void number() {
        double value = 0;
        const char* begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error == std::errc::result_out_of_range) fail("the number does not fit double precision");
        if (error != std::errc{}) fail("this is no number");
        const std::size_t after = at_ + static_cast<std::size_t>(end - begin);
        if (after < text_.size() && continuesName(text_[after]))
            failAt(after, "the number goes on with a letter or dot");
        at_ = after;
        push({.op = Op::number, .number = value});
    }

    void quotedName() {
        const std::size_t close = text_.find('`', at_ + 1);
        if (close == std::string_view::npos) fail("the back quote that opens here is never closed");
        if (close == at_ + 1) fail("the name between the back quotes is empty");
        variable(text_.substr(at_ + 1, close - at_ - 1));
        at_ = close + 1;
    }

    void nameOrFunction() {
        const std::size_t begin = at_;
        std::size_t end = at_;
        while (end < text_.size() && continuesName(text_[end])) ++end;
        const std::string_view name = text_.substr(begin, end - begin);
        std::size_t next = end;
        while (next < text_.size() && isBlank(text_[next])) ++next;
        if (next < text_.size() && text_[next] == '(') {
            at_ = next + 1;
            return call(name, begin, next);
        }
        if (name == "pi")
            push({.op = Op::number, .number = std::numbers::pi});
        else
            variable(name);
        at_ = end;
    }

    void call(std::string_view name, std::size_t begin, std::size_t open) {
        const auto function = std::ranges::find(kFunctions, name, &Function::name);
        if (function == kFunctions.end())
            failAt(begin, "there is no function '" + std::string(name) + "', but " + functionNames());
        std::size_t arguments = 0;
        do {
            sum();
            if (++arguments >= 2 && function->arguments == kTwoOrMore) push({.op = function->op});
        } while (take(','));
        if (!take(')')) {
            if (at_ == text_.size()) failAt(open, "the parenthesis that opens here is never closed");
            fail(std::string("expected ',' or ')', not '") + text_[at_] + "'");
        }
        const bool fits =
            function->arguments == kTwoOrMore ? arguments >= 2 : arguments == function->arguments;
        if (!fits) {
            const std::string wanted =
                function->arguments == kTwoOrMore ? "two or more" : std::to_string(function->arguments);
            failAt(begin, "the function '" + std::string(name) + "' takes " + wanted + " arguments, not " +
                              std::to_string(arguments));
        }
        if (function->arguments != kTwoOrMore) push({.op = function->op});
    }

    void variable(std::string_view name) {
        const auto found = std::ranges::find(out_.names_, name, &Expression::Name::text);
        const auto index = static_cast<std::size_t>(found - out_.names_.begin());
        if (found == out_.names_.end()) out_.names_.push_back({std::string(name), columnsBefore_ + at_ + 1});
        push({.op = Op::variable, .variable = index});
    }

    std::string_view text_;
    const std::string& place_;
    std::size_t columnsBefore_;
    Expression& out_;
    std::size_t at_ = 0;     ///< next byte of the text
    std::size_t depth_ = 0;  ///< rows on the stack after the steps so far
    int nesting_ = 0;
};

Expression::Expression(std::string_view text, const std::string& place, std::size_t columnsBefore) {
    ExpressionParser(text, place, columnsBefore, *this).parse();
}

NamedExpression splitNamedExpression(std::string_view text, const std::string& place) {
    NamedExpression result;
    const std::size_t equals = text.find('=');
    std::string_view expression = text;
    if (equals != std::string_view::npos) {
        const std::string_view name = trimmed(text.substr(0, equals));
        if (name.empty() || !startsName(name.front()) || !std::ranges::all_of(name, continuesName))
            throw Error("what stands before the equals sign is no name", place + ", column 1",
                        "write NAME = EXPRESSION, such as speed = sqrt(U^2 + V^2)");
        result.name = name;
        expression.remove_prefix(equals + 1);
    }
    expression = trimmed(expression);
    result.expression = expression;
    result.columnsBefore = static_cast<std::size_t>(expression.data() - text.data());
    return result;
}

}  // namespace isoglass
