// Formulas of x and z for heightfields, such as "0.2 + 0.05*cos(2*pi*x)".
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace curlew {

// Numbers, x, z, pi, + - * / ^, parentheses, and sin cos exp sqrt abs (one argument) and min max (two).
class Expression {
 public:
  // Throws InputError with the column where the text is not a formula; `place` begins the message. In 2D there is no z.
  Expression(std::string_view text, int dimension, const std::string& place);

  double operator()(double x, double z) const;

 private:
  friend class ExpressionParser;
  enum class Op { number, x, z, add, subtract, multiply, divide, power, negate, sin, cos, exp, sqrt, abs, min, max };
  struct Instruction {
    Op op;
    double value;
  };
  std::vector<Instruction> program_;  // in reverse Polish order
};

}  // namespace curlew
