#include "pipelines/study/limit_state.h"

#include <cmath>

#include "pipelines/study/search.h"

namespace nurbeam {

KnownVariants::KnownVariants(const StudyFile& study, const StudyEvaluation& evaluate,
                             const StudyDerivatives& derivatives)
    : study_(study), evaluate_(evaluate), derivatives_(derivatives) {}

StudyPoints KnownVariants::quantities(const StudyPoints& points) {
  StudyPoints fresh;
  for (const std::vector<double>& point : points)
    if (known_.emplace(point, std::vector<double>{}).second) fresh.push_back(point);
  if (!fresh.empty()) {
    const StudyPoints found = evaluate_(fresh);
    for (std::size_t i = 0; i < fresh.size(); ++i) known_[fresh[i]] = found[i];
  }
  StudyPoints all;
  for (const std::vector<double>& point : points) all.push_back(known_.at(point));
  return all;
}

StudyGradient KnownVariants::gradient(const std::vector<double>& point, const std::vector<double>& steps) {
  if (quantities({point}).front().empty()) return {};
  if (!derivatives_) return differences(point, steps);
  StudyGradient tangents = derivatives_(point);
  return tangents.empty() ? differences(point, steps) : tangents;
}

StudyGradient KnownVariants::differences(const std::vector<double>& point, const std::vector<double>& steps) {
  StudyPoints sides;
  for (std::size_t i = 0; i < point.size(); ++i)
    for (const double sign : {-1.0, 1.0})
      if (steps[i] > 0) {
        sides.push_back(point);
        sides.back()[i] += sign * steps[i];
      }
  const StudyPoints found = quantities(sides);
  StudyGradient rows(study_.quantities.size(), std::vector<double>(point.size()));
  std::size_t at = 0;
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (!(steps[i] > 0)) continue;
    const std::vector<double>&less = found[at], &more = found[at + 1];
    if (less.empty() || more.empty()) return {};
    for (std::size_t k = 0; k < rows.size(); ++k)
      rows[k][i] = (more[k] - less[k]) / (sides[at + 1][i] - sides[at][i]);
    at += 2;
  }
  return rows;
}

std::vector<double> design_steps(const StudyFile& study) {
  constexpr double of_range = 1e-5;
  std::vector<double> steps;
  for (const std::size_t i : design_variables(study)) {
    const std::vector<double>& ends = study.variables[i].distribution.parameters;
    steps.push_back(of_range * (ends[1] - ends[0]));
  }
  return steps;
}

LimitState::LimitState(const StudyFile& study, const StudyOptimum::Constraint& fails, KnownVariants& variants,
                       const std::vector<double>& design)
    : study_(study), fails_(fails), variants_(variants), design_(design), space_(study, design) {}

std::vector<double> LimitState::point(const Eigen::VectorXd& u) const {
  return joined(study_, design_, space_.values(u));
}

std::optional<std::pair<double, double>> LimitState::sides(const std::vector<double>& point) {
  const std::vector<double> quantities = variants_.quantities({point}).front();
  if (quantities.empty()) return {};
  const auto found = sides_of(study_, fails_, quantities, point);
  return std::isfinite(found.second - found.first) ? std::optional(found) : std::nullopt;
}

std::optional<double> LimitState::value(const std::vector<double>& point) {
  const auto both = sides(point);
  return both ? std::optional(both->second - both->first) : std::nullopt;
}

// By the chain rule: quantities go along with each variable, over the steps that differences are taken over.
std::optional<std::vector<double>> LimitState::by_free(const std::vector<double>& point, bool with_design) {
  constexpr double of_scatter = 1e-3;  // runs are not exact to the last digit
  std::vector<double> random = space_.deviations(), design = design_steps(study_);
  for (double& step : random) step *= of_scatter;
  const std::vector<double> steps = joined(study_, design, random);
  const StudyGradient rows = variants_.gradient(
      point, with_design ? steps : joined(study_, std::vector<double>(design.size()), random));
  if (rows.empty()) return {};
  const std::vector<double> quantities = variants_.quantities({point}).front();
  std::vector<double> by(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) {
    const auto moved = [&](double step) {
      std::vector<double> q = quantities, x = point;
      for (std::size_t k = 0; k < q.size(); ++k) q[k] += step * rows[k][i];
      x[i] += step;
      const auto [greater, lesser] = sides_of(study_, fails_, q, x);
      return lesser - greater;
    };
    by[i] = (moved(steps[i]) - moved(-steps[i])) / (2 * steps[i]);
    if (!std::isfinite(by[i])) return {};
  }
  return by;
}

std::optional<std::vector<double>> LimitState::by_random(const std::vector<double>& point) {
  const auto all = by_free(point, false);
  if (!all) return {};
  std::vector<double> by;
  const std::vector<std::size_t> free = study_.free_variables();
  for (std::size_t i = 0; i < free.size(); ++i)
    if (study_.variables[free[i]].is_random) by.push_back((*all)[i]);
  return by;
}

std::optional<Eigen::VectorXd> LimitState::by_standard(const Eigen::VectorXd& u) {
  const auto by = by_random(point(u));
  if (!by) return {};
  const std::vector<double> slopes = space_.slopes(u);
  Eigen::VectorXd found(u.size());
  for (std::size_t i = 0; i < by->size(); ++i) found[static_cast<Eigen::Index>(i)] = (*by)[i] * slopes[i];
  return found;
}

std::optional<std::vector<double>> LimitState::by_design(const Eigen::VectorXd& u, const StudyPoints& moved) {
  const auto by = by_free(point(u), true);
  if (!by) return {};
  std::vector<double> found;
  for (const std::vector<double>& direction : moved) {
    double sum = 0;
    for (std::size_t i = 0; i < by->size(); ++i) sum += (*by)[i] * direction[i];
    found.push_back(sum);
  }
  return found;
}

SphereFunction LimitState::function() {
  return {[this](const Eigen::VectorXd& u) { return value(point(u)); },
          [this](const Eigen::VectorXd& u) { return by_standard(u); }};
}

}  // namespace nurbeam
