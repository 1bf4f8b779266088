#include "pipelines/study/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/variant.h"

namespace nurbeam {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Whether variants have its value without a run.
bool is_of_variables(const StudyFile& study, const StudyOptimum::Constraint& constraint) {
  const std::vector<std::string> variables = names_of(study.variables);
  const auto is_variable = [&](const std::string& name) {
    return std::find(variables.begin(), variables.end(), name) != variables.end();
  };
  const std::vector<std::string> greater = constraint.greater.names(), lesser = constraint.lesser.names();
  return std::all_of(greater.begin(), greater.end(), is_variable) &&
         std::all_of(lesser.begin(), lesser.end(), is_variable);
}

}  // namespace

Goal::Goal(const StudyFile& study, const StudyOptimum& optimum)
    : study_(study), optimum_(optimum), constraints_(optimum.constraints) {
  for (const StudyOptimum::Objective& objective : optimum.objectives)
    indices_.push_back(quantity_index(study, objective.quantity));
  if (knows_constraints())
    for (const Expression& constraint : study.constraints)
      if (const auto sides = constraint.sides())
        constraints_.push_back({sides->first, sides->second, constraint.text()});
  for (const StudyOptimum::Constraint& constraint : constraints_)
    of_variables_.push_back(is_of_variables(study, constraint));
  units_.resize(constraints_.size());
}

std::vector<double> Goal::objectives(const std::vector<double>& quantities) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < indices_.size(); ++i)
    values.push_back(optimum_.objectives[i].minimise ? quantities[indices_[i]] : -quantities[indices_[i]]);
  return values;
}

std::vector<double> Goal::margins(const std::vector<double>& quantities,
                                  const std::vector<double>& point) const {
  std::vector<double> margins;
  for (const auto& [greater, lesser] : sides(quantities, point))
    margins.push_back((greater - lesser) / (units_[margins.size()] > 0 ? units_[margins.size()] : 1));
  return margins;
}

void Goal::measure(const std::vector<double>& quantities, const std::vector<double>& point) {
  if (std::all_of(units_.begin(), units_.end(), [](double unit) { return unit > 0; })) return;
  const std::vector<Sides> all = sides(quantities, point);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (units_[k] > 0 || (quantities.empty() && !of_variables_[k])) continue;
    const double larger = std::max(std::abs(all[k].first), std::abs(all[k].second));
    units_[k] = larger > 0 && std::isfinite(larger) ? larger : 1;
  }
}

bool Goal::holds(const std::vector<double>& quantities, const std::vector<double>& point) const {
  const std::vector<double> all = margins(quantities, point);
  return std::all_of(all.begin(), all.end(), is_satisfied);
}

std::pair<double, double> sides_of(const StudyFile& study, const StudyOptimum::Constraint& constraint,
                                   const std::vector<double>& quantities, const std::vector<double>& point) {
  const std::vector<double> variables = all_values(study, point);
  const ExpressionScope scope{.value = [&](const std::string& name) -> ExpressionValue {
    for (std::size_t i = 0; i < study.variables.size(); ++i)
      if (study.variables[i].name == name) return variables[i];
    return quantities[quantity_index(study, name)];
  }};
  return {constraint.greater.number(scope), constraint.lesser.number(scope)};
}

std::vector<Goal::Sides> Goal::sides(const std::vector<double>& quantities,
                                     const std::vector<double>& point) const {
  std::vector<Sides> sides;
  for (std::size_t k = 0; k < constraints_.size(); ++k)
    if (quantities.empty() && !of_variables_[k])
      sides.emplace_back(unknown, unknown);
    else
      sides.push_back(sides_of(study_, constraints_[k], quantities, point));
  return sides;
}

Search::Search(const StudyFile& study, const StudyEvaluation& evaluate, const StudyDerivatives& derivatives,
               Goal& goal)
    : study_(study),
      evaluate_(evaluate),
      derivatives_(derivatives),
      goal_(goal),
      knows_constraints_(goal.knows_constraints()),
      range_(joint_distribution(study).getRange()),
      region_(
          study, [this](const std::vector<double>& part) { return point_of(part); },
          OT::Interval(range_.getDimension())),
      least_margins_(goal.constraints(), -1.0),
      tightened_(goal.constraints()) {
  goal.measure({}, study.nominal());
  constexpr double of_rounding = 1e-9;  // what lies on the edge is not to be rejected
  for (std::size_t k = 0; k < tightened_.size(); ++k)
    if (goal.rejects_by(k)) tightened_[k] = of_rounding;
}

StudyPoints Search::quantities(const StudyPoints& parts) {
  StudyPoints fresh, result(parts.size());
  for (const std::vector<double>& each : parts) {
    const std::vector<double> point = point_of(allowed(each));
    const std::size_t number = points_.size() + fresh.size();
    const auto [variant, is_fresh] = indices_.emplace(point, number);
    if (is_fresh) fresh.push_back(point);
    if (parts.size() > 1) continue;
    single_ += is_fresh ? 1 : 0;
    if (asked_.empty() || asked_.back() != variant->second) asked_.push_back(variant->second);
  }
  try {
    if (stopped_) return result;
    if (!fresh.empty()) keep(fresh, evaluate_(fresh));
    for (std::size_t i = 0; i < parts.size(); ++i) result[i] = moved_quantities(parts[i]);
  } catch (...) {  // the methods are written in C
    stopped_ = std::current_exception();
    return StudyPoints(parts.size());
  }
  return result;
}

// Those of the variant that ran, and what its derivatives say of the way to what was asked for.
std::vector<double> Search::moved_quantities(const std::vector<double>& part) {
  const std::vector<double> at = allowed(part);
  std::vector<double> quantities = quantities_[indices_.at(point_of(at))];
  if (at == part || quantities.empty() || !has_slopes()) return quantities;
  const std::vector<double> from = point_of(at), to = point_of(part);
  const StudyGradient slopes = derivatives_at(at);
  for (std::size_t k = 0; k < slopes.size(); ++k)
    for (std::size_t i = 0; i < part.size(); ++i) quantities[k] += slopes[k][i] * (to[i] - from[i]);
  return quantities;
}

// None of a variant that is not done.
StudyGradient Search::derivatives_at(const std::vector<double>& part) {
  return derivatives_ ? derivatives_(point_of(part)) : differences_at(part);
}

// By variants to both sides; to one where the other is beyond a range or would be rejected.
StudyGradient Search::differences_at(const std::vector<double>& part) {
  constexpr double step = 1e-5;  // of the range
  StudyPoints sides;
  for (std::size_t i = 0; i < part.size(); ++i)
    for (const double by : {-step, step}) {
      std::vector<double> side = part;
      side[i] = std::clamp(part[i] + by, 0.0, 1.0);
      sides.push_back(region_.has(side) ? side : part);
    }
  const StudyPoints values = quantities(sides);
  StudyGradient slopes(study_.quantities.size(), std::vector<double>(part.size()));
  for (std::size_t i = 0; i < part.size(); ++i) {
    const std::vector<double>&less = values[2 * i], &more = values[2 * i + 1];
    if (less.empty() || more.empty()) return {};
    const double between = point_of(sides[2 * i + 1])[i] - point_of(sides[2 * i])[i];
    for (std::size_t k = 0; k < slopes.size() && between > 0; ++k)
      slopes[k][i] = (more[k] - less[k]) / between;
  }
  return slopes;
}

StudyGradient Search::objective_gradient(const std::vector<double>& part) {
  StudyGradient rows = gradient(part, [&](const std::vector<double>& quantities, const std::vector<double>&) {
    return goal_.objectives(quantities);
  });
  for (std::vector<double>& row : rows)
    for (double& by : row) by /= unit_;
  return rows;
}

StudyGradient Search::margin_gradient(const std::vector<double>& part) {
  return gradient(
      part, [&](const std::vector<double>& quantities,
                const std::vector<double>& point) { return goal_.margins(quantities, point); });
}

std::vector<double> Search::objectives(const std::vector<double>& quantities) const {
  std::vector<double> values = quantities.empty() ? worse_than_all() : goal_.objectives(quantities);
  for (double& value : values) value /= unit_;
  return values;
}

std::vector<double> Search::margins(const std::vector<double>& quantities,
                                    const std::vector<double>& part) const {
  std::vector<double> margins = goal_.margins(quantities, point_of(part));
  for (std::size_t k = 0; k < margins.size(); ++k)
    margins[k] =
        std::isnan(margins[k]) && quantities.empty() ? least_margins_[k] : margins[k] - tightened_[k];
  return margins;
}

bool Search::relax(double least) {
  bool relaxed = false;
  for (double& by : tightened_)
    if (by > least) by /= 8, relaxed = true;
  return relaxed;
}

std::vector<double> Search::start() { return allowed(part_of(study_.nominal())); }

std::vector<double> Search::allowed(const std::vector<double>& part) {
  return knows_constraints_ ? region_.nearest(part).value_or(part) : part;
}

/// Of f(quantities, point), by the chain rule: a row for each value of f.
template <class Function>
StudyGradient Search::gradient(const std::vector<double>& part, const Function& f) {
  const std::vector<double> quantities = this->quantities({part}).front(), point = point_of(part);
  StudyGradient of_quantities;
  try {
    if (stopped_ || quantities.empty()) return {};
    of_quantities = derivatives_at(allowed(part));
    if (of_quantities.empty()) return {};
  } catch (...) {
    stopped_ = std::current_exception();
    return {};
  }
  StudyGradient rows;
  for (std::size_t i = 0; i < part.size(); ++i) {
    constexpr double step = 1e-4;  // of the range
    const double width = range_.getUpperBound()[i] - range_.getLowerBound()[i];
    const auto moved = [&](double by) {
      std::vector<double> q = quantities, x = point;
      for (std::size_t k = 0; k < q.size(); ++k) q[k] += by * width * of_quantities[k][i];
      x[i] += by * width;
      return f(q, x);
    };
    const std::vector<double> more = moved(step), less = moved(-step);
    rows.resize(more.size(), std::vector<double>(part.size()));
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k][i] = (more[k] - less[k]) / (2 * step);
  }
  return rows;
}

std::vector<double> Search::part_of(const std::vector<double>& point) const {
  std::vector<double> parts;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const double lower = range_.getLowerBound()[k], upper = range_.getUpperBound()[k];
    parts.push_back(std::clamp((point[k] - lower) / (upper - lower), 0.0, 1.0));
  }
  return parts;
}

std::vector<double> Search::point_of(const std::vector<double>& part) const {
  std::vector<double> point;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const double lower = range_.getLowerBound()[k], upper = range_.getUpperBound()[k];
    point.push_back(std::clamp(lower + part[k] * (upper - lower), lower, upper));
  }
  return point;
}

void Search::keep(const StudyPoints& fresh, const StudyPoints& quantities) {
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    points_.push_back(fresh[i]);
    quantities_.push_back(quantities[i]);
    if (quantities[i].empty()) continue;
    goal_.measure(quantities[i], fresh[i]);
    const std::vector<double> values = goal_.objectives(quantities[i]);
    if (least_.empty()) least_ = most_ = values;
    for (std::size_t k = 0; k < values.size(); ++k) {
      least_[k] = std::min(least_[k], values[k]);
      most_[k] = std::max(most_[k], values[k]);
    }
    const std::vector<double> margins = goal_.margins(quantities[i], fresh[i]);
    for (std::size_t k = 0; k < margins.size(); ++k)
      least_margins_[k] = std::min(least_margins_[k], margins[k]);
  }
}

// What a variant that is not done counts as: a search turns back from it, but is not thrown far away.
std::vector<double> Search::worse_than_all() const {
  constexpr double unusable = 1e30;  // before any variant is done
  std::vector<double> worse(goal_.count(), unusable);
  for (std::size_t k = 0; k < most_.size(); ++k)
    worse[k] = most_[k] + std::max({most_[k] - least_[k], 0.1 * std::abs(most_[k]), 1e-12});
  return worse;
}

}  // namespace nurbeam
