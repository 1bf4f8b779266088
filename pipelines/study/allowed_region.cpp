#include "pipelines/study/allowed_region.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipelines/study/histories.h"
#include "pipelines/study/variant.h"

namespace nurbeam {

AllowedRegion::AllowedRegion(const StudyFile& study, PointOf point_of, std::optional<OT::Interval> bounds)
    : study_(study), point_of_(std::move(point_of)), bounds_(std::move(bounds)) {
  for (const Expression& constraint : study.constraints)
    if (const auto sides = constraint.sides())
      constraints_.push_back({sides->first, sides->second, constraint.text()});
}

std::vector<double> AllowedRegion::margins(const std::vector<double>& place) const {
  const std::vector<double> values = all_values(study_, point_of_(place));
  const ExpressionScope scope = scope_of_variables(study_, values);
  std::vector<double> margins;
  for (const StudyOptimum::Constraint& constraint : constraints_)
    margins.push_back(constraint.greater.number(scope) - constraint.lesser.number(scope));
  return margins;
}

bool AllowedRegion::has(const std::vector<double>& place) const {
  const std::vector<double> values = all_values(study_, point_of_(place));
  const ExpressionScope scope = scope_of_variables(study_, values);
  return std::all_of(study_.constraints.begin(), study_.constraints.end(), [&](const Expression& constraint) {
    return !constraint.sides() || constraint.number(scope) != 0;
  });
}

std::optional<std::vector<double>> AllowedRegion::nearest(const std::vector<double>& place) {
  if (constraints_.empty() || has(place)) return place;
  if (const auto known = found_.find(place); known != found_.end()) return known->second;
  std::optional<std::vector<double>>& found = found_[place];
  for (double margin = 1e-10; margin < 1e-4 && !found; margin *= 10) found = nearest_inside(place, margin);
  return found;
}

// Constraints hold by that part of what they are missed by at the place.
std::optional<std::vector<double>> AllowedRegion::nearest_inside(const std::vector<double>& place,
                                                                 double margin) const {
  std::vector<double> units = margins(place);
  for (double& unit : units) unit = unit != 0 && std::isfinite(unit) ? std::abs(unit) : 1;
  const StudyEvaluation none = [](const StudyPoints& places) { return StudyPoints(places.size()); };
  OT::OptimizationProblem problem(
      study_function(study_, none, 1,
                     [&](const std::vector<double>&, const std::vector<double>& x) {
                       return std::vector<double>{(to_point(x) - to_point(place)).normSquare()};
                     },
                     {}));
  if (bounds_) problem.setBounds(*bounds_);
  problem.setInequalityConstraint(
      study_function(study_, none, constraints_.size(),
                     [&](const std::vector<double>&, const std::vector<double>& x) {
                       std::vector<double> all = margins(x);
                       for (std::size_t k = 0; k < all.size(); ++k) all[k] = all[k] / units[k] - margin;
                       return all;
                     },
                     {}));
  for (const char* method : {"LD_SLSQP", "LN_COBYLA"}) {
    OT::NLopt algorithm(problem, method);
    algorithm.setStartingPoint(to_point(place));
    algorithm.setMaximumEvaluationNumber(2000);
    algorithm.setMaximumAbsoluteError(1e-12);
    algorithm.setMaximumRelativeError(1e-12);
    algorithm.setMaximumResidualError(0);
    algorithm.setMaximumConstraintError(0.1 * margin);
    try {
      algorithm.run();
      std::vector<double> found = from_point(algorithm.getResult().getOptimalPoint());
      if (found.size() == place.size() && has(found)) return found;
    } catch (const OT::Exception&) {  // there may be none
    }
  }
  return {};
}

}  // namespace nurbeam
