#include "pipelines/run/accuracy_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/readable_quantity.h"

namespace nurbeam {

namespace {

constexpr double usual_target = 0.02;
constexpr std::size_t most_lines = 12, most_events = 3;

std::string percent(double part) { return text_of(100 * part, 2) + " %"; }

// A number with as many decimals as there are.
std::string fixed(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(std::max(0, decimals)) << value;
  return text.str();
}

// Decimals that an error of one digit has, of two where that is a 1 or a 2.
int decimals_of(double error) {
  const int exponent = static_cast<int>(std::floor(std::log10(error)));
  const bool is_small = error / std::pow(10, exponent) < 2.95;
  return -exponent + (is_small ? 1 : 0);
}

std::string text_of_step(double step) {
  if (step < 1e-3) return text_of(1e6 * step, 4) + " us";
  return step < 1 ? text_of(1e3 * step, 4) + " ms" : text_of(step, 4) + " s";
}

std::string text_of_run(const AccuracyLevel& run) {
  std::string text = run.elements > 0 ? text_of(static_cast<double>(run.elements), 9) + " elements" : "";
  const std::string steps = run.step ? "steps of " + text_of_step(*run.step)
                                     : text_of(static_cast<double>(run.steps), 9) + " steps";
  return text + (text.empty() ? "" : ", ") + steps;
}

std::string head_line(const Accuracy& accuracy) {
  std::string line = "accuracy: ";
  for (std::size_t i = 0; i < accuracy.runs.size(); ++i) {
    const AccuracyLevel& run = accuracy.runs[i];
    const std::string text =
        accuracy.moves ? text_of_run(run)
                       : text_of(static_cast<double>(run.elements), 9) + (i == 0 ? " elements" : "");
    line += (i == 0 ? "" : i == 1 ? ", against " : " and ") + text;
  }
  return line;
}

// The object and quantity of a component; whether two numbers are components of one vector.
bool is_component_of(const NumberWithError& a, const NumberWithError& b) {
  const auto is_axis = [](const std::string& name) { return name.back() >= 'x' && name.back() <= 'z'; };
  return a.is_end && b.is_end && is_axis(a.quantity) && is_axis(b.quantity) &&
         a.quantity.substr(0, a.quantity.size() - 1) == b.quantity.substr(0, b.quantity.size() - 1);
}

// Of each vector the largest component.
std::vector<const NumberWithError*> shown_numbers(const Accuracy& accuracy) {
  std::vector<const NumberWithError*> events, shown;
  for (const NumberWithError& number : accuracy.numbers) {
    if (number.is_nought()) continue;
    if (number.unit == "s" && !number.is_end && events.size() < most_events) events.push_back(&number);
    if (!number.is_asked) continue;
    const auto same = std::ranges::find_if(
        shown, [&](const NumberWithError* other) { return is_component_of(*other, number); });
    if (same == shown.end())
      shown.push_back(&number);
    else if (std::abs(number.value) > std::abs((*same)->value))
      *same = &number;
  }
  std::ranges::stable_sort(
      shown, [](const NumberWithError* a, const NumberWithError* b) { return a->relative > b->relative; });
  for (const NumberWithError* number : shown)
    if (std::ranges::find(events, number) == events.end()) events.push_back(number);
  return events;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string line_of(const NumberWithError& number, std::size_t width, bool moves) {
  const bool is_event = number.unit == "s" && number.time == number.value;
  std::string line = "  " + padded(number.quantity, width) + "  " + (is_event ? "at " : "") +
                     text_with_error(number.value, number.error, number.unit);
  if (!is_event) line += "  " + percent(number.relative);
  if (moves && number.is_end) line += "  at the end";
  return number.not_converged.empty() ? line : line + "  not converged: " + number.not_converged;
}

std::string last_line(const Accuracy& accuracy) {
  const double target = accuracy.target.value_or(usual_target);
  std::size_t all = 0, right = 0;
  for (const NumberWithError& number : accuracy.numbers) {
    if (number.is_nought()) continue;
    ++all;
    if (number.not_converged.empty() && number.relative <= target) ++right;
  }
  std::string line =
      std::to_string(right) + " of " + std::to_string(all) + " numbers are right to " + percent(target);
  if (!accuracy.target)
    return line + (right < all ? "; --accuracy " + text_of(100 * target, 3) + "% refines" : "");
  if (accuracy.reached) return line + ", among them all that was asked for";
  return line + "; what was asked for is not: " + accuracy.unreached;
}

}  // namespace

std::string text_with_error(double value, double error, const std::string& unit) {
  const ReadableUnit shown =
      readable_unit(std::isfinite(error) ? std::max(std::abs(value), error) : value, unit);
  const double v = value / shown.factor, e = error / shown.factor;
  const std::string behind = shown.name == "1" ? "" : " " + shown.name;
  if (error == 0) return text_of(v, 7) + behind + " exactly";
  if (!std::isfinite(error)) return text_of(v, 4) + behind;
  const int decimals = decimals_of(e);
  if (std::max(std::abs(v), e) >= 1e9 || decimals > 9)
    return text_of(v, 6) + behind + " ± " + text_of(e, 2) + behind;
  const auto rounded = [&](double number) {
    const double last = std::pow(10, -decimals);
    return fixed(decimals < 0 ? last * std::round(number / last) : number, decimals);
  };
  return rounded(v) + behind + " ± " + rounded(e) + behind;
}

std::vector<std::string> accuracy_lines(const Accuracy& accuracy) {
  std::vector<std::string> lines = {head_line(accuracy)};
  std::vector<const NumberWithError*> shown = shown_numbers(accuracy);
  const std::size_t more = shown.size() > most_lines ? shown.size() - most_lines : 0;
  shown.resize(shown.size() - more);
  std::size_t width = 0;
  for (const NumberWithError* number : shown) width = std::max(width, number->quantity.size());
  for (const NumberWithError* number : shown) lines.push_back(line_of(*number, width, accuracy.moves));
  if (more > 0) lines.push_back("  ... and " + std::to_string(more) + " more, in run.json");
  if (accuracy.parted)
    lines.push_back("not converged from t = " + text_of(*accuracy.parted, 3) +
                    " s on: the runs part; averages may still be right");
  lines.push_back(last_line(accuracy));
  return lines;
}

}  // namespace nurbeam
