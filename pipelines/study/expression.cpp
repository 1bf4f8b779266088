#include "pipelines/study/expression.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/utf8_text.h"

namespace nurbeam {

namespace {

const ExpressionScope nothing_known{.value = [](const std::string& name) -> ExpressionValue {
  throw std::invalid_argument(in_quotes(name) + " is not known");
}};

}  // namespace

/// An operation on its arguments, or a leaf: a number or a name.
struct Expression::Node {
  using Arguments = std::vector<std::shared_ptr<const Node>>;
  /// Of the evaluated arguments.
  using Operation =
      std::function<ExpressionValue(const std::vector<ExpressionValue>&, const ExpressionScope&)>;

  Operation operation = {};
  Arguments arguments = {};
  double number = 0;
  std::string name = {};  ///< of a leaf that is no number
  bool is_error = false;
  bool at_time = false;  ///< the first argument is the time at which a history is asked for
  enum class Comparison { none, less, greater } comparison = Comparison::none;  ///< of the first argument

  ExpressionValue evaluate(const ExpressionScope& scope) const {
    if (!name.empty()) return scope.value(name);
    if (!operation) return number;
    std::vector<ExpressionValue> values;
    for (const auto& argument : arguments) values.push_back(argument->evaluate(scope));
    return operation(values, scope);
  }
  void collect(std::vector<std::string>& names) const {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    for (const auto& argument : arguments) argument->collect(names);
  }
  bool has_error() const {
    return is_error || std::ranges::any_of(
                           arguments, [](const auto& each) { return each->has_error(); });
  }
  void collect(std::vector<double>& times) const {
    if (at_time) try {
        times.push_back(std::get<double>(arguments[0]->evaluate(nothing_known)));
      } catch (const std::invalid_argument&) {  // it depends on a variable or an event
      }
    for (const auto& argument : arguments) argument->collect(times);
  }
};

namespace {

using Node = Expression::Node;
using NodePointer = std::shared_ptr<const Node>;
using Values = std::vector<ExpressionValue>;
using Series = std::vector<double>;

// ---- Operations ----

/// f of numbers; of histories time by time, where numbers count for all times.
template <class Function>
Node::Operation by_time(Function f) {
  return [f](const Values& values, const ExpressionScope&) -> ExpressionValue {
    std::size_t size = 0;
    bool series = false;
    for (const ExpressionValue& value : values)
      if (const auto* each = std::get_if<Series>(&value)) {
        if (series && each->size() != size)
          throw std::invalid_argument("histories of different lengths are combined");
        size = each->size();
        series = true;
      }
    const auto at = [&](std::size_t argument, std::size_t i) {
      const auto* each = std::get_if<Series>(&values[argument]);
      return each ? (*each)[i] : std::get<double>(values[argument]);
    };
    const auto call = [&](std::size_t i) {
      if constexpr (std::is_invocable_v<Function, double, double>)
        return static_cast<double>(f(at(0, i), at(1, i)));
      else
        return static_cast<double>(f(at(0, i)));
    };
    if (!series) return call(0);
    Series result(size);
    for (std::size_t i = 0; i < size; ++i) result[i] = call(i);
    return result;
  };
}

const Series& history(const ExpressionValue& value, const char* function) {
  if (const auto* series = std::get_if<Series>(&value)) {
    if (series->empty()) throw std::invalid_argument("the run has stored no times");
    return *series;
  }
  throw std::invalid_argument(std::string(function) +
                              " needs a history (a column such as trolley.x), not one number");
}

/// int f dt by the trapezoidal rule.
double integral_of(const Series& f, const Series& times) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < f.size(); ++i) sum += (f[i] + f[i + 1]) / 2 * (times[i + 1] - times[i]);
  return sum;
}

double mean_of(const Series& f, const Series& times) {
  const double duration = times.back() - times.front();
  return f.size() > 1 && duration > 0 ? integral_of(f, times) / duration : f.front();
}

/// Between two stored times the value is linear.
double at_time(double t, const Series& f, const Series& times) {
  if (!is_between(t, times.front(), times.back())) return std::numeric_limits<double>::quiet_NaN();
  const auto after = std::upper_bound(times.begin(), times.end(), t);
  const std::size_t i =
      std::clamp<std::ptrdiff_t>(after - times.begin() - 1, 0, static_cast<std::ptrdiff_t>(f.size()) - 1);
  if (i + 1 >= f.size()) return f.back();
  const double part = std::clamp((t - times[i]) / (times[i + 1] - times[i]), 0.0, 1.0);
  return (1 - part) * f[i] + part * f[i + 1];
}

/// The first time at which a history comes to a value, from below or from above; NaN where it never does.
double first_passing(const Series& f, double value, const Series& times) {
  if (f.front() == value) return times.front();
  for (std::size_t i = 0; i + 1 < f.size(); ++i) {
    const double before = f[i] - value, after = f[i + 1] - value;
    if (after == 0 || before * after < 0)
      return times[i] + before / (before - after) * (times[i + 1] - times[i]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

ExpressionValue passing(const Values& values, const ExpressionScope& scope) {
  const Series& f = history(values[0], "passes");
  const auto* value = std::get_if<double>(&values[1]);
  if (!value) throw std::invalid_argument("the value of passes(history, value) must be one number");
  return first_passing(f, *value, scope.times);
}

/// A function of one history and the stored times.
template <class Function>
Node::Operation of_history(const char* name, Function f) {
  return [name, f](const Values& values, const ExpressionScope& scope) -> ExpressionValue {
    return f(history(values[0], name), scope.times);
  };
}

struct NamedFunction {
  std::string name;
  std::size_t arguments;
  Node::Operation operation;
};

const std::vector<NamedFunction>& functions() {
  static const std::vector<NamedFunction> all = {
      {"abs", 1, by_time([](double x) { return std::abs(x); })},
      {"sqrt", 1, by_time([](double x) { return std::sqrt(x); })},
      {"exp", 1, by_time([](double x) { return std::exp(x); })},
      {"log", 1, by_time([](double x) { return std::log(x); })},
      {"sin", 1, by_time([](double x) { return std::sin(x); })},
      {"cos", 1, by_time([](double x) { return std::cos(x); })},
      {"tan", 1, by_time([](double x) { return std::tan(x); })},
      {"atan2", 2, by_time([](double y, double x) { return std::atan2(y, x); })},
      {"hypot", 2, by_time([](double x, double y) { return std::hypot(x, y); })},
      {"min", 1,
       of_history("min",
                  [](const Series& f, const Series&) { return *std::min_element(f.begin(), f.end()); })},
      {"max", 1,
       of_history("max",
                  [](const Series& f, const Series&) { return *std::max_element(f.begin(), f.end()); })},
      {"min", 2, by_time([](double x, double y) { return std::min(x, y); })},
      {"max", 2, by_time([](double x, double y) { return std::max(x, y); })},
      {"or", 2, by_time([](double x, double y) { return std::isnan(x) ? y : x; })},
      {"first", 1, of_history("first", [](const Series& f, const Series&) { return f.front(); })},
      {"last", 1, of_history("last", [](const Series& f, const Series&) { return f.back(); })},
      {"mean", 1, of_history("mean", &mean_of)},
      {"rms", 1,
       of_history("rms",
                  [](Series f, const Series& times) {
                    for (double& x : f) x *= x;
                    return std::sqrt(mean_of(f, times));
                  })},
      {"integral", 1, of_history("integral", &integral_of)},
      {"passes", 2, &passing},
  };
  return all;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names = {"at", "time", "error"};
  for (const NamedFunction& f : functions())
    if (std::find(names.begin(), names.end(), f.name) == names.end()) names.push_back(f.name);
  return names;
}

// ---- Parser ----

bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_word(char c) { return begins_word(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// By recursive descent: comparison, sum, product, sign, power, primary.
class ExpressionParser {
 public:
  explicit ExpressionParser(const std::string& text) : text_(text) {}

  NodePointer parse() {
    NodePointer root = comparison();
    skip();
    if (at_ < text_.size())
      fail("expected an operator or the end, found " + rest(12) +
           (begins_word(text_[at_]) ? "; a name with spaces stands in single quotes" : ""));
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ExpressionError(what, at_); }
  /// So many characters of what has not been read, in quotes.
  std::string rest(std::size_t most) const { return in_quotes(first_characters(text_.substr(at_), most)); }

  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool accept(const std::string& token) {
    skip();
    if (text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }
  void expect(const std::string& token) {
    if (!accept(token)) fail("expected \"" + token + "\"" + (at_ < text_.size() ? "" : ", found the end"));
  }

  /// Brackets and signs are read recursively.
  struct Level {
    explicit Level(ExpressionParser& of) : parser(of) {
      if (++parser.depth_ > 100) parser.fail("brackets and signs are nested more than 100 deep");
    }
    Level(const Level&) = delete;
    ~Level() { --parser.depth_; }
    ExpressionParser& parser;
  };

  // They are evaluated recursively.
  NodePointer call(Node::Operation operation, Node::Arguments arguments) {
    constexpr int most = 1000;
    if (++operations_ > most)
      fail("the expression has more than " + std::to_string(most) + " operations; shorten it");
    return std::make_shared<const Node>(
        Node{.operation = std::move(operation), .arguments = std::move(arguments)});
  }

  NodePointer compared(Node::Comparison way, bool (*holds)(double, double), NodePointer left) {
    return std::make_shared<const Node>(
        Node{.operation = by_time(holds), .arguments = {std::move(left), sum()}, .comparison = way});
  }
  NodePointer comparison() {
    const Level level(*this);
    using Way = Node::Comparison;
    NodePointer left = sum();
    if (accept("<="))
      return compared(
          Way::less, [](double x, double y) { return x <= y; }, left);
    if (accept(">="))
      return compared(
          Way::greater, [](double x, double y) { return x >= y; }, left);
    if (accept("<"))
      return compared(
          Way::less, [](double x, double y) { return x < y; }, left);
    if (accept(">"))
      return compared(
          Way::greater, [](double x, double y) { return x > y; }, left);
    return left;
  }
  NodePointer sum() {
    NodePointer left = product();
    for (;;)
      if (accept("+"))
        left = call(by_time([](double x, double y) { return x + y; }), {left, product()});
      else if (accept("-"))
        left = call(by_time([](double x, double y) { return x - y; }), {left, product()});
      else
        return left;
  }
  NodePointer product() {
    NodePointer left = sign();
    for (;;)
      if (accept("*"))
        left = call(by_time([](double x, double y) { return x * y; }), {left, sign()});
      else if (accept("/"))
        left = call(by_time([](double x, double y) { return x / y; }), {left, sign()});
      else
        return left;
  }
  NodePointer sign() {
    const Level level(*this);
    if (accept("-")) return call(by_time([](double x) { return -x; }), {sign()});
    if (accept("+")) return sign();
    NodePointer base = primary();
    if (accept("^")) return call(by_time([](double x, double y) { return std::pow(x, y); }), {base, sign()});
    return base;
  }
  NodePointer primary() {
    skip();
    if (at_ == text_.size()) fail("the expression ends where a number, a name or \"(\" is expected");
    const char c = text_[at_];
    if (accept("(")) {
      NodePointer inner = comparison();
      expect(")");
      return inner;
    }
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return number();
    if (begins_word(c) || c == '\'') return name_or_call();
    const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
    fail("expected a number, a name or \"(\", found " + rest(12) +
         (is_ascii ? "" : "; a name with other letters than a to z stands in single quotes"));
  }
  NodePointer number() {
    Node leaf;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), leaf.number);
    if (error != std::errc{}) fail("this is no number that can be held");
    at_ = static_cast<std::size_t>(end - text_.data());
    return std::make_shared<const Node>(std::move(leaf));
  }
  /// That word, and not a longer name that begins with it.
  bool accept_word(const std::string& word) {
    const std::size_t from = at_;
    if (!accept(word)) return false;
    if (at_ == text_.size() || !(in_word(text_[at_]) || text_[at_] == '.')) return true;
    at_ = from;
    return false;
  }
  std::string name_part() {
    const std::size_t from = at_;
    if (at_ < text_.size() && text_[at_] == '\'') {
      const std::size_t close = text_.find('\'', at_ + 1);
      if (close == std::string::npos) fail("the single quote is never closed");
      at_ = close + 1;
      if (close == from + 1) fail("there is nothing between the single quotes");
      return text_.substr(from + 1, close - from - 1);
    }
    if (at_ == text_.size() || !begins_word(text_[at_])) fail("expected a name");
    while (at_ < text_.size() && in_word(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }
  std::string name() {
    std::string whole = name_part();
    while (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      whole += "." + name_part();
    }
    return whole;
  }
  NodePointer name_or_call() {
    const std::size_t from = at_;
    const std::string whole = name();
    if (accept("(")) return function(whole, from);
    if (whole == "pi") return std::make_shared<const Node>(Node{.number = std::numbers::pi});
    return std::make_shared<const Node>(Node{.name = whole});
  }
  NodePointer function(const std::string& called, std::size_t from) {
    if (called == "at") return at_call();
    if (called == "time") return time_call();
    if (called == "error") return error_call();
    Node::Arguments arguments;
    if (!accept(")")) {
      do arguments.push_back(comparison());
      while (accept(","));
      expect(")");
    }
    const NamedFunction* of_that_name = nullptr;
    for (const NamedFunction& f : functions())
      if (f.name == called) {
        of_that_name = &f;
        if (f.arguments == arguments.size()) return call(f.operation, std::move(arguments));
      }
    at_ = from;
    if (!of_that_name) {
      const bool is_moment = called == "end" || called == "start";
      fail("there is no function " + in_quotes(called) +
           (is_moment
                ? "; did you mean \"at(" + called + ", ...)\", the value of a history at the " + called + "?"
                : known_names(called, function_names())));
    }
    fail(called + " takes " + std::to_string(of_that_name->arguments) + " argument(s), not " +
         std::to_string(arguments.size()));
  }
  /// at(t, history) with t a number, start or end.
  NodePointer at_call() {
    std::optional<bool> at_end;
    if (accept_word("start"))
      at_end = false;
    else if (accept_word("end"))
      at_end = true;
    Node::Arguments arguments;
    if (!at_end) arguments.push_back(comparison());
    expect(",");
    arguments.push_back(comparison());
    expect(")");
    Node node{.arguments = std::move(arguments), .at_time = !at_end};
    node.operation = [at_end](const Values& values, const ExpressionScope& scope) -> ExpressionValue {
      const Series& f = history(values.back(), "at");
      if (at_end) return *at_end ? f.back() : f.front();
      const auto* t = std::get_if<double>(&values[0]);
      if (!t) throw std::invalid_argument("the time of at(time, history) must be one number");
      return at_time(*t, f, scope.times);
    };
    return std::make_shared<const Node>(std::move(node));
  }
  /// error(number): of its mesh and step.
  NodePointer error_call() {
    const NodePointer number = comparison();
    expect(")");
    Node node{.arguments = {number}, .is_error = true};
    node.operation = [number](const Values& values, const ExpressionScope& scope) -> ExpressionValue {
      const auto one = [](const ExpressionValue& value) {
        if (const auto* found = std::get_if<double>(&value)) return *found;
        throw std::invalid_argument("error(...) is that of one number, as error(max(trolley.speed))");
      };
      const double own = one(values[0]);
      if (!scope.error_of) throw std::invalid_argument("error(...) needs a run of a case");
      return scope.error_of(own, [&](const ExpressionScope& other) { return one(number->evaluate(other)); });
    };
    return std::make_shared<const Node>(std::move(node));
  }
  /// time(kind, body or beam) of an event.
  NodePointer time_call() {
    skip();
    const std::string kind = name();
    expect(",");
    skip();
    const std::string of = name();
    expect(")");
    return call(
        [kind, of](const Values&, const ExpressionScope& scope) -> ExpressionValue {
          if (!scope.event_time)
            throw std::invalid_argument("time(" + kind + ", " + of + ") needs a run with events");
          return scope.event_time(kind, of);
        },
        {});
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0, operations_ = 0;
};

}  // namespace

bool is_between(double time, double first, double last) {
  const double slack = 1e-9 * std::max(std::abs(first), std::abs(last));
  return time >= first - slack && time <= last + slack;
}

Expression Expression::parse(const std::string& text) { return {text, ExpressionParser(text).parse()}; }

ExpressionValue Expression::evaluate(const ExpressionScope& scope) const { return root_->evaluate(scope); }

double Expression::number(const ExpressionScope& scope) const {
  const ExpressionValue value = evaluate(scope);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  throw std::invalid_argument(
      "the expression is a history; take one number of it by min, max, mean, rms, first, last, "
      "integral or at(end, ...)");
}

std::optional<std::pair<Expression, Expression>> Expression::sides() const {
  if (root_->comparison == Node::Comparison::none) return {};
  const Expression first(text_, root_->arguments[0]), second(text_, root_->arguments[1]);
  if (root_->comparison == Node::Comparison::less) return std::pair(second, first);
  return std::pair(first, second);
}

bool Expression::asks_for_errors() const { return root_->has_error(); }

std::vector<double> Expression::times() const {
  std::vector<double> times;
  root_->collect(times);
  return times;
}

std::vector<std::string> Expression::names() const {
  std::vector<std::string> names;
  root_->collect(names);
  return names;
}

}  // namespace nurbeam
