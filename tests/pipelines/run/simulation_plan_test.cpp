#include "pipelines/run/simulation_plan.h"

#include <gtest/gtest.h>

#include <string>

namespace nurbeam {
namespace {

// Ten joules of kinetic energy, one of which comes from nowhere.
SimulationReport run_that_wins_energy() {
  SimulationReport run;
  run.peak_kinetic_energy = 10;
  run.energy_drift = 1;
  return run;
}

std::string cure(const CaseFile& c) {
  const auto warning = energy_warning(c, run_that_wins_energy());
  return warning ? warning->message.substr(warning->message.find(';')) : "no warning";
}

TEST(EnergyWarning, NamesTheFormOfTheElementsWhereItIsTheCause) {
  CaseFile c;
  c.beams.resize(2);
  EXPECT_NE(cure(c).find("take more elements"), std::string::npos) << cure(c);
  c.beams[1].form = Form::virtual_work;
  EXPECT_NE(cure(c).find("\"form\": \"virtual-work\""), std::string::npos) << cure(c);
  EXPECT_EQ(cure(c).find("elements or"), std::string::npos) << cure(c);
}

TEST(FoldWarning, RingsWhereAnElementTurnsRoundAndNamesTheCause) {
  CaseFile c;
  c.path = "c.json";
  EXPECT_FALSE(fold_warning(c, {.value = 0.19, .beam = "r", .s = 7.2, .time = 0.5}));
  const auto warning = fold_warning(c, {.value = 0.23, .beam = "r", .s = 7.2, .time = 0.5});
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->severity, Severity::warning);
  for (const char* part : {"\"r\" folds back", "s = 7.2 m", "t = 0.5 s", "R = 0.23", "more elements"})
    EXPECT_NE(warning->message.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace nurbeam
