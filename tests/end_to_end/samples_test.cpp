#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "cad_import/import_curves.h"
#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"
#include "tests/support/straight_frame.h"

namespace nurbeam {
namespace {

/// What makes a sample quick, by its path below samples/.
const std::map<std::string, std::vector<std::string>> shortened = {
    {"falling_beam/falling_beam.json",
     {"beams[0].elements.count=6", "analysis.step=2e-3", "analysis.end_time=0.2"}},
    {"papers/falling_beam.json",
     {"beams[0].elements.count=5", "analysis.step=2e-3", "analysis.end_time=0.3"}},
    {"papers/suspended_beam.json", {"analysis.step=2e-3", "analysis.end_time=0.3"}},
    {"papers/semicircle_as_drawn.json",
     {"beams[0].elements.count=8", "analysis.step=2e-3", "analysis.end_time=0.3"}},
    {"papers/semicircle_straight.json",
     {"beams[0].elements.count=8", "analysis.step=2e-3", "analysis.end_time=0.3",
      "beams[0].element=ale-ancf"}},
    {"zipline/zipline.json",
     {"beams[0].elements.count=12", "analysis.step=5e-3", "analysis.end_time=0.5",
      "output.cad.times=[0,0.5]"}},
    {"papers/pendulum.json", {"analysis.end_time=0.2"}},
    {"papers/pendulum_own.json", {"analysis.end_time=0.2"}},
    {"papers/pendulum_extreme.json", {"analysis.end_time=0.2"}},
    {"roller_coaster/roller_coaster.json", {"analysis.end_time=0.2"}},
    {"en50318/en50318.json", {"analysis.end_time=0.05"}},
    {"rail/rail.json", {"analysis.end_time=0.05", "output.cad=null"}},
};

bool is_study(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return text.find("\"nurbeam_study\"") != std::string::npos;
}

TEST(Samples, EveryCaseRunsAndFillsItsResults) {
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(test::source_directory() / "samples")) {
    if (entry.path().extension() != ".json" || is_study(entry.path())) continue;
    const std::string name = entry.path().lexically_relative(test::sample("")).string();
    SCOPED_TRACE(name);
    const auto overrides = shortened.find(name);
    const test::CaseRun run = test::run_file(
        entry.path(), overrides == shortened.end() ? std::vector<std::string>{} : overrides->second);
    EXPECT_EQ(run.code, 0) << run.messages;
    EXPECT_FALSE(run.left_half_files());
    EXPECT_FALSE(run.rows.empty());
    for (const char* file : {"histories.csv", "results.nc", "run.json"})
      EXPECT_NE(std::find(run.files.begin(), run.files.end(), file), run.files.end()) << file;
  }
}

// R^2 L (cos^2/GJ + sin^2/EI) + L sin^2/EA, by the energy of a small force.
TEST(Samples, TheSpringHasTheStiffnessOfItsClosedForm) {
  const double R = 0.02, pitch = 0.012, r = 0.0015, E = 206e9, G = 79.3e9, F = 0.01;
  const double climb = pitch / (2 * std::numbers::pi), turn = std::hypot(R, climb);
  const double L = 10 * std::numbers::pi * turn, sine = climb / turn, cosine = R / turn;
  const double A = std::numbers::pi * r * r, I = A * r * r / 4;
  const double compliance =
      R * R * L * (cosine * cosine / (G * 2 * I) + sine * sine / (E * I)) + L * sine * sine / (E * A);
  const test::CaseRun run =
      test::run_file(test::sample("spring/spring.json"),
                     {"loads[0].force=[0,0,0.01]", "loads[1].moment=[0,2e-4,0]", "output.cad=null"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double energy = run.last("energy.axial [J]") + run.last("energy.bending [J]");
  EXPECT_NEAR(2 * energy / (F * F), compliance, 1e-3 * compliance);
  EXPECT_NEAR(std::abs(run.last("end.torque [N m]")), F * R * cosine, 1e-3 * F * R);
}

// v^2 = v_0^2 + 2 g (z_0 - z), with the roll and a rail that gives, down the first slope.
TEST(Samples, TheRollerCoasterRunsDownAsItsHeightSays) {
  const test::CaseRun run = test::run_file(test::sample("roller_coaster/roller_coaster.json"),
                                           {"analysis.end_time=2.4", "output.report=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const auto square_of_speed = [&](std::size_t row) {
    return std::pow(run.value(row, "car.vx [m/s]"), 2) + std::pow(run.value(row, "car.vy [m/s]"), 2) +
           std::pow(run.value(row, "car.vz [m/s]"), 2);
  };
  const double fallen = run.value(0, "car.z [m]") - run.last("car.z [m]");
  const double expected = square_of_speed(0) + 2 * 9.81 * fallen;
  EXPECT_GT(fallen, 1);
  EXPECT_NEAR(square_of_speed(run.rows.size() - 1), expected, 0.02 * expected);
}

// The Kirchhoff rod of docs/verification.md (`nurbeam verify torsion`), by an initial value problem.
TEST(Samples, TheBendOf45DegreesGoesWhereARodDoes) {
  const test::CaseRun run = test::run_file(test::sample("bend45/bend45.json"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const Eigen::Vector3d tip(run.last("tip.x [m]"), run.last("tip.y [m]"), run.last("tip.z [m]"));
  EXPECT_LT((tip - Eigen::Vector3d(15.685355756, 47.152150168, 53.471762721)).norm(), 2e-3);
}

// A frame of straight elements along the drawn axis: sag and the stress at an anchor.
TEST(Samples, ThePipeRunBendsAsAFrameDoes) {
  const double E = 210e9, r = 0.03015, bore = 0.02725, A = std::numbers::pi * (r * r - bore * bore),
               I = A * (r * r + bore * bore) / 4;
  const ImportReport report = import_curves(test::sample("pipe_run/pipe_run.step"));
  nurbeam::testing::StraightFrame frame{E * A, E * I, E / 2.6 * 2 * I, {}};
  for (const ImportedCurve& piece : report.curves) {  // in the order of the run
    if (!piece.is_centre_line()) continue;
    const KnotVector& knots = piece.curve.knots();
    for (int i = frame.nodes.empty() ? 0 : 1; i <= 24; ++i)
      frame.nodes.push_back(piece.curve.point(knots.start() + (knots.end() - knots.start()) * i / 24));
  }
  const Eigen::Vector3d load(0, 0, -22.9 - 9.81 * 7850 * A);
  const test::CaseRun run =
      test::run_file(test::sample("pipe_run/pipe_run.json"), {"output.cad.formats=[\"step\"]"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double sag = frame.sag(load);
  EXPECT_NEAR(run.last("pipe.displacement.max [m]"), sag, 0.02 * sag);

  const Eigen::Matrix<double, 6, 1> given = frame.start_reaction(load);
  const Eigen::Vector3d t = (frame.nodes[1] - frame.nodes[0]).normalized(), M = given.tail<3>();
  const double torque = M.dot(t), bending = (M - torque * t).norm(), axial = given.head<3>().dot(t);
  const double sigma = std::abs(axial) / A + bending * r / I, tau = torque * r / (2 * I);
  const double von_mises = std::sqrt(sigma * sigma + 3 * tau * tau);
  EXPECT_NEAR(run.last("at lower anchor.von_mises [Pa]"), von_mises, 0.02 * von_mises);
}

// Where the trolley stands the load swings with the period of a pendulum.
TEST(Samples, TheLoadOfTheCableCraneSwingsAsAPendulum) {
  const test::CaseRun run =
      test::run_file(test::sample("cable_crane/cable_crane.json"), {"output.report=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const auto swing = [&](std::size_t row) {
    return run.value(row, "load.x [m]") - run.value(row, "trolley.x [m]");
  };
  std::vector<double> passes;  // forwards, while the trolley is held
  for (std::size_t row = 160; row + 1 < run.rows.size(); ++row)
    if (const double a = swing(row), b = swing(row + 1); a < 0 && b >= 0)
      passes.push_back(run.value(row, "time [s]") - 0.1 * a / (b - a));
  ASSERT_GE(passes.size(), 2u);
  const double length = 6 + 900 * 9.81 / 400e3, period = 2 * std::numbers::pi * std::sqrt(length / 9.81);
  EXPECT_NEAR(passes[1] - passes[0], period, 2e-3 * period);
}

// Its centre of mass runs as fast as it has fallen, but for what the rope has taken: 7 %. What it moves and
// strains, sinks and loses by its damping, and what is in the couplings, says how much.
TEST(Samples, TheTrainRunsAsFastAsItHasFallen) {
  const test::CaseRun run =
      test::run_file(test::sample("trolley_train/trolley_train.json"), {"output.report=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  double square = 0, fallen = 0;
  const std::size_t row = 80;  // at 4 s
  for (const std::string body : {"first", "second", "third"}) {
    square +=
        std::pow(run.value(row, body + ".vx [m/s]"), 2) + std::pow(run.value(row, body + ".vz [m/s]"), 2);
    fallen += run.value(0, body + ".z [m]") - run.value(row, body + ".z [m]");
  }
  EXPECT_GT(fallen, 2.5);
  const auto of_rope = [&](std::size_t i) {
    double sum = run.value(i, "energy.dissipated [J]");
    for (const char* part : {"kinetic", "gravity", "axial", "bending", "spring"})
      sum += run.value(i, std::string("energy.") + part + " [J]");
    for (const std::string body : {"first", "second", "third"})
      sum -=
          60 * (std::pow(run.value(i, body + ".speed [m/s]"), 2) / 2 + 9.81 * run.value(i, body + ".z [m]"));
    return sum;
  };
  const double taken = (of_rope(row) - of_rope(0)) / (60 * 9.81 * fallen);
  EXPECT_NEAR(taken, 0.07, 0.02);
  EXPECT_NEAR(square / (2 * 9.81 * fallen), 1 - taken, 1e-3);
}

// The inner droppers carry their fields of 8 m and a clamp, the wire is level, and no energy is lost on the
// way.
TEST(Samples, TheCatenarySpanIsLevelOnItsDroppers) {
  const test::CaseRun run =
      test::run_file(test::sample("catenary_span/catenary_span.json"), {"output.report=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double share = (8 * 8900 * 150e-6 + 0.2) * 9.81;
  EXPECT_NEAR(run.value(0, "dropper 3.force [N]"), share, 1e-2);
  EXPECT_NEAR(run.value(0, "dropper 4.force [N]"), share, 1e-2);
  EXPECT_NEAR(run.value(0, "dropper place.uz [m]"), 0, 1e-9);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 1e-3);
}

}  // namespace
}  // namespace nurbeam
