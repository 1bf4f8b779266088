#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/openturns_study.h"
#include "pipelines/study/variant.h"

namespace nurbeam {

namespace {

bool is_held(double margin) { return margin >= -1e-9; }

using Sides = std::pair<double, double>;  // of a constraint: what must be greater, and the other

/// What a search minimises and holds, of one variant.
class Goal {
 public:
  Goal(const StudyFile& study, const StudyOptimum& optimum) : study_(study), optimum_(optimum) {
    for (const StudyOptimum::Objective& objective : optimum.objectives)
      indices_.push_back(quantity_index(study, objective.quantity));
  }

  std::size_t count() const { return indices_.size(); }
  /// The first objective; else it maximises it.
  bool minimises() const { return optimum_.objectives.front().minimise; }
  std::size_t constraints() const { return optimum_.constraints.size(); }
  std::vector<double> objectives(const std::vector<double>& quantities) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < indices_.size(); ++i)
      values.push_back(optimum_.objectives[i].minimise ? quantities[indices_[i]] : -quantities[indices_[i]]);
    return values;
  }
  /// Each 0 or more where it holds, as a part of its unit.
  std::vector<double> margins(const std::vector<double>& quantities, const std::vector<double>& point) const {
    std::vector<double> margins;
    for (const auto& [greater, lesser] : sides(quantities, point))
      margins.push_back((greater - lesser) / units_[margins.size()]);
    return margins;
  }
  /// The units of constraints are the larger sides in the first variant that is done.
  void measure(const std::vector<double>& quantities, const std::vector<double>& point) {
    if (!units_.empty()) return;
    for (const auto& [greater, lesser] : sides(quantities, point)) {
      const double larger = std::max(std::abs(greater), std::abs(lesser));
      units_.push_back(larger > 0 && std::isfinite(larger) ? larger : 1);
    }
  }
  double unit(std::size_t constraint) const { return units_.at(constraint); }
  bool holds(const std::vector<double>& quantities, const std::vector<double>& point) const {
    const std::vector<double> all = margins(quantities, point);
    return std::all_of(all.begin(), all.end(), is_held);
  }

 private:
  std::vector<Sides> sides(const std::vector<double>& quantities, const std::vector<double>& point) const {
    const std::vector<double> variables = all_values(study_, point);
    const ExpressionScope scope{.value = [&](const std::string& name) -> ExpressionValue {
      for (std::size_t i = 0; i < study_.variables.size(); ++i)
        if (study_.variables[i].name == name) return variables[i];
      return quantities[quantity_index(study_, name)];
    }};
    std::vector<Sides> sides;
    for (const StudyOptimum::Constraint& constraint : optimum_.constraints)
      sides.emplace_back(constraint.greater.number(scope), constraint.lesser.number(scope));
    return sides;
  }

  const StudyFile& study_;
  const StudyOptimum& optimum_;
  std::vector<std::size_t> indices_;
  std::vector<double> units_;  // of constraints; none before a variant is done
};

/// The variants that a search asks for. It sees the free variables as parts of their ranges, 0 to 1, so that
/// lengths and moduli weigh the same, and never leaves them.
class Search {
 public:
  Search(const StudyFile& study, const StudyEvaluation& evaluate, const StudyDerivatives& derivatives,
         Goal& goal)
      : study_(study),
        evaluate_(evaluate),
        derivatives_(derivatives),
        goal_(goal),
        range_(joint_distribution(study).getRange()),
        least_margins_(goal.constraints(), -1.0) {}

  /// Each variant runs once, however often it is asked for: objective and constraints ask for the same
  /// points.
  StudyPoints quantities(const StudyPoints& parts) {
    StudyPoints fresh;
    for (const std::vector<double>& each : parts) {
      const std::vector<double> point = point_of(each);
      if (indices_.emplace(point, points_.size() + fresh.size()).second) fresh.push_back(point);
    }
    if (parts.size() == 1) single_ += fresh.size();
    StudyPoints result(parts.size());
    try {
      if (stopped_) return result;
      if (!fresh.empty()) keep(fresh, evaluate_(fresh));
    } catch (...) {  // the methods are written in C
      stopped_ = std::current_exception();
      return result;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) result[i] = quantities_[indices_.at(point_of(parts[i]))];
    return result;
  }
  /// The objectives and the margins by the parts; none of a variant that is not done.
  StudyGradient objective_gradient(const std::vector<double>& part) {
    StudyGradient rows =
        gradient(part, [&](const std::vector<double>& quantities, const std::vector<double>&) {
          return goal_.objectives(quantities);
        });
    for (std::vector<double>& row : rows)
      for (double& by : row) by /= unit_;
    return rows;
  }
  StudyGradient margin_gradient(const std::vector<double>& part) {
    return gradient(
        part, [&](const std::vector<double>& quantities,
                  const std::vector<double>& point) { return goal_.margins(quantities, point); });
  }
  /// What a search sees of objectives from now on is in this unit.
  void set_unit(double unit) { unit_ = unit; }
  bool has_derivatives() const { return static_cast<bool>(derivatives_); }

  bool stopped() const { return stopped_ != nullptr; }
  void throw_if_stopped() const {
    if (stopped_) std::rethrow_exception(stopped_);
  }
  /// Variants that were asked for one by one: those of differences and of generations come in batches.
  std::size_t single() const { return single_; }

  std::vector<double> objectives(const std::vector<double>& quantities) const {
    std::vector<double> values = quantities.empty() ? worse_than_all() : goal_.objectives(quantities);
    for (double& value : values) value /= unit_;
    return values;
  }
  std::vector<double> margins(const std::vector<double>& quantities, const std::vector<double>& part) const {
    return quantities.empty() ? least_margins_ : goal_.margins(quantities, point_of(part));
  }

  std::vector<double> start() const {
    std::vector<double> parts;
    for (const std::size_t i : study_.free_variables()) {
      const std::size_t k = parts.size();
      const double lower = range_.getLowerBound()[k], upper = range_.getUpperBound()[k];
      parts.push_back(std::clamp((study_.variables[i].nominal - lower) / (upper - lower), 0.0, 1.0));
    }
    return parts;
  }

  const StudyPoints& points() const { return points_; }
  const StudyPoints& quantities() const { return quantities_; }

 private:
  /// Of f(quantities, point), by the chain rule: a row for each value of f.
  template <class Function>
  StudyGradient gradient(const std::vector<double>& part, const Function& f) {
    const std::vector<double> quantities = this->quantities({part}).front(), point = point_of(part);
    StudyGradient of_quantities;
    try {
      if (stopped_ || quantities.empty()) return {};
      of_quantities = derivatives_(point);
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

  std::vector<double> point_of(const std::vector<double>& parts) const {
    std::vector<double> point;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double lower = range_.getLowerBound()[k], upper = range_.getUpperBound()[k];
      point.push_back(std::clamp(lower + parts[k] * (upper - lower), lower, upper));
    }
    return point;
  }

  void keep(const StudyPoints& fresh, const StudyPoints& quantities) {
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
  std::vector<double> worse_than_all() const {
    constexpr double unusable = 1e30;  // before any variant is done
    std::vector<double> worse(goal_.count(), unusable);
    for (std::size_t k = 0; k < most_.size(); ++k)
      worse[k] = most_[k] + std::max({most_[k] - least_[k], 0.1 * std::abs(most_[k]), 1e-12});
    return worse;
  }

  const StudyFile& study_;
  const StudyEvaluation& evaluate_;
  const StudyDerivatives& derivatives_;
  Goal& goal_;
  OT::Interval range_;
  std::map<std::vector<double>, std::size_t> indices_;  // of points, in the order in which they ran
  StudyPoints points_, quantities_;
  std::vector<double> least_, most_;   // of each objective
  std::vector<double> least_margins_;  // and what a variant that is not done counts as
  double unit_ = 1;
  std::size_t single_ = 0;
  std::exception_ptr stopped_;
};

OT::OptimizationProblem problem_of(const StudyFile& study, const StudyOptimum& optimum, Search& search) {
  const StudyEvaluation evaluate = [&search](const StudyPoints& parts) { return search.quantities(parts); };
  StudyDerivatives of_objectives, of_margins;
  if (search.has_derivatives()) {
    of_objectives = [&search](const std::vector<double>& part) { return search.objective_gradient(part); };
    of_margins = [&search](const std::vector<double>& part) { return search.margin_gradient(part); };
  }
  const OT::Function objective = study_function(
      study, evaluate, optimum.objectives.size(),
      [&search](const std::vector<double>& quantities, const std::vector<double>&) {
        return search.objectives(quantities);
      },
      of_objectives);
  OT::OptimizationProblem problem(objective);
  problem.setBounds(OT::Interval(study.free_variables().size()));
  if (!optimum.constraints.empty())
    problem.setInequalityConstraint(study_function(
        study, evaluate, optimum.constraints.size(),
        [&search](const std::vector<double>& quantities, const std::vector<double>& part) {
          return search.margins(quantities, part);
        },
        of_margins));
  return problem;
}

OT::OptimizationAlgorithm genetic_search(const StudyFile& study, const StudyOptimum& optimum,
                                         const OT::OptimizationProblem& problem) {
  const std::size_t population =
      std::clamp<std::size_t>(static_cast<std::size_t>(optimum.evaluations) / 10, 8, 100) / 4 * 4;
  OT::RandomGenerator::SetSeed(study.seed);
  const std::size_t inputs = study.free_variables().size();
  const OT::Sample first =
      OT::ComposedDistribution(OT::ComposedDistribution::DistributionCollection(inputs, OT::Uniform(0, 1)))
          .getSample(population);
  OT::Pagmo genetic(problem, optimum.objectives.size() > 1 ? "nsga2" : "gaco", first);
  genetic.setGenerationNumber(
      std::max<std::size_t>(1, static_cast<std::size_t>(optimum.evaluations) / population));
  genetic.setSeed(study.seed);
  genetic.setBlockSize(population);
  return genetic;
}

OT::OptimizationAlgorithm algorithm_of(const StudyFile& study, const StudyOptimum& optimum,
                                       const OT::OptimizationProblem& problem, const Search& search) {
  using Method = StudyOptimum::Method;
  if (optimum.method == Method::genetic) return genetic_search(study, optimum, problem);
  const std::string method = optimum.method == Method::gradient      ? "LD_SLSQP"
                             : optimum.method == Method::nelder_mead ? "LN_NELDERMEAD"
                                                                     : "LN_COBYLA";
  OT::NLopt algorithm(problem, method);
  constexpr double first_step = 0.1;
  if (optimum.method != Method::gradient)
    algorithm.setInitialStep(OT::Point(study.free_variables().size(), first_step));
  algorithm.setStartingPoint(to_point(search.start()));
  // Out of the way: it counts calls, also those for a variant that has run already.
  constexpr std::size_t calls_of_a_variant = 10;
  algorithm.setMaximumEvaluationNumber(calls_of_a_variant * static_cast<std::size_t>(optimum.evaluations));
  algorithm.setMaximumIterationNumber(calls_of_a_variant * static_cast<std::size_t>(optimum.evaluations));
  algorithm.setMaximumAbsoluteError(optimum.tolerance);
  algorithm.setMaximumRelativeError(optimum.tolerance);
  algorithm.setMaximumResidualError(0);  // however little the objective changes
  algorithm.setMaximumConstraintError(0);
  return algorithm;
}

// The slope of the objective where a search along gradients begins: its first step is as long.
double slope_at_start(const Search& search, const OT::OptimizationProblem& problem) {
  const OT::Matrix slopes = problem.getObjective().gradient(to_point(search.start()));
  double sum = 0;
  for (std::size_t i = 0; i < slopes.getNbRows(); ++i) sum += slopes(i, 0) * slopes(i, 0);
  return sum > 0 && std::isfinite(sum) ? std::sqrt(sum) : 1;
}

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool better = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
    better = better || a[i] < b[i];
  }
  return better;
}

// From the least to the greatest first objective.
void sort_front(OptimumResult& result, const std::vector<std::vector<double>>& front) {
  std::vector<std::size_t> order(front.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return front[a] < front[b]; });
  StudyPoints points, quantities;
  for (const std::size_t i : order) {
    points.push_back(result.points[i]);
    quantities.push_back(result.quantities[i]);
  }
  result.points = std::move(points);
  result.quantities = std::move(quantities);
}

/// Of all variants that hold the constraints those that no other one is better than in all objectives, the
/// best one in the first objective first.
OptimumResult best_of(const Search& search, const Goal& goal) {
  OptimumResult result;
  std::vector<std::vector<double>> front;
  double best = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < search.points().size(); ++i) {
    if (!search.quantities()[i].empty() && goal.holds(search.quantities()[i], search.points()[i])) {
      const std::vector<double> value = goal.objectives(search.quantities()[i]);
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
        result.points.push_back(search.points()[i]);
        result.quantities.push_back(search.quantities()[i]);
      }
    }
    result.history.push_back(goal.minimises() ? best : -best);
  }
  sort_front(result, front);
  return result;
}

// Why none of the variants of a search holds the constraints.
std::string none_holds(const StudyOptimum& optimum, const Search& search, const Goal& goal) {
  std::size_t done = 0;
  std::vector<double> best(optimum.constraints.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < search.points().size(); ++i) {
    if (search.quantities()[i].empty()) continue;
    ++done;
    const std::vector<double> margins = goal.margins(search.quantities()[i], search.points()[i]);
    for (std::size_t k = 0; k < best.size(); ++k) best[k] = std::fmax(best[k], margins[k]);
  }
  std::string missed;
  for (std::size_t k = 0; k < best.size(); ++k)
    if (!is_held(best[k]))
      missed += (missed.empty() ? "" : ", ") + in_quotes(optimum.constraints[k].text) +
                (std::isfinite(best[k]) ? " is missed by " + text_of(-best[k] * goal.unit(k), 4) + " at least"
                                        : " is no number");
  return "none of the " + std::to_string(done) + " variants that are done holds \"subject_to\": " +
         (missed.empty() ? "each holds in some of them, but not all together" : missed) +
         "; take wider ranges or more \"evaluations\"";
}

}  // namespace

OptimumResult find_optimum(const StudyFile& study, const StudyOptimum& optimum,
                           const StudyEvaluation& evaluate, const StudyDerivatives& derivatives) {
  Goal goal(study, optimum);
  Search search(study, evaluate, derivatives, goal);
  const auto used_up = [&] {
    return optimum.method != StudyOptimum::Method::genetic &&
           search.single() >= static_cast<std::size_t>(optimum.evaluations);
  };
  std::function<bool()> ended = [&] { return search.stopped() || used_up(); };
  try {
    const OT::OptimizationProblem problem = problem_of(study, optimum, search);
    if (optimum.method == StudyOptimum::Method::gradient) search.set_unit(slope_at_start(search, problem));
    OT::OptimizationAlgorithm algorithm = algorithm_of(study, optimum, problem, search);
    algorithm.setStopCallback(
        [](void* of) -> OT::Bool { return (*static_cast<std::function<bool()>*>(of))(); }, &ended);
    algorithm.run();
  } catch (const OT::Exception& problem) {
    if (search.points().empty())
      throw std::runtime_error(std::string("the search did not begin: ") + problem.what());
  }
  search.throw_if_stopped();
  OptimumResult result = best_of(search, goal);
  result.cut_off = used_up();
  if (result.points.empty()) throw std::runtime_error(none_holds(optimum, search, goal));
  return result;
}

}  // namespace nurbeam
