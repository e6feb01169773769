// Formulas: values, precedence, errors with their column.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/error.h"
#include "sim/scene/expression.h"

using namespace curlew;

namespace {

double value(const std::string& text, double x = 0, double z = 0) { return Expression(text, 3, "f")(x, z); }

}  // namespace

TEST_CASE("formulas have their values", "[shapes]") {
  CHECK(value("1 + 2*3") == 7);
  CHECK(value("(1 + 2)*3") == 9);
  CHECK(value("8/4/2") == 1);
  CHECK(value("8 - 4 - 2") == 2);
  CHECK(value("2^3^2") == 512);
  CHECK(value("-2^2") == -4);
  CHECK(value("2^-1") == 0.5);
  CHECK(value("--3") == 3);
  CHECK(value("x*z", 3, 4) == 12);
  CHECK(value("1e-3 + .5") == 0.501);
  CHECK(value("cos(2*pi*x)", 0.5) == Approx(-1));
  CHECK(value("min(x, z) + 10*max(x, z)", 1, 2) == 21);
  CHECK(value("abs(sqrt(4) - exp(0) - sin(0) - 5)") == 4);
  CHECK(value(std::string(30, '(') + "x" + std::string(30, ')'), 7) == 7);
}

TEST_CASE("wrong formulas say where", "[shapes]") {
  const auto check = [](const std::string& text, const std::string& message, int dimension = 3) {
    CHECK_THROWS_WITH(Expression(text, dimension, "f"), message);
  };
  check("", "f: column 1: found the end, expected a number, x, z, pi, a function or (");
  check("1 +", "f: column 4: found the end, expected a number, x, z, pi, a function or (");
  check("1 2", "f: column 3: found \"2\", expected an operator or the end");
  check("(1", "f: column 3: found the end, expected )");
  check("sin x", "f: column 5: found \"x\", expected (");
  check("min(1)", "f: column 6: found \")\", expected ,");
  check("y", "f: column 1: found \"y\", expected x, z, pi, sin, cos, exp, sqrt, abs, min or max");
  check("x + z", "f: column 5: found \"z\", expected x alone, because the scene has 2 dimensions", 2);
  check("1 + $", "f: column 5: found \"$\", expected a number, x, z, pi, a function or (");
  check(".", "f: column 1: found \".\", expected a number");
  CHECK_THROWS_AS(Expression(std::string(100000, '('), 3, "f"), InputError);
  CHECK_THROWS_AS(Expression(std::string(100000, '-'), 3, "f"), InputError);
  std::string powers = "x";
  for (int i = 0; i < 1000; ++i) powers += "^x";
  CHECK_THROWS_AS(Expression(powers, 3, "f"), InputError);
}

TEST_CASE("the deepest formula that is allowed does not overrun the stack", "[shapes]") {
  std::string text;
  for (int i = 0; i < 20; ++i) text += "1+1*2^min(1,";
  text += "x" + std::string(20, ')');
  CHECK(std::isfinite(value(text, 1)));
}
