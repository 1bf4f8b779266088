#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nurbeam {

/// What is wrong with an expression, and where: `offset` bytes from its start.
struct ExpressionError : std::runtime_error {
  ExpressionError(const std::string& what, std::size_t at) : std::runtime_error(what), offset(at) {}
  std::size_t offset;
};

/// Whether a time is between the first and the last one, but for round-off.
bool is_between(double time, double first, double last);

/// One number, or one for each stored time of a run.
using ExpressionValue = std::variant<double, std::vector<double>>;

/// What the names of an expression stand for.
struct ExpressionScope {
  /// The value of a variable or of a column ("trolley.speed"). Throws std::invalid_argument for one that is
  /// not known.
  std::function<ExpressionValue(const std::string& name)> value;
  /// The first time [s] of an event of that kind of that body or beam, NaN where there is none; empty where
  /// there are no events.
  std::function<double(const std::string& kind, const std::string& of)> event_time = {};
  /// The stored times [s], increasing; empty where there are none.
  std::vector<double> times = {};
  /// The error of mesh and step of a number, which `of` gives of other runs too; empty where it is not known.
  std::function<double(double number, const std::function<double(const ExpressionScope&)>& of)> error_of = {};
};

/// A formula over numbers and histories, as studies have them: + - * / ^, comparisons (1 or 0), the functions
/// abs, sqrt, exp, log, sin, cos, tan, atan2, hypot, or (the first argument where it is a number, else the
/// second), and of histories min, max, first, last, mean, rms (weighted by time), integral and at(t, history)
/// with t a number, start or end, and time(kind, body). passes(history, value) is the first time at which a
/// history comes to a value; error(number) is its error of mesh and step. A name is a column, NAME.QUANTITY,
/// or a variable; parts that are no words stand in single quotes: 'body 1'.speed.
class Expression {
 public:
  /// Throws ExpressionError.
  static Expression parse(const std::string& text);

  /// Throws std::invalid_argument where a name is not known, or a history stands where a number must.
  ExpressionValue evaluate(const ExpressionScope& scope) const;
  /// The same of an expression that must be one number.
  double number(const ExpressionScope& scope) const;

  /// The variables and columns that it names, each once.
  std::vector<std::string> names() const;
  /// Whether it has error(...).
  bool asks_for_errors() const;
  /// The times at which it asks for histories, of those that depend on nothing.
  std::vector<double> times() const;
  /// Of a comparison of two sides: what must be greater, and the other; nothing of another expression.
  std::optional<std::pair<Expression, Expression>> sides() const;
  const std::string& text() const { return text_; }

  struct Node;

 private:
  Expression(std::string text, std::shared_ptr<const Node> root)
      : text_(std::move(text)), root_(std::move(root)) {}

  std::string text_;
  std::shared_ptr<const Node> root_;
};

}  // namespace nurbeam
