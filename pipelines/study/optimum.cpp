#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "pipelines/study/openturns_study.h"
#include "pipelines/study/variant.h"

namespace nurbeam {

namespace {

/// All variants that a search has asked for.
struct Searched {
  StudyPoints points, quantities;
};

/// What a search minimises and holds, of one variant.
class Goal {
 public:
  Goal(const StudyFile& study, const StudyOptimum& optimum) : study_(study), optimum_(optimum) {
    for (const StudyOptimum::Objective& objective : optimum.objectives)
      indices_.push_back(quantity_index(study, objective.quantity));
  }

  std::vector<double> objectives(const std::vector<double>& quantities) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < indices_.size(); ++i)
      values.push_back(optimum_.objectives[i].minimise ? quantities[indices_[i]] : -quantities[indices_[i]]);
    return values;
  }
  /// Each 0 or more where it holds.
  std::vector<double> margins(const std::vector<double>& quantities, const std::vector<double>& point) const {
    const std::vector<double> variables = all_values(study_, point);
    const ExpressionScope scope{.value = [&](const std::string& name) -> ExpressionValue {
      for (std::size_t i = 0; i < study_.variables.size(); ++i)
        if (study_.variables[i].name == name) return variables[i];
      return quantities[quantity_index(study_, name)];
    }};
    std::vector<double> margins;
    for (const Expression& constraint : optimum_.constraints) margins.push_back(constraint.number(scope));
    return margins;
  }
  bool holds(const std::vector<double>& quantities, const std::vector<double>& point) const {
    const std::vector<double> all = margins(quantities, point);
    return std::all_of(all.begin(), all.end(), [](double margin) { return margin >= -1e-9; });
  }

 private:
  const StudyFile& study_;
  const StudyOptimum& optimum_;
  std::vector<std::size_t> indices_;
};

constexpr double unusable = 1e30;  // what a variant that is not done counts as

OT::OptimizationProblem problem_of(const StudyFile& study, const StudyOptimum& optimum,
                                   const StudyEvaluation& evaluate, const Goal& goal) {
  const OT::MemoizeFunction objective(study_function(
      study, evaluate, optimum.objectives.size(),
      [&goal](const std::vector<double>& quantities, const std::vector<double>&) {
        return goal.objectives(quantities);
      },
      std::vector<double>(optimum.objectives.size(), unusable)));
  OT::OptimizationProblem problem{OT::Function(objective)};
  problem.setBounds(joint_distribution(study).getRange());
  if (!optimum.constraints.empty())
    problem.setInequalityConstraint(study_function(
        study, evaluate, optimum.constraints.size(),
        [&goal](const std::vector<double>& quantities, const std::vector<double>& point) {
          return goal.margins(quantities, point);
        },
        std::vector<double>(optimum.constraints.size(), -unusable)));
  return problem;
}

OT::OptimizationAlgorithm algorithm_of(const StudyFile& study, const StudyOptimum& optimum,
                                       const OT::OptimizationProblem& problem) {
  using Method = StudyOptimum::Method;
  std::vector<double> start;
  for (const std::size_t i : study.free_variables()) start.push_back(study.variables[i].nominal);
  const OT::Interval range = problem.getBounds();
  const double width = (range.getUpperBound() - range.getLowerBound()).norm();
  OT::OptimizationAlgorithm algorithm;
  if (optimum.method == Method::genetic) {
    const std::size_t population =
        std::clamp<std::size_t>(static_cast<std::size_t>(optimum.evaluations) / 10, 8, 100) / 4 * 4;
    OT::RandomGenerator::SetSeed(study.seed);
    const OT::Sample first = joint_distribution(study).getSample(population);
    OT::Pagmo genetic(problem, optimum.objectives.size() > 1 ? "nsga2" : "gaco", first);
    genetic.setGenerationNumber(
        std::max<std::size_t>(1, static_cast<std::size_t>(optimum.evaluations) / population));
    genetic.setSeed(study.seed);
    genetic.setBlockSize(population);
    return genetic;
  }
  if (optimum.method == Method::cobyla) {
    OT::Cobyla cobyla(problem, width / 10);
    algorithm = cobyla;
  } else {
    algorithm = OT::NLopt(problem, optimum.method == Method::gradient ? "LD_SLSQP" : "LN_NELDERMEAD");
  }
  algorithm.setStartingPoint(to_point(start));
  algorithm.setMaximumEvaluationNumber(static_cast<std::size_t>(optimum.evaluations));
  algorithm.setMaximumIterationNumber(static_cast<std::size_t>(optimum.evaluations));
  algorithm.setMaximumAbsoluteError(optimum.tolerance * width);
  algorithm.setMaximumRelativeError(optimum.tolerance);
  return algorithm;
}

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool better = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
    better = better || a[i] < b[i];
  }
  return better;
}

/// Of all variants that hold the constraints those that no other one is better than in all objectives.
OptimumResult best_of(const Searched& searched, const Goal& goal) {
  OptimumResult result;
  std::vector<std::vector<double>> front;
  double best = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < searched.points.size(); ++i) {
    if (!searched.quantities[i].empty() && goal.holds(searched.quantities[i], searched.points[i])) {
      const std::vector<double> value = goal.objectives(searched.quantities[i]);
      if (!(value[0] >= best)) best = value[0];
      const bool beaten = std::any_of(front.begin(), front.end(), [&](const auto& other) {
        return other == value || dominates(other, value);
      });
      if (!beaten) {
        for (std::size_t k = front.size(); k-- > 0;)
          if (dominates(value, front[k])) {
            const auto at = static_cast<std::ptrdiff_t>(k);
            front.erase(front.begin() + at);
            result.points.erase(result.points.begin() + at);
            result.quantities.erase(result.quantities.begin() + at);
          }
        front.push_back(value);
        result.points.push_back(searched.points[i]);
        result.quantities.push_back(searched.quantities[i]);
      }
    }
    result.history.push_back(best);
  }
  return result;
}

}  // namespace

OptimumResult find_optimum(const StudyFile& study, const StudyOptimum& optimum,
                           const StudyEvaluation& evaluate) {
  const Goal goal(study, optimum);
  Searched searched;
  // Objective and constraints ask for the same points one after the other.
  const StudyEvaluation once = [&](const StudyPoints& points) {
    StudyPoints result(points.size()), fresh;
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto found = std::find(searched.points.begin(), searched.points.end(), points[i]);
      if (found != searched.points.end())
        result[i] = searched.quantities[static_cast<std::size_t>(found - searched.points.begin())];
      else {
        fresh.push_back(points[i]);
        at.push_back(i);
      }
    }
    const StudyPoints quantities = fresh.empty() ? StudyPoints{} : evaluate(fresh);
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      searched.points.push_back(fresh[i]);
      searched.quantities.push_back(quantities[i]);
      result[at[i]] = quantities[i];
    }
    return result;
  };
  try {
    OT::OptimizationAlgorithm algorithm =
        algorithm_of(study, optimum, problem_of(study, optimum, once, goal));
    algorithm.run();
  } catch (const OT::Exception& problem) {
    if (searched.points.empty())
      throw std::runtime_error(std::string("the search did not begin: ") + problem.what());
  }
  OptimumResult result = best_of(searched, goal);
  if (result.points.empty())
    throw std::runtime_error("no variant of " + std::to_string(searched.points.size()) +
                             " is done and holds \"subject_to\"; take wider ranges or more \"evaluations\"");
  return result;
}

}  // namespace nurbeam
