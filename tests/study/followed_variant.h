#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "pipelines/model/model_snapshot.h"
#include "pipelines/run/simulation_plan.h"
#include "pipelines/study/gradient.h"
#include "tests/study/study_of_case.h"

namespace nurbeam::test {

/// A variant with derivatives as a study runs it, and what these took.
struct FollowedVariant {
  StudyGradient gradient = {};
  std::vector<double> quantities = {};
  Sensitivities::Work work = {};
  std::vector<RunEvent> events = {};
  long steps = 0;
};

/// `as`: what follows the run instead of the follower that the gradient has.
inline FollowedVariant followed(const StudyOfCase& of,
                                const std::function<std::unique_ptr<RunFollower>(RunFollower&)>& as = {}) {
  FollowedVariant variant;
  const std::vector<double> values = all_values(of.study, of.nominal());
  const CaseFileReport read =
      read_case_text(of.study_case.variant(of.study.variables, values), of.study_case.file());
  const BuildReport built = build_model(*read.value);
  VariantGradient gradient(of.study, of.study_case, values, *read.value, *built.value);
  Histories histories(of.study, *built.value);
  SimulationObserver observer;
  const std::unique_ptr<RunFollower> other = as ? as(gradient.follower()) : nullptr;
  observer.follower = other ? other.get() : &gradient.follower();
  observer.snapshot = [&](const Snapshot& snapshot) { histories.add(snapshot); };
  const SimulationReport run =
      simulate(built.value->model, probe_places(*built.value), simulation_options(*read.value), observer);
  EXPECT_EQ(run.status, SimulationStatus::done);
  variant.gradient = gradient.of_quantities(histories, run.events);
  variant.work = dynamic_cast<const Sensitivities&>(gradient.follower()).work();
  variant.events = run.events;
  variant.steps = run.steps;
  const ExpressionScope scope = scope_of_run(of.study, values, histories, built.value->model, run.events);
  for (const StudyQuantity& quantity : of.study.quantities)
    variant.quantities.push_back(quantity.value.number(scope));
  return variant;
}

}  // namespace nurbeam::test
