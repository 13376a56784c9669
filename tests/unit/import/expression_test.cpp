#include "volume/expression.h"

#include "unit/import/import_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace isoglass {
namespace {

using test::failsWith;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// The value for one sample of each variable.
float valueOf(const std::string& text, const std::map<std::string, float>& variables = {}) {
    const Expression expression(text, "test");
    std::vector<std::vector<float>> samples;
    std::vector<std::span<const float>> operands;
    for (const Expression::Name& name : expression.names()) samples.push_back({variables.at(name.text)});
    for (const auto& sample : samples) operands.emplace_back(sample);
    std::vector<float> result(1);
    expression.evaluate(operands, result);
    return result[0];
}

testing::AssertionResult refused(const std::string& text, std::initializer_list<std::string_view> words) {
    return failsWith([&] { Expression(text, "file.nc, --variable"); }, words);
}

TEST(Expression, OperatorsBindAsInMathematics) {
    const std::map<std::string, float> values = {{"a", 2}, {"b", 3}, {"c", 5}};
    const std::pair<const char*, float> cases[] = {{"1 + 2 * 3", 7},
                                                   {"(1 + 2) * 3", 9},
                                                   {"8 - 4 - 2", 2},
                                                   {"16 / 4 / 2", 2},
                                                   {"2^3^2", 512},
                                                   {"-2^2", -4},
                                                   {"(-2)^2", 4},
                                                   {"2^-1", 0.5f},
                                                   {"2 * -3", -6},
                                                   {"1 - -1", 2},
                                                   {"--3", 3},
                                                   {"-+-3", 3},
                                                   {"2 * 3^2", 18},
                                                   {"a*b + c", 11},
                                                   {"a*(b + c)", 16},
                                                   {"-a^b", -8},
                                                   {"a - b * c / a", -5.5f},
                                                   {"6 / 2 * 3", 9},
                                                   {"1e3 + .5 + 2.", 1002.5f},
                                                   {"2.5e-1*4", 1}};
    for (const auto& [text, wanted] : cases) EXPECT_EQ(valueOf(text, values), wanted) << text;
}

TEST(Expression, FunctionsAreThoseOfMathematics) {
    const std::pair<const char*, double> cases[] = {{"sqrt(9)", 3},
                                                    {"abs(-4)", 4},
                                                    {"exp(1)", std::numbers::e},
                                                    {"log(exp(2))", 2},
                                                    {"log10(1000)", 3},
                                                    {"sin(pi/2)", 1},
                                                    {"cos(pi)", -1},
                                                    {"tan(pi/4)", 1},
                                                    {"asin(1)", std::numbers::pi / 2},
                                                    {"acos(1)", 0},
                                                    {"atan(1)", std::numbers::pi / 4},
                                                    {"atan2(1, -1)", 3 * std::numbers::pi / 4},
                                                    {"hypot(3, 4)", 5},
                                                    {"floor(-1.5)", -2},
                                                    {"ceil(-1.5)", -1},
                                                    {"min(3, 1, 2)", 1},
                                                    {"max(3, 1, 7, 2)", 7},
                                                    {"max(1, min(5, 3))", 3}};
    // Double precision, rounded to float once.
    for (const auto& [text, wanted] : cases)
        EXPECT_FLOAT_EQ(valueOf(text), static_cast<float>(wanted)) << text;
}

TEST(Expression, NamesAreListedOnceWithTheirColumns) {
    const Expression expression("sqrt(U^2 + V.x^2) + U*`air-temp, 2 m` + pi", "test");
    ASSERT_EQ(expression.names().size(), 3u);
    EXPECT_EQ(expression.names()[0].text, "U");
    EXPECT_EQ(expression.names()[0].column, 6u);
    EXPECT_EQ(expression.names()[1].text, "V.x");
    EXPECT_EQ(expression.names()[1].column, 12u);
    EXPECT_EQ(expression.names()[2].text, "air-temp, 2 m");
    EXPECT_EQ(expression.names()[2].column, 23u);
    EXPECT_FALSE(expression.isName());
    EXPECT_TRUE(Expression(" ( U ) ", "test").isName());
    EXPECT_FALSE(Expression("-U", "test").isName());
    // Quotes make a variable of what would be a constant.
    EXPECT_EQ(valueOf("`pi`", {{"pi", 3}}), 3);
}

TEST(Expression, ErrorsNameTheColumnAndTheText) {
    EXPECT_TRUE(refused("", {"expression ends", "column 1"}));
    EXPECT_TRUE(refused("1 +", {"expression ends", "column 4", "'1 +'", "file.nc, --variable"}));
    EXPECT_TRUE(refused("sqrt(U^2", {"opens here is never closed", "column 5"}));
    EXPECT_TRUE(refused("2*(3+(4-5)", {"opens here is never closed", "column 3"}));
    EXPECT_TRUE(refused("(1 2)", {"expected an operator or ')', not '2'", "column 4"}));
    EXPECT_TRUE(refused("U V", {"expected an operator, not 'V'", "column 3"}));
    EXPECT_TRUE(refused("U)", {"not ')'", "column 2"}));
    EXPECT_TRUE(refused("U * * V", {"not '*'", "column 5"}));
    EXPECT_TRUE(refused("U $ V", {"not '$'", "column 3"}));
    EXPECT_TRUE(refused("foo(U)", {"no function 'foo'", "column 1", "hypot"}));
    EXPECT_TRUE(refused("1 + sqrt(U, V)", {"'sqrt' takes 1 arguments, not 2", "column 5"}));
    EXPECT_TRUE(refused("atan2(U)", {"takes 2 arguments, not 1", "column 1"}));
    EXPECT_TRUE(refused("min(U)", {"two or more", "not 1"}));
    EXPECT_TRUE(refused("min()", {"not ')'", "column 5"}));
    EXPECT_TRUE(refused("3x", {"goes on", "column 2"}));
    EXPECT_TRUE(refused("1.2.3", {"goes on", "column 4"}));
    EXPECT_TRUE(refused("1e999", {"does not fit", "column 1"}));
    EXPECT_TRUE(refused(".", {"no number", "column 1"}));
    EXPECT_TRUE(refused("`U", {"never closed", "column 1"}));
    EXPECT_TRUE(refused("1 + ``", {"empty", "column 5"}));
    EXPECT_TRUE(refused(std::string(100000, '('), {"nested more than"}));
    EXPECT_TRUE(refused("2" + std::string(1000, '^'), {"not '^'"}));
}

TEST(Expression, DeepButSaneNestingIsEvaluated) {
    EXPECT_EQ(valueOf(std::string(150, '(') + "7" + std::string(150, ')')), 7);
    std::string powers = "1";
    for (int i = 0; i < 100; ++i) powers += "^1";
    EXPECT_EQ(valueOf(powers), 1);
    EXPECT_EQ(valueOf(std::string(100001, '-') + "7"), -7);
}

TEST(Expression, MissingOperandsMakeMissingResults) {
    for (const char* text :
         {"U + V", "min(U, V)", "max(V, U)", "V^0 + U", "0*U + V", "hypot(U, V)", "U - U + V"}) {
        EXPECT_TRUE(std::isnan(valueOf(text, {{"U", 1}, {"V", kMissing}}))) << text;
        EXPECT_FALSE(std::isnan(valueOf(text, {{"U", 1}, {"V", 2}}))) << text;
    }
}

TEST(Expression, ResultsThatAreNoNumbersAreMissing) {
    for (const char* text : {"1/U", "log(U)", "sqrt(U - 1)", "-1/U", "1e30*1e30 + U", "acos(2 + U)"}) {
        EXPECT_TRUE(std::isnan(valueOf(text, {{"U", 0}}))) << text;
    }
    // In between, doubles hold what floats would not.
    EXPECT_EQ(valueOf("U*1e30*1e30/1e60", {{"U", 4}}), 4);
}

TEST(Expression, RowsOfAnyLengthAreEvaluatedSampleBySample) {
    const Expression expression("sqrt(U^2 + V^2) - min(U, V)/2", "test");
    for (const std::size_t count : {1u, 255u, 256u, 257u, 1000u, 40'000u}) {
        std::vector<float> u(count);
        std::vector<float> v(count);
        for (std::size_t i = 0; i < count; ++i) {
            u[i] = static_cast<float>(i) - 3;
            v[i] = i % 7 == 3 ? kMissing : static_cast<float>(i % 10);
        }
        std::vector<float> result(count, -1);
        expression.evaluate(std::vector<std::span<const float>>{u, v}, result);
        std::vector<float> inPlace = u;
        expression.evaluate(std::vector<std::span<const float>>{inPlace, v}, inPlace);
        for (std::size_t i = 0; i < count; ++i) {
            const double x = u[i];
            const double y = v[i];
            const auto wanted = static_cast<float>(std::sqrt(x * x + y * y) - std::min(x, y) / 2);
            if (std::isnan(v[i])) {
                ASSERT_TRUE(std::isnan(result[i]) && std::isnan(inPlace[i])) << i;
            } else {
                // pow(x, 2) may differ from x * x by an ulp of a double, far below one of a float.
                ASSERT_FLOAT_EQ(result[i], wanted) << i;
                ASSERT_EQ(inPlace[i], result[i]) << i;
            }
        }
    }
}

TEST(NamedExpression, IsSplitAtTheEqualsSign) {
    const NamedExpression named = splitNamedExpression(" speed =  sqrt(U) ", "test");
    EXPECT_EQ(named.name, "speed");
    EXPECT_EQ(named.expression, "sqrt(U)");
    EXPECT_EQ(named.columnsBefore, 10u);
    EXPECT_EQ(splitNamedExpression("U + V ", "test").name, "");
    EXPECT_EQ(splitNamedExpression("U + V ", "test").expression, "U + V");
    for (const char* text : {"= U", "2 = U", "a b = U", "sqrt(U) = V"}) {
        EXPECT_TRUE(failsWith([&] { splitNamedExpression(text, "--variable"); },
                              {"before the equals sign", "--variable, column 1"}))
            << text;
    }
}

}  // namespace
}  // namespace isoglass
