#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::of_extremes {
namespace {

using std::numbers::pi;

struct RunOf {
  test::CaseRun run;
  nlohmann::json list;

  const nlohmann::json& of(const std::string& quantity) const {
    for (const nlohmann::json& each : list)
      if (each.at("quantity") == quantity) return each;
    throw std::out_of_range("no extreme " + quantity);
  }
  double value(const std::string& quantity) const { return of(quantity).at("value"); }
  double place(const std::string& quantity) const { return of(quantity).at("s [m]"); }
  double time(const std::string& quantity) const { return of(quantity).at("time [s]"); }
};

RunOf extremes_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const test::TemporaryDirectory directory;
  const auto file = directory.write("case.json", text);
  const auto results = directory.path() / "out";
  std::vector<std::string> words = {"run", file.string(), "--quiet", "--out", results.string()};
  for (const std::string& override : overrides) words.insert(words.end(), {"--set", override});
  std::ostringstream out, err;
  const test::CapturedErrors errors;
  RunOf found;
  found.run.code = run_command_line(words, out, err);
  found.run.messages = err.str() + errors.text();
  EXPECT_EQ(found.run.code, 0) << found.run.messages;
  test::read_histories(results / "histories.csv", found.run);
  std::ifstream stream(results / "run.json");
  found.list = nlohmann::json::parse(stream).at("extremes");
  return found;
}

std::string with_elements(int count) { return "beams[0].elements={\"count\":" + std::to_string(count) + "}"; }

const std::string bar = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] },
    "section": { "radius": "10 mm" }, "material": "steel" }],
  "supports": [{ "beam": "b", "at": "start", "type": "pinned" }, { "beam": "b", "at": "end", "type": "pinned" }],
  "loads": [{ "beam": "b", "force_per_length": [0, 0, -10] }], "analysis": { "type": "static" },
  "output": { "report": false } })";

// 5 q L^4/(384 EI) and q L^2/8 at the middle.
TEST(Extremes, OfASimplySupportedBarAreRightWithAnyNumberOfElements) {
  const double EI = 2.1e11 * pi / 4 * 1e-8, sag = 5 * 10 / (384 * EI), moment = 10. / 8,
               stress = moment * 0.01 / (pi / 4 * 1e-8);
  for (const std::string& torsion : {std::string("false"), std::string("true")})
    for (int count = 1; count <= 5; ++count) {
      const RunOf found = extremes_of(bar, {with_elements(count), "beams[0].torsion=" + torsion});
      EXPECT_NEAR(found.value("b.displacement.max"), sag, 2e-4 * sag) << count << torsion;
      EXPECT_NEAR(found.place("b.displacement.max"), 0.5, 1e-3) << count;
      EXPECT_NEAR(std::abs(found.value("b.moment.max")), moment, 2e-4 * moment) << count;
      EXPECT_NEAR(found.place("b.moment.max"), 0.5, 1e-3) << count;
      EXPECT_NEAR(std::abs(found.value("b.stress.max")), stress, 2e-3 * stress) << count;
      EXPECT_NEAR(found.run.last("b.displacement.max [m]"), sag, 2e-4 * sag) << count;
    }
}

// P a b/L under the force, which stands inside an element; the force of a body is one there.
TEST(Extremes, AreFoundUnderAForceInsideAnElement) {
  const double a = 0.3, P = 25, moment = P * a * (1 - a);
  for (int count = 1; count <= 4; ++count) {
    const RunOf found = extremes_of(
        bar,
        {with_elements(count), "loads=null", "analysis={\"type\": \"static\"}", "gravity=[0, 0, -10]",
         "beams[0].material={\"density\": 1e-3, \"youngs_modulus\": 2.1e11}",
         R"(bodies=[{"name": "m", "mass": 2.5}])",
         R"(sliding_joints=[{"body": "m", "beam": "b", "at": {"length": 0.3}, "carried_as": "point", "equilibrium": "held"}])"});
    EXPECT_NEAR(std::abs(found.value("b.moment.max")), moment, 1e-3 * moment) << count;
    EXPECT_NEAR(found.place("b.moment.max"), a, 1e-6) << count;
  }
}

// A weight that is let go on a spring swings to twice its static force; stored rows are far apart.
const std::string swing = R"({ "nurbeam": 1, "gravity": [0, 0, -10],
  "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": "10 mm" },
    "material": { "density": 2000, "youngs_modulus": 2e9 }, "elements": { "count": 6 } }],
  "supports": [{ "beam": "b", "at": "start", "type": "clamped", "name": "wall" }],
  "analysis": { "end_time": 1, "step": 1e-3 }, "output": { "report": false } })";

TEST(Extremes, OfAMotionAreThoseOfAllStepsAndNotOfStoredRows) {
  for (const char* step : {"analysis.step=1e-3", "analysis.step=null"}) {
    const RunOf each = extremes_of(swing, {step, "output.every=1e-3"}),
                few = extremes_of(swing, {step, "output.every=1"});
    ASSERT_EQ(few.run.rows.size(), 2u);
    for (const char* quantity : {"wall.force", "wall.couple", "b.displacement.max", "b.moment.max",
                                 "b.stress.max", "energy.kinetic", "energy.bending"}) {
      const double right = std::abs(each.value(quantity));
      EXPECT_NEAR(std::abs(few.value(quantity)), right, 0.03 * right) << quantity << " " << step;
      EXPECT_GT(few.time(quantity), 0) << quantity;
      EXPECT_LT(few.time(quantity), 1) << quantity;
    }
  }
}

// A pendulum that swings through the upright: below its chord means nothing there.
TEST(Sag, IsLeftEmptyWhereTheChordIsUpright) {
  const test::TemporaryDirectory directory;
  const test::CaseRun run = test::run_file(directory.write("case.json", R"({ "nurbeam": 1,
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": "2 mm" },
      "material": { "density": 2000, "youngs_modulus": 2e9 }, "elements": { "count": 6 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" }],
    "analysis": { "end_time": 0.8 }, "output": { "report": false, "every": 0.005 } })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  std::size_t empty = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double sag = run.value(i, "b.sag [m]");
    empty += std::isnan(sag) ? 1 : 0;
    EXPECT_FALSE(sag > 1) << i;
  }
  EXPECT_GT(empty, 0u);
  EXPECT_LT(empty, run.rows.size() / 4);
}

// A bead on a rail from 4 m up, which it leaves; it then falls for 2 s and is faster.
TEST(Extremes, OfABodyThatLeavesItsBeamAreThoseOnTheBeam) {
  const std::string chute = R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[0, 0, 0], [3, 0, -4]] } }],
    "bodies": [{ "name": "bead", "mass": 5 }],
    "sliding_joints": [{ "body": "bead", "beam": "rail", "at": "start" }],
    "analysis": { "end_time": 3 }, "output": { "report": false, "every": 0.5 } })";
  for (const char* step : {"analysis.step=null", "analysis.step=0.007"}) {
    const RunOf found = extremes_of(chute, {step});
    EXPECT_NEAR(found.value("bead.speed"), std::sqrt(2 * 9.81 * 4), 1e-3) << step;
    EXPECT_NEAR(found.place("bead.speed"), 5, 1e-6);
    EXPECT_NEAR(found.value("bead.joint_force"), 5 * 9.81 * 0.6, 1e-3);
    EXPECT_NEAR(found.value("energy.kinetic"), 5 * 9.81 * 4, 0.2) << step;
    EXPECT_GT(found.run.last("bead.speed [m/s]"), 20);
    EXPECT_GT(found.run.last("energy.kinetic [J]"), 5 * 9.81 * 8);
  }
}

// A load hangs below the bead: it falls with it, while a second bead on the level stays on its rail.
TEST(Extremes, OfWhatHangsOnABodyThatHasLeftAreThoseBefore) {
  const std::string chute = R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[0, 0, 0], [3, 0, -4]] } },
      { "name": "level", "rigid": true, "axis": { "polyline": [[0, 5, 0], [100, 5, 0]] } }],
    "bodies": [{ "name": "bead", "mass": 5 }, { "name": "load", "mass": 20, "position": [0, 0, -1] },
      { "name": "other", "mass": 3 }],
    "connectors": [{ "name": "rod", "type": "rod", "from": { "body": "bead" }, "to": { "body": "load" } }],
    "sliding_joints": [{ "body": "bead", "beam": "rail", "at": "start" },
      { "body": "other", "beam": "level", "at": "start", "speed": 2 }],
    "analysis": { "end_time": 3, "step": 0.002 }, "output": { "report": false, "every": 0.5 } })";
  const RunOf found = extremes_of(chute);
  const double speed = found.value("load.speed"), left = 0.98;  // it leaves at 0.974 s
  EXPECT_LT(found.time("load.speed"), left);
  EXPECT_LT(speed, 12);
  EXPECT_GT(found.run.last("load.speed [m/s]"), 20);
  EXPECT_NEAR(found.value("other.speed"), 2, 1e-9);
  // All that the two may have is the height that both have lost, and the other's energy.
  EXPECT_LT(found.value("energy.kinetic"), 25 * 9.81 * 4.1 + 6);
  EXPECT_LT(found.time("energy.kinetic"), left);
}

// From 5 m up down a straight slope into the parabola z = x^2: at its bottom v^2 = 2 g 5, m (g + 2 v^2).
TEST(Extremes, OfBodiesOnRailsAreFoundWithinSteps) {
  const std::string valley = R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "rail", "rigid": true, "axis": { "nurbs": { "degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 3, 3, 3],
      "control_points": [[-3, 0, 5], [-2, 0, 3], [-1, 0, 1], [0, 0, -1], [1, 0, 1], [2, 0, 3], [3, 0, 5]] } } }],
    "bodies": [{ "name": "bead", "mass": 5 }],
    "sliding_joints": [{ "body": "bead", "beam": "rail", "at": "start" }],
    "analysis": { "end_time": 1.8 }, "output": { "report": false, "every": 1.8 } })";
  constexpr double g = 9.81, force = 5 * (g + 2 * 2 * g * 5), place = 2 * 2.23606797749979 + 1.47894285754;
  for (const char* integrator : {R"({"type": "radau"})", R"({"type": "generalized-alpha"})"}) {
    const bool is_exact = std::string(integrator).find("radau") != std::string::npos;
    const RunOf found =
        extremes_of(valley, {std::string("analysis.integrator=") + integrator,
                             std::string("analysis.tolerance=") + (is_exact ? "1e-4" : "1e-6")});
    EXPECT_NEAR(found.value("bead.joint_force"), force, 0.005 * force) << integrator;
    EXPECT_NEAR(found.place("bead.joint_force"), place, 0.02) << integrator;
    EXPECT_NEAR(found.value("bead.speed"), std::sqrt(2 * g * 5), 0.005 * std::sqrt(2 * g * 5)) << integrator;
  }
}

// Along a rail of many segments, at whose ends steps end: as with steps that are short beside it.
TEST(Extremes, OfACoasterAreThoseOfShortSteps) {
  std::string points;
  for (int i = 0; i <= 60; ++i) {
    const double x = 1.2 * i, z = 20 * std::exp(-x * x / 100) + 9 * std::exp(-(x - 40) * (x - 40) / 64);
    points += (i == 0 ? "" : ", ") + ("[" + std::to_string(x) + ", 0, " + std::to_string(z) + "]");
  }
  const std::string coaster =
      R"({ "nurbeam": 1, "beams": [{ "name": "rail", "rigid": true, "axis": { "through": [)" + points +
      R"(] } }], "bodies": [{ "name": "car", "mass": 500 }],
    "sliding_joints": [{ "body": "car", "beam": "rail", "at": "start", "speed": 3 }],
    "analysis": { "end_time": 5 }, "output": { "report": false, "every": 5 } })";
  // With the tolerance of models of guides alone, which stands when none is given.
  const RunOf within = extremes_of(coaster), stepped = extremes_of(coaster, {"analysis.step=5e-4"});
  for (const char* quantity : {"car.joint_force", "car.speed"}) {
    const double right = stepped.value(quantity);
    EXPECT_NEAR(within.value(quantity), right, 0.005 * right) << quantity;
  }
}

// The rail is a steel tube on posts: its steps are as short as the car takes for a part of an element.
TEST(Extremes, OfACoasterOnPostsAreThoseOfShortSteps) {
  const auto height = [](double x) { return 6 * std::exp(-x * x / 40); };
  std::string points, posts;
  for (int i = 0; i <= 20; ++i) {
    const double x = 1.2 * i;
    const std::string point = "[" + std::to_string(x) + ", 0, " + std::to_string(height(x)) + "]";
    points += (i == 0 ? "" : ", ") + point;
    if (i % 4 == 0)
      posts += std::string(i == 0 ? "" : ", ") + R"({ "beam": "rail", "type": "pinned", "name": "post )" +
               std::to_string(i) + R"(", "at": )" +
               (i == 0    ? R"("start")"
                : i == 20 ? R"("end")"
                          : R"({ "near": )" + point + "}") +
               "}";
  }
  const std::string coaster = R"({ "nurbeam": 1, "beams": [{ "name": "rail", "axis": { "through": [)" +
                              points +
                              R"(] }, "section": { "radius": "75 mm", "bore": "65 mm" },
        "material": { "name": "steel", "stiffness_damping": 1e-4 }, "elements": { "max_length": 1.5 } }],
    "bodies": [{ "name": "car", "mass": 500 }], "supports": [)" +
                              posts + R"(],
    "sliding_joints": [{ "body": "car", "beam": "rail", "at": { "length": 0.5 }, "speed": 3 }],
    "analysis": { "initial": "equilibrium", "end_time": 2 }, "output": { "report": false, "every": 2 } })";
  const RunOf adaptive = extremes_of(coaster), stepped = extremes_of(coaster, {"analysis.step=3e-4"});
  for (const auto& [quantity, part] :
       {std::pair{"car.joint_force", 0.02}, {"car.speed", 0.002}, {"post 8.force", 0.03}}) {
    const double right = stepped.value(quantity);
    EXPECT_NEAR(adaptive.value(quantity), right, part * right) << quantity;
  }
}

TEST(Extremes, OfAModeAreThoseOfItsShape) {
  const RunOf found = extremes_of(
      bar, {with_elements(1), "loads=null", R"(analysis={"type": "modes", "modes": {"count": 1}})"});
  EXPECT_GT(found.run.last("b.displacement.max [m]"), 1e-3);
}

}  // namespace
}  // namespace nurbeam::of_extremes
