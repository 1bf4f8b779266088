#include "pipelines/run/closing_lines.h"

#include <gtest/gtest.h>

#include "pipelines/diagnostics/readable_quantity.h"

namespace nurbeam::of_closing_lines {
namespace {

RunSummary tube() {
  RunSummary summary;
  summary.extremes = {
      {"tube.axial_force.max", "N", 1.2e5, 0.0, 0},         {"tube.stress.max", "Pa", -1.37e8, 0.25, 0.5},
      {"tube.displacement.max", "m", 1.6577e-3, 0.95, 0.5}, {"other.displacement.max", "m", 1e-3, 0.1, 0.2},
      {"A.force", "N", 302.25, std::nullopt, 0.5},          {"energy.axial", "J", 0.25, std::nullopt, 0.5},
      {"energy.bending", "J", 0.5, std::nullopt, 0.5}};
  summary.diagnostics = {{Severity::warning, "tube.json", "is soft"},
                         {Severity::note, "tube.json", "is a tube"}};
  summary.energy_drift = 1e-6;
  return summary;
}

TEST(ClosingLines, AreFourWithExtremesEnergyWarningsAndThePage) {
  SimulationReport run;
  run.peak_kinetic_energy = 2e-4;
  const auto lines = closing_lines(tube(), run, true, "out", true);
  ASSERT_EQ(lines.size(), 4u);
  for (const char* part :
       {"displacement 1.658 mm (tube, s = 0.95 m, t = 0.5 s)", "stress -137 MPa (tube, s = 0.25 m",
        "tension 120 kN (tube", "support force 302.2 N (A"})
    EXPECT_NE(lines[0].find(part), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("0.5 %"), std::string::npos) << lines[1];
  EXPECT_EQ(lines[2], "1 warning, 1 note: see above, or run.json");
  EXPECT_EQ(lines[3], "open out/report.html");
}

TEST(ClosingLines, OfStaticsHaveNoTimesButTheStrainEnergy) {
  RunSummary summary = tube();
  summary.diagnostics.clear();
  const auto lines = closing_lines(summary, {}, false, "out", false);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].find("t = "), std::string::npos) << lines[0];
  EXPECT_EQ(lines[1], "strain energy 750 mJ");
  EXPECT_EQ(lines[2], "no warnings");
  EXPECT_EQ(lines[3], "results in out");
}

TEST(ReadableQuantity, HasThePrefixThatPeopleWrite) {
  EXPECT_EQ(readable(0.0016577, "m"), "1.658 mm");
  EXPECT_EQ(readable(450, "m"), "450 m");
  EXPECT_EQ(readable(1.37e8, "Pa"), "137 MPa");
  EXPECT_EQ(readable(-33485.3, "N"), "-33.49 kN");
  EXPECT_EQ(readable(999.99, "N"), "1 kN");
  EXPECT_EQ(readable(0, "N"), "0 N");
  EXPECT_EQ(readable(12.5, "m/s"), "12.5 m/s");
}

}  // namespace
}  // namespace nurbeam::of_closing_lines
