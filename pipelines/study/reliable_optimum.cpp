#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/limit_state.h"
#include "pipelines/study/rows.h"
#include "pipelines/study/variant.h"

namespace nurbeam {

namespace {

using Formula = StudyDistribution::Formula;

// A parameter as an expression of design variables.
std::string text_of_parameter(const StudyDistribution& d, std::size_t place) {
  for (const Formula& formula : d.formulas)
    if (formula.place == place) return "(" + formula.value.text() + ")";
  return "(" + text_of(d.parameters[place], all_digits) + ")";
}

// Where a random variable stands outside of probabilities: at its nominal value, where design variables make
// its distribution at the mean (before it is cut off).
Expression central_value(const StudyVariable& variable) {
  using Law = StudyDistribution::Kind;
  const StudyDistribution& d = variable.distribution;
  if (d.formulas.empty()) return Expression::parse(text_of(variable.nominal, all_digits));
  const auto part = [&](std::size_t place) { return text_of_parameter(d, place); };
  if (d.kind == Law::uniform) return Expression::parse("(" + part(0) + " + " + part(1) + ") / 2");
  if (d.kind == Law::triangular)
    return Expression::parse("(" + part(0) + " + " + part(1) + " + " + part(2) + ") / 3");
  return Expression::parse(part(0));
}

// The sides of a limit state where it is least, as quantities of a design.
std::string side_name(std::size_t probability, const char* side) {
  return "(" + std::string(side) + " side of probability " + std::to_string(probability) + ")";
}

/// The study of the design variables alone: random ones stand at their central values, and each probability
/// is an inequality between two more quantities.
StudyFile design_study(const StudyFile& study, const StudyOptimum& optimum) {
  StudyFile design = study;
  for (StudyVariable& variable : design.variables)
    if (variable.is_random) variable.derived = central_value(variable);
  for (std::size_t k = 0; k < optimum.probabilities.size(); ++k)
    for (const char* side : {"greater", "lesser"})
      design.quantities.push_back({side_name(k, side), "", "", Expression::parse("0")});
  return design;
}

StudyOptimum design_optimum(const StudyOptimum& optimum) {
  StudyOptimum design = optimum;
  for (std::size_t k = 0; k < optimum.probabilities.size(); ++k)
    design.constraints.push_back({Expression::parse("'" + side_name(k, "lesser") + "'"),
                                  Expression::parse("'" + side_name(k, "greater") + "'"),
                                  optimum.probabilities[k].fails.text});
  design.probabilities.clear();
  return design;
}

/// The study of the random variables at one design, whose only quantity is a limit state.
StudyFile random_study(const StudyFile& study, const std::vector<double>& design) {
  StudyFile random = study;
  const ExpressionScope scope = scope_of_design(study, design);
  std::size_t at = 0;
  for (const std::size_t i : study.free_variables()) {
    StudyVariable& variable = random.variables[i];
    if (!variable.is_random) {
      variable.derived = Expression::parse(text_of(design[at++], all_digits));
    } else {
      variable.distribution = variable.distribution.at(scope);
      variable.nominal = mean_of(variable.distribution).value_or(variable.nominal);
    }
  }
  random.quantities = {{"limit state", "", "", Expression::parse("0")}};
  return random;
}

/// A design with what is asked of it: variants where random variables stand at their central values, and
/// where each limit state is least at the reliability index that is asked for.
class ReliableDesigns {
 public:
  ReliableDesigns(const StudyFile& study, const StudyOptimum& optimum, KnownVariants& variants)
      : study_(study),
        optimum_(optimum),
        variants_(variants),
        design_study_(design_study(study, optimum)),
        places_(optimum.probabilities.size(),
                Eigen::VectorXd::Zero(static_cast<Eigen::Index>(random_variables(study).size()))) {}

  const StudyFile& study() const { return design_study_; }

  StudyPoints evaluate(const StudyPoints& designs) {
    StudyPoints points;
    for (const std::vector<double>& design : designs) points.push_back(central_point(design));
    StudyPoints rows = variants_.quantities(points);
    for (std::size_t i = 0; i < designs.size(); ++i) {
      add_sides(designs[i], rows[i]);
      ran_.push_back(variants_.count());
    }
    return rows;
  }

  // That of a limit state alone, as the sides of an inequality, counts: it stands in the lesser side.
  StudyGradient derivatives(const std::vector<double>& design) {
    const auto found = found_.find(design);
    if (found == found_.end()) return {};
    std::vector<double> steps = joined_steps(design);
    const StudyGradient by_free = variants_.gradient(central_point(design), steps);
    if (by_free.empty()) return {};
    const StudyPoints moved = by_design(design, [&](const auto& at) { return central_point(at); });
    StudyGradient rows;
    for (const std::vector<double>& by : by_free) {
      rows.emplace_back();
      for (const std::vector<double>& direction : moved) rows.back().push_back(dot(by, direction));
    }
    for (std::size_t k = 0; k < optimum_.probabilities.size(); ++k) {
      auto of_limit = limit_by_design(k, design, found->second[k]);
      if (!of_limit) return {};
      rows.emplace_back(design.size());
      rows.push_back(std::move(*of_limit));
    }
    return rows;
  }

  std::vector<double> central_point(const std::vector<double>& design) const {
    const std::vector<double> values = all_values(design_study_, design);
    std::vector<double> point;
    for (const std::size_t i : study_.free_variables()) point.push_back(values[i]);
    return point;
  }

  /// dg/dd at a place of standard space.
  std::optional<std::vector<double>> limit_by_design(std::size_t k, const std::vector<double>& design,
                                                     const Eigen::VectorXd& u) {
    const StudyPoints moved = by_design(
        design, [&](const auto& at) { return joined(study_, at, RandomSpace(study_, at).values(u)); });
    return limit_state(k, design).by_design(u, moved);
  }

  LimitState limit_state(std::size_t k, const std::vector<double>& design) {
    return {study_, optimum_.probabilities[k].fails, variants_, design};
  }

  /// How many variants had run when each design was known.
  const std::vector<std::size_t>& ran() const { return ran_; }
  /// Why designs are not known; empty where all are.
  std::string lost() const {
    return lost_ == 0 ? ""
                      : "; at " + std::to_string(lost_) + " designs no point was found where " +
                            in_quotes(lost_text_) +
                            " is nearest to failure: variants on the way are not done, or the "
                            "quantities are not smooth";
  }

 private:
  static double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  std::vector<double> joined_steps(const std::vector<double>& design) const {
    std::vector<double> random = RandomSpace(study_, design).deviations();
    for (double& step : random) step *= 1e-3;
    return joined(study_, design_steps(study_), random);
  }

  // The derivatives of the values of the free variables by each design variable.
  template <class PointOf>
  StudyPoints by_design(const std::vector<double>& design, const PointOf& point_of) const {
    const std::vector<double> steps = design_steps(study_);
    StudyPoints rows;
    for (std::size_t j = 0; j < design.size(); ++j) {
      std::vector<double> less = design, more = design;
      less[j] -= steps[j];
      more[j] += steps[j];
      std::vector<double> row = point_of(more);
      const std::vector<double> other = point_of(less);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = (row[i] - other[i]) / (more[j] - less[j]);
      rows.push_back(std::move(row));
    }
    return rows;
  }

  // Of a variant that is not done, or where one of them is not found, the row is empty.
  void add_sides(const std::vector<double>& design, std::vector<double>& row) {
    std::vector<Eigen::VectorXd> places = places_;
    for (std::size_t k = 0; k < places.size() && !row.empty(); ++k) {
      LimitState limit = limit_state(k, design);
      const auto place = least_on_sphere(limit.function(), optimum_.probabilities[k].least_index, places_[k]);
      if (!place) {
        row.clear();
        ++lost_;
        lost_text_ = optimum_.probabilities[k].fails.text;
        return;
      }
      places[k] = place->u;
      const auto [greater, lesser] = *limit.sides(limit.point(place->u));
      row.push_back(greater);
      row.push_back(lesser);
    }
    if (row.empty()) return;
    places_ = places;
    found_[design] = std::move(places);
  }

  const StudyFile& study_;
  const StudyOptimum& optimum_;
  KnownVariants& variants_;
  StudyFile design_study_;
  std::vector<Eigen::VectorXd> places_;  // where the next search of each limit state begins
  std::map<std::vector<double>, std::vector<Eigen::VectorXd>> found_;
  std::vector<std::size_t> ran_;
  int lost_ = 0;
  std::string lost_text_;
};

// By FORM, and by a simulation where the study asks for one. Of a limit that FORM does not find there is
// none.
void ask_for_probability(const StudyFile& study, const StudyOptimum& optimum,
                         const std::vector<double>& design, LimitState& limit, ProbabilityResult& result) {
  const StudyFile random = random_study(study, design);
  const auto value_at = [&](const std::vector<double>& point) {
    const auto value = limit.value(point);
    return value ? std::vector<double>{*value} : std::vector<double>{};
  };
  const StudyEvaluation evaluate = [&](const StudyPoints& points) {
    StudyPoints whole, values;
    for (const std::vector<double>& point : points) whole.push_back(joined(study, design, point));
    limit.run(whole);  // together
    for (const std::vector<double>& point : whole) values.push_back(value_at(point));
    return values;
  };
  const StudyDerivatives derivatives = [&](const std::vector<double>& point) {
    const auto by = limit.by_random(joined(study, design, point));
    return by ? StudyGradient{*by} : StudyGradient{};
  };
  using Method = StudyReliability::Method;
  StudyReliability asked = optimum.check.value_or(StudyReliability{});
  asked.quantity = random.quantities.front().name;
  asked.fails_above = false;
  const auto answer = [&](Method method) {
    asked.method = method;
    return failure_probability(random, asked, evaluate, derivatives);
  };
  const bool sampled_about_it = optimum.check && optimum.check->method == Method::importance_sampling;
  result.form = answer(sampled_about_it ? Method::importance_sampling : Method::form);
  if (sampled_about_it) {
    result.check = result.form;
    result.form.probability = OT::DistFunc::pNormal(-*result.form.reliability_index);
    result.form.coefficient_of_variation.reset();
    result.form.not_done = 0;
  } else if (optimum.check) {
    result.check = answer(Method::monte_carlo);
  }
  result.form.design_point = joined(study, design, result.form.design_point);
}

// (dg/dd) / |dg/du| at the design point: FORM's multiplier is 1 / |dg/du|.
std::vector<double> index_gradient(ReliableDesigns& designs, std::size_t k, const std::vector<double>& design,
                                   const Eigen::VectorXd& u) {
  const auto by_standard = designs.limit_state(k, design).by_standard(u);
  auto by_design = designs.limit_by_design(k, design, u);
  if (!by_standard || !by_design || !(by_standard->norm() > 0)) return {};
  for (double& by : *by_design) by /= by_standard->norm();
  return *by_design;
}

std::vector<double> random_part(const StudyFile& study, const std::vector<double>& point) {
  std::vector<double> random;
  const std::vector<std::size_t> free = study.free_variables();
  for (std::size_t i = 0; i < free.size(); ++i)
    if (study.variables[free[i]].is_random) random.push_back(point[i]);
  return random;
}

// Why the probability may be greater than what is asked for; empty where nothing says so.
std::string doubt_of(const ProbabilityResult& result, const StudyOptimum& optimum) {
  const double asked = OT::DistFunc::pNormal(-result.least_index);
  constexpr double round_off = 1e-3;
  if (result.form.reliability_index && *result.form.reliability_index < result.least_index - round_off)
    return in_quotes(result.text) + ": FORM that begins at the means finds the reliability index " +
           text_of(*result.form.reliability_index, 4) + ", below the " + text_of(result.least_index, 4) +
           " that the search held: the limit is near in several directions; begin the search elsewhere "
           "(\"nominal\")";
  if (!result.check) return {};
  const double found = result.check->probability,
               deviation = found * result.check->coefficient_of_variation.value_or(0);
  if (found - 2 * deviation > asked) {
    const double index = 2 * result.least_index - index_of(found);
    return in_quotes(result.text) + ": the simulation finds the probability " + text_of(found, 4) + " +- " +
           text_of(deviation, 2) + ", above the " + text_of(asked, 4) +
           " that FORM holds: the limit is bent; ask for \"reliability_index(...) >= " + text_of(index, 4) +
           "\" in its place";
  }
  constexpr double least_failures = 10;
  if (optimum.check->method == StudyReliability::Method::monte_carlo &&
      asked * optimum.check->count < least_failures)
    return in_quotes(result.text) + ": " + std::to_string(optimum.check->count) +
           " variants are too few to see a probability of " + text_of(asked, 3) +
           "; take \"importance_sampling\", or a \"count\" of " +
           text_of(std::ceil(least_failures / asked), 3);
  return {};
}

ProbabilityResult probability_at(const StudyFile& study, const StudyOptimum& optimum,
                                 ReliableDesigns& designs, std::size_t k, const std::vector<double>& design,
                                 std::vector<std::string>& doubts) {
  const auto& [fails, least_index] = optimum.probabilities[k];
  ProbabilityResult result{.text = fails.text, .least_index = least_index};
  LimitState limit = designs.limit_state(k, design);
  try {
    ask_for_probability(study, optimum, design, limit, result);
  } catch (const StudyRowsError&) {
    throw;
  } catch (const std::runtime_error& problem) {  // of FORM; the search held what it holds
    result.form.probability = std::numeric_limits<double>::quiet_NaN();
    doubts.push_back(in_quotes(fails.text) + ": is held, but " + problem.what());
    return result;
  }
  const Eigen::VectorXd u = limit.space().standard(random_part(study, result.form.design_point));
  result.index_gradient = index_gradient(designs, k, design, u);
  if (std::string doubt = doubt_of(result, optimum); !doubt.empty()) doubts.push_back(std::move(doubt));
  return result;
}

// The best objective after each variant, of that after each design.
std::vector<double> by_variants(const std::vector<double>& by_designs, const std::vector<std::size_t>& ran) {
  std::vector<double> history;
  for (std::size_t k = 0; k < by_designs.size(); ++k) {
    const double before = history.empty() ? std::numeric_limits<double>::quiet_NaN() : history.back();
    history.resize(std::max(history.size(), ran[k] - 1), before);
    history.resize(std::max(history.size(), ran[k]), by_designs[k]);
    history.back() = by_designs[k];
  }
  return history;
}

}  // namespace

OptimumResult find_reliable_optimum(const StudyFile& study, const StudyOptimum& optimum,
                                    const StudyEvaluation& evaluate, const StudyDerivatives& derivatives) {
  KnownVariants variants(study, evaluate, derivatives);
  ReliableDesigns designs(study, optimum, variants);
  const StudyOptimum of_design = design_optimum(optimum);
  const auto search = [&] {
    try {
      return find_optimum(
          designs.study(), of_design, [&](const StudyPoints& points) { return designs.evaluate(points); },
          [&](const std::vector<double>& design) { return designs.derivatives(design); });
    } catch (const StudyRowsError&) {
      throw;
    } catch (const std::runtime_error& problem) {
      throw std::runtime_error(problem.what() + designs.lost());
    }
  };
  OptimumResult result = search();
  const std::vector<double> design = result.points.front();
  result.history = by_variants(result.history, designs.ran());
  for (std::vector<double>& point : result.points) point = designs.central_point(point);
  for (std::vector<double>& row : result.quantities) row.resize(study.quantities.size());
  for (std::size_t k = 0; k < optimum.probabilities.size(); ++k)
    result.probabilities.push_back(probability_at(study, optimum, designs, k, design, result.doubts));
  return result;
}

}  // namespace nurbeam
