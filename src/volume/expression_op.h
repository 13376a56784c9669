#pragma once

#include <cstdint>

// Private to the room.

namespace isoglass {

/// What a step of an expression does.
enum class ExpressionOp : std::uint8_t {
    number,
    variable,
    negate,
    add,
    subtract,
    multiply,
    divide,
    power,
    squareRoot,
    absolute,
    exponential,
    logarithm,
    logarithm10,
    sine,
    cosine,
    tangent,
    arcSine,
    arcCosine,
    arcTangent,
    arcTangent2,
    hypotenuse,
    roundDown,
    roundUp,
    minimum,
    maximum,
};

}  // namespace isoglass
