#include "sim/scene/expression.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/scene/json.h"

namespace curlew {
namespace {

constexpr int deepest = 64;  // of parentheses, signs and powers: each holds three numbers on the stack at most

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

}  // namespace

// Recursive descent: sum = product {+- product}, product = signed {*/ signed}, signed = {+-} power,
// power = atom [^ signed].
class ExpressionParser {
 public:
  using Op = Expression::Op;

  ExpressionParser(std::string_view text, int dimension, const std::string& place, Expression& out)
      : text_(text), dimension_(dimension), place_(place), out_(out) {}

  void parse() {
    sum();
    if (peek() != '\0') fail("an operator or the end");
  }

 private:
  void sum() {
    product();
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      ++at_;
      product();
      emit(c == '+' ? Op::add : Op::subtract);
    }
  }

  void product() {
    with_sign();
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      ++at_;
      with_sign();
      emit(c == '*' ? Op::multiply : Op::divide);
    }
  }

  void with_sign() {
    if (++depth_ > deepest) fail("a formula nested less than " + std::to_string(deepest) + " deep");
    const char c = peek();
    if (c == '+' || c == '-') {
      ++at_;
      with_sign();
      if (c == '-') emit(Op::negate);
    } else {
      atom();
      if (peek() == '^') {
        ++at_;
        with_sign();
        emit(Op::power);
      }
    }
    --depth_;
  }

  void atom() {
    const char c = peek();
    if (c == '(') {
      ++at_;
      sum();
      take(')');
    } else if ((c >= '0' && c <= '9') || c == '.') {
      number();
    } else if (is_letter(c)) {
      name();
    } else {
      fail("a number, x, z, pi, a function or (");
    }
  }

  void number() {
    double value = 0;
    const auto [end, status] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (status != std::errc()) fail("a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    out_.program_.push_back({Op::number, value});
  }

  void name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    if (word == "x") return emit(Op::x);
    if (word == "z" && dimension_ == 3) return emit(Op::z);
    if (word == "pi") return out_.program_.push_back({Op::number, std::numbers::pi});
    for (const auto& [function, op, arguments] : functions) {
      if (word != function) continue;
      take('(');
      sum();
      if (arguments == 2) {
        take(',');
        sum();
      }
      take(')');
      return emit(op);
    }
    at_ = begin;
    if (word == "z") fail("x alone, because the scene has 2 dimensions");
    fail("x, z, pi, sin, cos, exp, sqrt, abs, min or max");
  }

  void emit(Op op) { out_.program_.push_back({op, 0}); }

  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  void take(char c) {
    if (peek() != c) fail(std::string(1, c));
    ++at_;
  }

  [[noreturn]] void fail(const std::string& expected) {
    peek();
    std::size_t end = at_;
    while (end < text_.size() && is_letter(text_[end])) ++end;
    const std::string found =
        at_ == text_.size() ? "the end" : in_quotes(text_.substr(at_, std::max(end, at_ + 1) - at_));
    throw InputError(place_ + ": column " + std::to_string(at_ + 1) + ": found " + found + ", expected " + expected);
  }

  struct Function {
    std::string_view name;
    Op op;
    int arguments;
  };
  static constexpr Function functions[] = {{"sin", Op::sin, 1},   {"cos", Op::cos, 1}, {"exp", Op::exp, 1},
                                           {"sqrt", Op::sqrt, 1}, {"abs", Op::abs, 1}, {"min", Op::min, 2},
                                           {"max", Op::max, 2}};

  std::string_view text_;
  int dimension_;
  const std::string& place_;
  Expression& out_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(std::string_view text, int dimension, const std::string& place) {
  ExpressionParser(text, dimension, place, *this).parse();
}

double Expression::operator()(double x, double z) const {
  std::array<double, 3 * deepest + 4> stack;
  std::size_t top = 0;  // numbers on the stack
  for (const auto& [op, value] : program_) {
    switch (op) {
      case Op::number:
        stack[top++] = value;
        continue;
      case Op::x:
        stack[top++] = x;
        continue;
      case Op::z:
        stack[top++] = z;
        continue;
      default:
        break;
    }
    if (op >= Op::negate && op <= Op::abs) {
      double& a = stack[top - 1];
      a = op == Op::negate ? -a
          : op == Op::sin  ? std::sin(a)
          : op == Op::cos  ? std::cos(a)
          : op == Op::exp  ? std::exp(a)
          : op == Op::sqrt ? std::sqrt(a)
                           : std::abs(a);
      continue;
    }
    const double b = stack[--top];
    double& a = stack[top - 1];
    a = op == Op::add        ? a + b
        : op == Op::subtract ? a - b
        : op == Op::multiply ? a * b
        : op == Op::divide   ? a / b
        : op == Op::power    ? std::pow(a, b)
        : op == Op::min      ? std::min(a, b)
                             : std::max(a, b);
  }
  return stack[0];
}

}  // namespace curlew
