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

}  // namespace
}  // namespace nurbeam
