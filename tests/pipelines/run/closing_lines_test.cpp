#include "pipelines/run/closing_lines.h"

#include <gtest/gtest.h>

#include "pipelines/diagnostics/readable_quantity.h"

namespace nurbeam::of_closing_lines {
namespace {

const CaseAnalysis motion{}, statics{.type = CaseAnalysis::Type::statics};

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

TEST(ClosingLines, HaveExtremesEnergyWarningsAndThePage) {
  SimulationReport run;
  run.peak_kinetic_energy = 2e-4;
  const auto lines = closing_lines(tube(), run, motion, "out", true);
  const std::vector<std::string> expected = {
      "largest displacement 1.658 mm (tube, s = 0.95 m, t = 0.5 s)",
      "        stress -137 MPa (tube, s = 0.25 m, t = 0.5 s)",
      "        tension 120 kN (tube, s = 0 m, t = 0 s)",
      "        support force 302.2 N (A, t = 0.5 s)",
      "energy balance kept to 0.001 mJ, 0.5 % of the energy that moves",
      "1 warning, 1 note: see above, or run.json",
      "open out/report.html"};
  EXPECT_EQ(lines, expected);
}

TEST(ClosingLines, OfStaticsHaveNoTimesButTheStrainEnergy) {
  RunSummary summary = tube();
  summary.diagnostics.clear();
  const auto lines = closing_lines(summary, {}, statics, "out", false);
  ASSERT_EQ(lines.size(), 7u);
  for (const std::string& line : lines) EXPECT_EQ(line.find("t = "), std::string::npos) << line;
  EXPECT_EQ(lines[4], "strain energy 750 mJ");
  EXPECT_EQ(lines[5], "no warnings");
  EXPECT_EQ(lines[6], "results in out");
}

// An arch has no tension anywhere: the least compression is none.
TEST(ClosingLines, TellOfTensionAndCompressionTheLarger) {
  RunSummary summary = tube();
  summary.extremes.push_back({"tube.axial_force.min", "N", -9e4, 1.0, 0});
  EXPECT_EQ(closing_lines(summary, {}, statics, "out", false)[2], "        tension 120 kN (tube, s = 0 m)");
  summary.extremes.back().value = -1.5e5;
  EXPECT_EQ(closing_lines(summary, {}, statics, "out", false)[2],
            "        compression 150 kN (tube, s = 1 m)");
  summary.extremes.front().value = -5e4;
  const auto lines = closing_lines(summary, {}, statics, "out", false);
  EXPECT_EQ(lines[2], "        compression 150 kN (tube, s = 1 m)");
  for (const std::string& line : lines) EXPECT_EQ(line.find("tension"), std::string::npos) << line;
}

// The wire of a helical spring is twisted: its normal stress says little.
TEST(ClosingLines, TellOfNormalAndVonMisesStressTheLarger) {
  RunSummary summary = tube();
  summary.extremes.push_back({"tube.von_mises.max", "Pa", 1.2e8, 0.5, 0.25});
  EXPECT_EQ(closing_lines(summary, {}, statics, "out", false)[1],
            "        stress -137 MPa (tube, s = 0.25 m)");
  summary.extremes.back().value = 2e8;
  EXPECT_EQ(closing_lines(summary, {}, statics, "out", false)[1],
            "        von Mises stress 200 MPa (tube, s = 0.5 m)");
}

TEST(ClosingLines, HaveTheForceOfJoints) {
  RunSummary summary;
  summary.extremes = {{"car.speed", "m/s", 20.0, 3.0, 1.0}, {"car.joint_force", "N", 34.5e3, 4.0, 2.0}};
  const auto lines = closing_lines(summary, {}, motion, "out", false);
  EXPECT_EQ(lines[0], "largest joint force 34.5 kN (car, s = 4 m, t = 2 s)");
  EXPECT_EQ(lines[1], "        speed 20 m/s (car, s = 3 m, t = 1 s)");
}

TEST(ClosingLines, ShowNoRoundOff) {
  RunSummary summary = tube();
  summary.round_off = {{"m", 1e-2}, {"N", 1e3}, {"J", 1}};
  const auto lines = closing_lines(summary, {}, statics, "out", false);
  EXPECT_EQ(lines[0], "largest stress -137 MPa (tube, s = 0.25 m)");
  EXPECT_EQ(lines[1], "        tension 120 kN (tube, s = 0 m)");
  EXPECT_EQ(lines[2], "strain energy 0 J");
  EXPECT_EQ(closing_lines(summary, {}, motion, "out", false)[2], "energy balance kept to round-off");
}

TEST(ClosingLines, TellWhoLeftTheBeamAndWhoStopped) {
  RunSummary summary = tube();
  summary.beams = {"tube"};
  summary.bodies = {"bead", "ring"};
  RunEvent leaves, stops;
  leaves = {.time = 1.25, .kind = EventKind::left_beam, .beam = 0, .body = 0, .s = 2.0};
  stops = {.time = 1.5, .kind = EventKind::stopped_at_end, .beam = 0, .body = 1, .s = 0.0};
  summary.events = {leaves, stops, stops, stops, stops};
  const auto lines = closing_lines(summary, {}, motion, "out", false);
  EXPECT_EQ(lines[4], "bead left tube (s = 2 m, t = 1.25 s) and flies on: that is not counted");
  EXPECT_EQ(lines[5], "ring stopped at the end of tube (s = 0 m, t = 1.5 s)");
  EXPECT_EQ(lines[7], "... and 2 more at ends of beams");
}

TEST(ClosingLines, OfLoadStepsHaveTheLoadFactor) {
  const CaseAnalysis steps{.type = CaseAnalysis::Type::statics, .load_factors = {0.5, 1}},
      one{.type = CaseAnalysis::Type::statics, .load_factors = {0.5}};
  EXPECT_EQ(closing_lines(tube(), {}, steps, "out", false)[0],
            "largest displacement 1.658 mm (tube, s = 0.95 m, load factor 0.5)");
  EXPECT_EQ(closing_lines(tube(), {}, steps, "out", false)[3],
            "        support force 302.2 N (A, load factor 0.5)");
  EXPECT_EQ(closing_lines(tube(), {}, one, "out", false)[0],
            "largest displacement 1.658 mm (tube, s = 0.95 m)");
}

// The stress of a rope in an eyelet is no stress of the rope beside it.
TEST(ClosingLines, SayThatAStressIsThatOfALayerOfBending) {
  RunSummary summary = tube();
  summary.extremes[1].layer = 0.0321;
  const auto lines = closing_lines(summary, {}, motion, "out", false);
  EXPECT_EQ(lines[1], "        stress -137 MPa (tube, s = 0.25 m, t = 0.5 s)");
  EXPECT_EQ(lines[2], "          local bending, within 32.1 mm of the kink or clamp there");
  EXPECT_EQ(lines.size(), closing_lines(tube(), {}, motion, "out", false).size() + 1);
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
TEST(ClosingLines, NameTheFeaturesThatNoKnownAnswerCovers) {
  RunSummary summary;
  summary.evidence = {{"torsion", {{"torsion-helix", 3, 2e-7, 4e-6, {}}}},
                      {"snow", {}},
                      {"wind", {{"gale", 1, 0.1, 0.1, {}}}}};
  const auto lines = closing_lines(summary, {}, statics, "out", false);
  EXPECT_EQ(lines[lines.size() - 2],
            "no known answer of nurbeam verify is met within 0.0001 with: snow, wind");
}

}  // namespace nurbeam::of_closing_lines
