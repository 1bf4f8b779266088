#include "pipelines/study/openturns_study.h"

namespace nurbeam {

namespace {

/// All combinations of so many values of each variable, from end to end of its range.
StudyPoints grid_points(const StudyFile& study, const std::vector<int>& levels) {
  const OT::Interval range = joint_distribution(study).getRange();
  StudyPoints points{{}};
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double lower = range.getLowerBound()[k], upper = range.getUpperBound()[k];
    StudyPoints longer;
    for (const std::vector<double>& point : points)
      for (int level = 0; level < levels[k]; ++level) {
        longer.push_back(point);
        longer.back().push_back(levels[k] == 1 ? (lower + upper) / 2
                                               : lower + (upper - lower) * level / (levels[k] - 1));
      }
    points = std::move(longer);
  }
  return points;
}

}  // namespace

StudyPoints plan_points(const StudyFile& study, const StudyPlan& plan) {
  OT::RandomGenerator::SetSeed(study.seed);
  const auto count = static_cast<std::size_t>(plan.count);
  switch (plan.kind) {
    case StudyPlan::Kind::list:
      return plan.rows;
    case StudyPlan::Kind::grid:
      return grid_points(study, plan.levels);
    case StudyPlan::Kind::latin_hypercube:
      return from_sample(OT::LHSExperiment(joint_distribution(study), count).generate());
    case StudyPlan::Kind::sobol:
      return from_sample(
          OT::LowDiscrepancyExperiment(OT::SobolSequence(), joint_distribution(study), count, false)
              .generate());
    case StudyPlan::Kind::monte_carlo:
      return from_sample(joint_distribution(study).getSample(count));
  }
  return {};
}

}  // namespace nurbeam
