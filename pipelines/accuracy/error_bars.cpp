#include "pipelines/accuracy/error_bars.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

constexpr double of_motion = 1.25, of_motion_coarse = 1.5, of_statics = 1.5, of_kind = 0.1;
constexpr double of_unit = 1e-7, of_round_off = 1e-11, least_of_unit = 0.01;
constexpr double falls = 0.71;

double magnitude(const HistoryQuantity& of, const LevelNumbers& run) {
  double largest = 0;
  for (const std::vector<double>& row : run.rows)
    for (const std::size_t i : of.columns)
      if (std::isfinite(row[i])) largest = std::max(largest, std::abs(row[i]));
  return largest;
}

}  // namespace

double bounded_order_error(double first, std::optional<double> second, bool has_jumps) {
  if (!second) return of_statics * first;
  constexpr double least = 0.5;
  const double most = has_jumps ? 1 : 3, later = has_jumps ? 2 : 8;
  const double p = first > 0 ? std::clamp(std::log2(*second / first), least, most) : most;
  return of_statics * std::max(first, *second / later) / (std::exp2(p) - 1);
}

ErrorBars::ErrorBars(const AccuracyModel& model, const RunsOfErrors& runs, const LevelNumbers& own)
    : model_(model),
      runs_(runs),
      is_own_(runs.fine->level == own.level),
      first_(model.quantities, *runs.fine, *runs.coarse) {
  if (runs.coarser) second_.emplace(model.quantities, *runs.coarse, *runs.coarser);
  if (!is_own_) from_own_.emplace(model.quantities, *runs.fine, own);
  std::vector<double> sizes;
  for (std::size_t q = 0; q < model.quantities.size(); ++q) {
    const HistoryQuantity& of = model.quantities[q];
    sizes.push_back(magnitude(of, *runs.fine));
    nought_.push_back(sizes.back() == 0 && magnitude(of, *runs.coarse) == 0);
    for (const std::string& group : {of.unit, of.kind})
      largest_[group] = std::max(largest_[group], sizes.back());
    double& kind = kinds_[of.kind];
    kind = std::max(kind, first_.whole(q));
  }
  for (std::size_t q = 0; q < sizes.size(); ++q) scales_.push_back(scale_of(model.quantities[q], sizes[q]));
}

double ErrorBars::fine(std::size_t quantity, double time) const {
  if (is_nought(quantity)) return 0;
  const HistoryQuantity& of = model_.quantities[quantity];
  const double d = first_.until(quantity, time), least = noise(quantity);
  if (model_.moves) return of_motion * d + least;
  const auto second = second_ ? std::optional(second_->until(quantity, time)) : std::nullopt;
  return std::max(bounded_order_error(d, second, model_.has_jumps[quantity]), of_kind * kinds_.at(of.kind)) +
         least;
}

double ErrorBars::own(std::size_t quantity, double time) const {
  if (is_own_ || is_nought(quantity)) return fine(quantity, time);
  const double off = from_own_->until(quantity, time);
  if (model_.moves && runs_.coarse->level == 0) return of_motion_coarse * off + noise(quantity);
  return off + fine(quantity, time);
}

double ErrorBars::fine_of(const std::vector<double>& values, bool has_jumps) const {
  if (values.size() < 2) return 0;
  const double d = std::abs(values[0] - values[1]);
  if (model_.moves) return of_motion * d;
  return bounded_order_error(
      d, values.size() > 2 ? std::optional(std::abs(values[1] - values[2])) : std::nullopt, has_jumps);
}

double ErrorBars::own_of(double own, const std::vector<double>& values, bool has_jumps) const {
  if (is_own_ || values.empty()) return fine_of(values, has_jumps);
  const double off = std::abs(values[0] - own);
  if (model_.moves && runs_.coarse->level == 0) return of_motion_coarse * off;
  return off + fine_of(values, has_jumps);
}

double ErrorBars::largest(const std::string& group) const {
  const auto found = largest_.find(group);
  return found == largest_.end() ? 0 : found->second;
}

double ErrorBars::noise(const std::string& unit) const { return of_unit * largest(unit); }

// Displacements are small beside positions, and have their round-off.
double ErrorBars::noise(std::size_t quantity) const {
  const HistoryQuantity& of = model_.quantities[quantity];
  if (of.unit != "m") return noise(of.unit);
  return of_unit * largest(of.kind) + of_round_off * largest(of.unit);
}

// Where a model lies in the world is no size of its positions, nor its length one of its displacements.
double ErrorBars::scale_of(const HistoryQuantity& of, double size) const {
  const auto of_space = [&](double length) {
    return of.unit == "m" && model_.length > 0 ? std::min(length, model_.length) : length;
  };
  const double least = least_of_unit * of_space(largest(of.unit == "m" ? of.kind : of.unit)),
               scale = std::max(of_space(size), least);
  return of.unit == "N m" ? std::max(scale, largest("N") * model_.radius_of_gyration) : scale;
}

bool ErrorBars::does_not_shrink(std::size_t quantity) const {
  return second_ && first_.whole(quantity) > falls * second_->whole(quantity);
}

}  // namespace nurbeam
