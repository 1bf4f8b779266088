#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/search.h"

namespace nurbeam {

namespace {

OT::OptimizationProblem problem_of(const StudyFile& study, const StudyOptimum& optimum, const Goal& goal,
                                   Search& search) {
  const StudyEvaluation evaluate = [&search](const StudyPoints& parts) { return search.quantities(parts); };
  StudyDerivatives of_objectives, of_margins;
  if (search.has_slopes()) {
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
  if (goal.constraints() > 0)
    problem.setInequalityConstraint(study_function(
        study, evaluate, goal.constraints(),
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
  // Behind the first population.
  genetic.setGenerationNumber(
      std::max<std::size_t>(2, static_cast<std::size_t>(optimum.evaluations) / population) - 1);
  genetic.setSeed(study.seed);
  genetic.setBlockSize(population);
  return genetic;
}

/// Where a search begins, in parts of the ranges, and how.
struct SearchRound {
  StudyOptimum::Method method;
  std::vector<double> start;
  double first_step = 0.1;
};

OT::OptimizationAlgorithm algorithm_of(const StudyFile& study, const StudyOptimum& optimum,
                                       const OT::OptimizationProblem& problem, const SearchRound& round) {
  using Method = StudyOptimum::Method;
  if (round.method == Method::genetic) return genetic_search(study, optimum, problem);
  const std::string method = round.method == Method::gradient      ? "LD_SLSQP"
                             : round.method == Method::nelder_mead ? "LN_NELDERMEAD"
                                                                   : "LN_COBYLA";
  OT::NLopt algorithm(problem, method);
  if (round.method != Method::gradient)
    algorithm.setInitialStep(OT::Point(study.free_variables().size(), round.first_step));
  algorithm.setStartingPoint(to_point(round.start));
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
double slope_at_start(const OT::OptimizationProblem& problem, const std::vector<double>& start) {
  const OT::Matrix slopes = problem.getObjective().gradient(to_point(start));
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
std::string none_holds(const Search& search, const Goal& goal) {
  std::size_t done = 0;
  std::vector<double> best(goal.constraints(), -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < search.points().size(); ++i) {
    if (search.quantities()[i].empty()) continue;
    ++done;
    const std::vector<double> margins = goal.margins(search.quantities()[i], search.points()[i]);
    for (std::size_t k = 0; k < best.size(); ++k) best[k] = std::fmax(best[k], margins[k]);
  }
  std::string missed;
  for (std::size_t k = 0; k < best.size(); ++k)
    if (!is_satisfied(best[k]))
      missed += (missed.empty() ? "" : ", ") + in_quotes(goal.text(k)) +
                (std::isfinite(best[k]) ? " is missed by " + text_of(-best[k] * goal.unit(k), 4) + " at least"
                                        : " is no number");
  return "none of the " + std::to_string(done) + " variants that are done holds \"subject_to\": " +
         (missed.empty() ? "each holds in some of them, but not all together" : missed) +
         "; take wider ranges or more \"evaluations\"";
}

// The mean of some points, and how far they are from it at most, in parts of the ranges.
std::pair<OT::Point, double> spread_of(const Search& search, std::size_t first, std::size_t count) {
  OT::Sample parts(0, search.points().front().size());
  for (std::size_t i = first; i < first + count; ++i)
    parts.add(to_point(search.part_of(search.points()[search.asked()[i]])));
  const OT::Point mean = parts.computeMean();
  double spread = 0;
  for (std::size_t i = 0; i < count; ++i) spread = std::max(spread, OT::Point(parts[i] - mean).norm());
  return {mean, spread};
}

// Whether a search goes round and round in its last variants, of those from the first on: it stays where it
// is with steps as long as ever.
bool is_circling(const Search& search, std::size_t first, std::size_t variables) {
  const std::size_t turn = 10 * (variables + 1), count = search.asked().size();
  if (count < first + 2 * turn) return false;
  const auto [before, wide_before] = spread_of(search, count - 2 * turn, turn);
  const auto [now, wide_now] = spread_of(search, count - turn, turn);
  return wide_now > 0.7 * wide_before && OT::Point(now - before).norm() < 0.25 * wide_now;
}

/// How far a search has come: the variant it stands at, and the best one that holds the constraints.
struct Standing {
  std::optional<std::size_t> end, best;
};

double violation_of(const Search& search, const Goal& goal, std::size_t variant) {
  double violation = 0;
  for (const double margin : goal.margins(search.quantities()[variant], search.points()[variant]))
    if (!is_satisfied(margin)) violation = std::fmax(violation, -margin);
  return violation;
}

double distance_of(const Search& search, std::size_t a, std::size_t b) {
  return (to_point(search.part_of(search.points()[a])) - to_point(search.part_of(search.points()[b]))).norm();
}

double objective_of(const Search& search, const Goal& goal, std::size_t variant) {
  return goal.objectives(search.quantities()[variant]).front();
}

// The variants where a round ended, which began with the first of those that were asked for: one along slopes
// at the last, others among the last, which are beside each other.
std::vector<std::size_t> last_of(const Search& search, const SearchRound& round, std::size_t first) {
  const std::size_t most = round.method == StudyOptimum::Method::gradient ? 1 : round.start.size() + 1;
  std::vector<std::size_t> last;
  for (std::size_t i = search.asked().size(); i-- > first && last.size() < most;)
    if (!search.quantities()[search.asked()[i]].empty()) last.push_back(search.asked()[i]);
  if (last.empty() && !search.asked().empty() && !search.quantities()[search.asked().back()].empty())
    last.push_back(search.asked().back());  // it went nowhere
  return last;
}

Standing standing_of(const Search& search, const Goal& goal, const SearchRound& round, std::size_t first) {
  Standing standing;
  for (std::size_t i = 0; i < search.points().size(); ++i) {
    if (search.quantities()[i].empty() || !goal.holds(search.quantities()[i], search.points()[i])) continue;
    if (!standing.best || objective_of(search, goal, i) < objective_of(search, goal, *standing.best))
      standing.best = i;
  }
  for (const std::size_t i : last_of(search, round, first))
    if (!standing.end || violation_of(search, goal, i) < violation_of(search, goal, *standing.end))
      standing.end = i;
  return standing;
}

// Whether a search ended that near to the best variant that holds its constraints.
bool ended_beside_best(const Search& search, const Standing& standing, double distance) {
  return standing.best && standing.end && distance_of(search, *standing.end, *standing.best) <= distance;
}

double moved_by(const Search& search, const SearchRound& round, std::size_t to) {
  return (to_point(search.part_of(search.points()[to])) - to_point(round.start)).norm();
}

// Where to go on: where the search ended, with the constraints that it just misses so much tighter or those
// that were too tight less so, else from the best variant. One along slopes that ended there goes on from it
// until that moves it no more: its steps may have been too short only for the slopes before. Nothing where
// there is nothing to do.
std::optional<SearchRound> next_round(Search& search, const Goal& goal, const StudyOptimum& optimum,
                                      const SearchRound& last, const Standing& standing) {
  if (!standing.end && !standing.best) return {};
  constexpr double just_missed = 1e-2, whole = 0.1, least = 1e-3;
  const double small = std::clamp(10 * optimum.tolerance, least, whole);
  const auto from = [&](std::size_t variant, double first_step) {
    return SearchRound{optimum.method, search.part_of(search.points()[variant]), first_step};
  };
  if (ended_beside_best(search, standing, 3 * optimum.tolerance)) {
    const bool has_moved = moved_by(search, last, *standing.best) > 3 * optimum.tolerance;
    const bool to_be_confirmed = optimum.method == StudyOptimum::Method::gradient && has_moved;
    if (!search.relax(0.1 * optimum.tolerance) && !to_be_confirmed) return {};
    return from(*standing.best, small);
  }
  if (standing.best && (!standing.end || violation_of(search, goal, *standing.end) > just_missed))
    return from(*standing.best, whole);
  const std::vector<double> margins =
      goal.margins(search.quantities()[*standing.end], search.points()[*standing.end]);
  for (std::size_t k = 0; k < margins.size(); ++k)
    if (!is_satisfied(margins[k])) search.tighten(k, -margins[k]);
  return from(*standing.end, small);
}

// "a = 1, b = 2" and what a variant misses.
std::string place_text(const StudyFile& study, const Search& search, const Goal& goal, std::size_t variant) {
  const std::vector<double>& point = search.points()[variant];
  std::string text, missed;
  for (std::size_t i = 0; i < point.size(); ++i)
    text +=
        (i > 0 ? ", " : "") + study.variables[study.free_variables()[i]].name + " = " + text_of(point[i], 6);
  const std::vector<double> margins = goal.margins(search.quantities()[variant], point);
  for (std::size_t k = 0; k < margins.size(); ++k)
    if (!is_satisfied(margins[k]))
      missed += (missed.empty() ? ", which misses " : " and ") + in_quotes(goal.text(k)) + " by " +
                text_of(-margins[k] * goal.unit(k), 4);
  return text + missed;
}

std::string why_not_converged(const StudyFile& study, const StudyOptimum& optimum, const Search& search,
                              const Goal& goal, const Standing& standing) {
  const double far = std::max(1e-3, 30 * optimum.tolerance);
  if (!standing.end || ended_beside_best(search, standing, far)) return {};
  return "the search did not converge: it ended at " + place_text(study, search, goal, *standing.end) +
         ", and the best of the variants that hold the constraints is given; begin beside it (\"nominal\"), "
         "or take " +
         (optimum.method == StudyOptimum::Method::cobyla ? "\"gradient\"" : "\"cobyla\"") + " as \"method\"";
}

void run_round(const StudyFile& study, const StudyOptimum& optimum, const OT::OptimizationProblem& problem,
               const SearchRound& round, const Search& search, std::function<bool()>& ended) {
  try {
    OT::OptimizationAlgorithm algorithm = algorithm_of(study, optimum, problem, round);
    algorithm.setStopCallback(
        [](void* of) -> OT::Bool { return (*static_cast<std::function<bool()>*>(of))(); }, &ended);
    algorithm.run();
  } catch (const OT::Exception& stopped) {  // also where steps come down to round-off
    if (search.points().empty())
      throw std::runtime_error(std::string("the search did not begin: ") + stopped.what());
  }
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
  std::size_t first = 0;  // of the variants of a round
  const std::size_t variables = study.free_variables().size();
  std::function<bool()> ended = [&] {
    return search.stopped() || used_up() ||
           (goal.knows_constraints() && is_circling(search, first, variables));
  };
  const OT::OptimizationProblem problem = problem_of(study, optimum, goal, search);
  SearchRound round{optimum.method, search.start()};
  if (goal.takes_slopes()) search.set_unit(slope_at_start(problem, round.start));
  constexpr int most_rounds = 8;
  Standing standing;
  for (int i = 0; i < most_rounds && !search.stopped() && !used_up(); ++i) {
    first = search.asked().size();
    run_round(study, optimum, problem, round, search, ended);
    if (search.stopped() || !goal.knows_constraints()) break;
    standing = standing_of(search, goal, round, first);
    const std::optional<SearchRound> next = next_round(search, goal, optimum, round, standing);
    if (!next) break;
    round = *next;
  }
  search.throw_if_stopped();
  OptimumResult result = best_of(search, goal);
  result.cut_off = used_up();
  if (result.points.empty()) throw std::runtime_error(none_holds(search, goal));
  if (!result.cut_off) result.not_converged = why_not_converged(study, optimum, search, goal, standing);
  return result;
}

}  // namespace nurbeam
