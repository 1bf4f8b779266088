#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipelines/study/openturns_study.h"

namespace nurbeam {

namespace {

// At most so many variants of a simulation run together: few where it may end after each such block.
constexpr std::size_t long_block = 1024, short_block = 32;

// What is over the threshold, or not `above` it, in units of `scale`; `of_not_done`: of a variant that is not
// done. Differences are taken over a thousandth of the scatter: runs are not exact to the last digit.
OT::RandomVector limit_event(const StudyFile& study, const StudyReliability& reliability,
                             const StudyEvaluation& evaluate, const StudyDerivatives& derivatives,
                             double scale, double of_not_done, bool above) {
  const std::size_t k = quantity_index(study, reliability.quantity);
  const double threshold = reliability.threshold;
  StudyDerivatives gradient;
  if (derivatives)
    gradient = [&derivatives, k, scale](const std::vector<double>& point) {
      StudyGradient all = derivatives(point);
      if (all.empty()) return all;
      for (double& by : all[k]) by /= scale;
      return StudyGradient{all[k]};
    };
  OT::Function f = study_function(
      study, evaluate, 1,
      [k, threshold, scale, of_not_done](const std::vector<double>& quantities, const std::vector<double>&) {
        return std::vector<double>{quantities.empty() ? of_not_done : (quantities[k] - threshold) / scale};
      },
      gradient);
  const OT::Distribution joint = joint_distribution(study);
  if (!derivatives)
    f.setGradient(
        OT::CenteredFiniteDifferenceGradient(1e-3 * joint.getStandardDeviation(), f.getEvaluation()));
  const OT::CompositeRandomVector output(f, OT::RandomVector(joint));
  return above ? OT::ThresholdEvent(output, OT::Greater(), 0.0) : OT::ThresholdEvent(output, OT::Less(), 0.0);
}

// How far the quantity is from its threshold where FORM begins; 1 where that is not known.
double scale_of(const StudyFile& study, const StudyReliability& reliability,
                const StudyEvaluation& evaluate) {
  const std::vector<double> quantities = evaluate({study.nominal()}).front();
  if (quantities.empty()) return 1;
  const double margin =
      std::abs(quantities[quantity_index(study, reliability.quantity)] - reliability.threshold);
  return margin > 0 ? margin : 1;
}

OT::FORMResult form_of(const StudyFile& study, const StudyReliability& reliability,
                       const OT::RandomVector& event) {
  OT::AbdoRackwitz search;
  search.setMaximumEvaluationNumber(static_cast<std::size_t>(reliability.count));
  search.setMaximumIterationNumber(static_cast<std::size_t>(reliability.count));
  constexpr double tolerance = 1e-6;
  search.setMaximumAbsoluteError(tolerance);
  search.setMaximumRelativeError(tolerance);
  search.setMaximumResidualError(tolerance);
  search.setMaximumConstraintError(tolerance);
  OT::FORM form(OT::OptimizationAlgorithm(search), event, to_point(study.nominal()));
  try {
    form.run();
  } catch (const OT::Exception&) {  // which speaks of its own points and functions
    throw std::runtime_error(
        "FORM found no design point: the quantity hardly changes where it looks, or variants there are not "
        "done; take \"monte_carlo\"");
  }
  const OT::OptimizationResult last = form.getResult().getOptimizationResult();
  // The limit is a margin away where it begins.
  constexpr double near = 1e-3;
  if (!(last.getConstraintError() <= near) || !(last.getResidualError() <= near))
    throw std::runtime_error("FORM found no design point within " + std::to_string(reliability.count) +
                             " variants; give a greater \"count\", or take \"monte_carlo\"");
  return form.getResult();
}

// Blocks of one size that use up as many of the variants as can be, of half that length and more.
std::size_t block_size(std::size_t count, std::size_t longest) {
  if (count <= longest) return count;
  std::size_t best = longest;
  for (std::size_t block = longest; block > longest / 2; --block)
    if (count % block < count % best) best = block;
  return best;
}

ReliabilityResult simulated(const StudyReliability& reliability, const OT::RandomVector& event,
                            const OT::WeightedExperiment& experiment) {
  OT::ProbabilitySimulationAlgorithm algorithm(event, experiment);
  const auto count = static_cast<std::size_t>(reliability.count);
  const std::size_t longest = reliability.coefficient_of_variation > 0 ? short_block : long_block;
  const std::size_t block = block_size(count, longest);
  algorithm.setBlockSize(block);
  algorithm.setMaximumOuterSampling(count / block);
  algorithm.setMaximumCoefficientOfVariation(reliability.coefficient_of_variation);
  algorithm.run();
  const OT::ProbabilitySimulationResult result = algorithm.getResult();
  ReliabilityResult estimate{.probability = result.getProbabilityEstimate()};
  // Negative where there is none.
  if (const double variation = result.getCoefficientOfVariation(); estimate.probability > 0 && variation >= 0)
    estimate.coefficient_of_variation = variation;
  return estimate;
}

}  // namespace

ReliabilityResult failure_probability(const StudyFile& study, const StudyReliability& reliability,
                                      const StudyEvaluation& evaluate, const StudyDerivatives& derivatives) {
  using Method = StudyReliability::Method;
  OT::RandomGenerator::SetSeed(study.seed);
  int not_done = 0;
  const StudyEvaluation counted = [&](const StudyPoints& points) {
    StudyPoints quantities = evaluate(points);
    not_done += static_cast<int>(
        std::count_if(quantities.begin(), quantities.end(), [](const auto& row) { return row.empty(); }));
    return quantities;
  };
  const bool searches = reliability.method != Method::monte_carlo;
  const double scale = searches ? scale_of(study, reliability, counted) : 1;
  // To a simulation what is not done does not fail; a search does not go there.
  const bool above = reliability.fails_above;
  const auto counts = [&](bool where_above) {
    return limit_event(study, reliability, counted, derivatives, scale, above ? -1 : 1, where_above);
  };
  if (!searches) {
    ReliabilityResult result = simulated(reliability, counts(above), OT::MonteCarloExperiment());
    result.not_done = not_done;
    return result;
  }
  const OT::RandomVector event = limit_event(study, reliability, counted, derivatives, scale,
                                             std::numeric_limits<double>::quiet_NaN(), above);
  const OT::FORMResult form = form_of(study, reliability, event);
  // What is most likely may fail: then the index is negative, and the rare event is that it does not.
  const bool mostly_fails = form.getIsStandardPointOriginInFailureSpace();
  ReliabilityResult result{.probability = form.getEventProbability(),
                           .reliability_index = (mostly_fails ? -1 : 1) * form.getHasoferReliabilityIndex(),
                           .design_point = from_point(form.getPhysicalSpaceDesignPoint())};
  // Of a limit at the origin there are none, and they are negative.
  const std::vector<double> importance = from_point(form.getImportanceFactors());
  if (std::all_of(importance.begin(), importance.end(), [](double factor) { return factor >= 0; }))
    result.importance = importance;
  if (!std::isfinite(*result.reliability_index))
    throw std::runtime_error(
        "FORM found no design point: variants near it are not done; take \"monte_carlo\"");
  if (reliability.method == Method::form) return result;
  const OT::ImportanceSamplingExperiment around(
      OT::Normal(form.getStandardSpaceDesignPoint(), OT::CovarianceMatrix(result.design_point.size())));
  const OT::StandardEvent standard(counts(above != mostly_fails));
  const ReliabilityResult estimate = simulated(reliability, standard, around);
  result.probability = mostly_fails ? 1 - estimate.probability : estimate.probability;
  result.coefficient_of_variation = estimate.coefficient_of_variation;
  if (mostly_fails && estimate.coefficient_of_variation)
    result.coefficient_of_variation =
        *estimate.coefficient_of_variation * estimate.probability / result.probability;
  result.not_done = not_done;
  return result;
}

}  // namespace nurbeam
