// Tension, damping, supports that slide, bodies on connectors: case files with known answers.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

CaseRun run_mechanics(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("case.json", text), overrides);
}

// The largest change of energy.total.
double energy_change(const CaseRun& run) {
  double change = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    change = std::max(change, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
  return change;
}

// 30 m under 20 kN on three droppers of 1 m.
const std::string catenary = R"({
  "nurbeam": 1, "gravity": [0, 0, -9.81],
  "beams": [{ "name": "wire", "axis": { "polyline": [[0, 0, 0], [30, 0, 0]] }, "stress_free": "straight",
              "section": { "area": 1.5e-4, "second_moment": 1e-18 }, "tension": "20 kN",
              "material": { "density": 9000, "youngs_modulus": "120 GPa" }, "elements": { "count": 40 } }],
  "supports": [{ "beam": "wire", "at": "start", "type": "pinned", "name": "left" },
               { "beam": "wire", "at": "end", "type": "pinned" }],
  "loads": [{ "beam": "wire", "at": { "length": 15 }, "force": [0, 0, 0] }],
  "connectors": [
    { "name": "a", "from": { "beam": "wire", "at": { "length": 7.5 } }, "to": { "point": [7.5, 0, 1] },
      "type": "tension-only", "stiffness": "100 kN/m" },
    { "name": "b", "from": { "beam": "wire", "at": { "length": 15 } }, "to": { "point": [15, 0, 1] },
      "type": "tension-only", "stiffness": 1e5, "length": "1 m" },
    { "name": "c", "from": { "beam": "wire", "at": { "length": 22.5 } }, "to": { "point": [22.5, 0, 1] },
      "type": "tension-only", "stiffness": 1e5, "length": "drawn" }],
  "analysis": { "type": "static" },
  "output": { "report": false, "probes": [{ "name": "p", "beam": "wire", "at": { "length": 15 } }] }
})";

TEST(Droppers, CarryAWireAndGoSlack) {
  const CaseRun rest = run_mechanics(catenary);
  ASSERT_EQ(rest.code, 0) << rest.messages;
  EXPECT_NEAR(rest.last("a.force [N]"), 96.80621, 1e-3);
  EXPECT_NEAR(rest.last("b.force [N]"), 99.19854, 1e-3);
  EXPECT_NEAR(rest.last("c.force [N]"), 96.80621, 1e-3);
  const CaseRun lifted = run_mechanics(catenary, {"loads[0].force=[0, 0, 150]"});
  ASSERT_EQ(lifted.code, 0) << lifted.messages;
  EXPECT_NEAR(lifted.last("a.force [N]"), 72.06517, 1e-3);
  EXPECT_EQ(lifted.last("b.force [N]"), 0);
  EXPECT_NEAR(lifted.last("p.uz [m]"), 8.768462e-3, 1e-7);
  const CaseRun slack = run_mechanics(catenary, {"loads[0].force=[0, 0, 300]"});
  ASSERT_EQ(slack.code, 0) << slack.messages;
  for (const char* dropper : {"a", "b", "c"}) EXPECT_EQ(slack.last(std::string(dropper) + ".force [N]"), 0);
  EXPECT_NEAR(slack.last("p.uz [m]"), 37.75944e-3, 1e-6);
  EXPECT_NEAR(slack.last("left.fx [N]"), -20130.07, 0.01);
}

// With lengths as drawn the wire stands level at its droppers, which carry their share of it.
TEST(Droppers, AsDrawnKeepTheirEndsWhereTheyAreDrawn) {
  std::vector<std::string> as_drawn;
  for (const char* i : {"0", "1", "2"})
    as_drawn.push_back(std::string("connectors[") + i + "].length=as-drawn");
  const CaseRun run = run_mechanics(catenary, as_drawn);
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("p.uz [m]"), 0, 1e-9);
  // Each carries the wire halfway to its neighbours.
  for (const char* force : {"a.force [N]", "b.force [N]", "c.force [N]"})
    EXPECT_NEAR(run.last(force), 1.35 * 9.81 * 7.5, 1e-4);
  for (const char* dropper : {"a", "b", "c"}) {
    const std::string name = dropper;
    EXPECT_NEAR(run.last(name + ".length [m]"), 1, 1e-9);
  }
}

TEST(Droppers, ThatWouldHaveToPushAreNamed) {
  const CaseRun run =
      run_mechanics(catenary, {"connectors[1].length=as-drawn", "loads[0].force=[0, 0, 200]"});
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(run.says("connector \"b\" would have to push ")) << run.messages;
}

// The wire on droppers is let go of a force at the middle, which goes slack and taut by turns.
TEST(Droppers, KeepTheEnergyOfAWireThatLiftsThem) {
  std::vector<double> changes;
  for (const double step : {4e-4, 2e-4}) {
    std::ostringstream set;
    set << "analysis={\"end_time\": 0.2, \"step\": " << step << ", \"initial\": \"equilibrium\"}";
    const CaseRun run =
        run_mechanics(catenary, {set.str(), "loads[0].force=[0, 0, 300]", "loads[0].time=[[0, 1], [0.01, 0]]",
                                 "output.every=0.002", "beams[0].elements.count=20"});
    ASSERT_EQ(run.code, 0) << run.messages;
    double kinetic = 0, pull = 0;
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
      kinetic = std::max(kinetic, run.value(i, "energy.kinetic [J]"));
      pull = std::max(pull, run.value(i, "b.force [N]"));
    }
    EXPECT_GT(kinetic, 1);
    EXPECT_GT(pull, 50);
    changes.push_back(energy_change(run) / kinetic);
  }
  EXPECT_LT(changes[1], 2e-3);
  EXPECT_LT(changes[1], 0.5 * changes[0]);
}

const std::string rope = R"({
  "nurbeam": 1, "gravity": [0, 0, -9.81],
  "beams": [{ "name": "post", "axis": { "polyline": [[3, 0, 0], [3, 0, 1]] }, "section": { "radius": 0.01 },
              "material": "steel", "elements": { "count": 2 }, "torsion": false }],
  "supports": [{ "beam": "post", "at": "start", "type": "clamped" }],
  "bodies": [{ "name": "load", "mass": 10, "position": [0, 0, -1], "velocity": [0, 0, -1.5] }],
  "connectors": [{ "name": "rope", "from": { "body": "load" }, "to": { "point": [0, 0, 0] },
                   "type": "tension-only", "stiffness": 4000 }],
  "analysis": { "end_time": 0.98898795, "step": 1e-4 },
  "output": { "report": false, "every": 0.001 }
})";

TEST(Rope, OfAFallingBodyIsTautAndSlackByTurns) {
  const CaseRun run = run_mechanics(rope);
  ASSERT_EQ(run.code, 0) << run.messages;
  // Two periods of 0.4944940 s, of which it is taut for 0.1886836 s.
  EXPECT_NEAR(run.last("load.z [m]"), -1, 1e-5);
  EXPECT_NEAR(run.last("load.vz [m/s]"), -1.5, 1e-4);
  double greatest = 0, taut = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    greatest = std::max(greatest, run.value(i, "rope.force [N]"));
    taut += run.value(i, "rope.force [N]") > 0 ? 0.001 : 0;
  }
  EXPECT_NEAR(greatest, 413.7321, 0.05);
  EXPECT_NEAR(taut, 2 * 0.1886836, 3e-3);
  EXPECT_LT(energy_change(run), 1e-4);
}

TEST(Rope, WithADamperLosesWhatIsBooked) {
  std::vector<double> changes;
  for (const double step : {4e-4, 2e-4, 1e-4}) {
    std::ostringstream set;
    set << "analysis.step=" << step;
    const CaseRun run = run_mechanics(rope, {set.str(), "connectors[0].damping=\"60 N s/m\""});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_GT(run.last("energy.dissipated [J]"), 5);
    changes.push_back(energy_change(run));
  }
  EXPECT_LT(changes[2], 1e-4);
  EXPECT_LT(changes[2], 0.1 * changes[0]);
}

// Falling 0.1 m onto a damper that takes all within a step, or within a thousandth of one: what is lost is
// booked, and what is left is how the stretched rope creeps back, m x'' = m g - k x - c x'.
TEST(Rope, WithADamperStifferThanTheStepsIsNoTrouble) {
  const double m = 10, k = 4000, g = 9.81;
  for (const double c : {1e3, 1e4, 1e5, 1e6}) {
    SCOPED_TRACE(c);
    std::ostringstream damping;
    damping << "connectors[0].damping=" << c;
    const CaseRun run = run_mechanics(
        rope, {damping.str(), "connectors[0].length=1.1", "analysis={\"end_time\": 0.3, \"step\": 4e-3}"});
    ASSERT_EQ(run.code, 0) << run.messages;
    const double met = (std::sqrt(1.5 * 1.5 + 2 * g * 0.1) - 1.5) / g, v = 1.5 + g * met, t = 0.3 - met;
    const double root = std::sqrt(c * c / (4 * m * m) - k / m), q = c / (2 * m) + root, p = k / m / q,
                 rest = m * g / k, slow = (v - q * rest) / (q - p), fast = -rest - slow;
    EXPECT_NEAR(run.last("load.z [m]"), -1.1 - rest - slow * std::exp(-p * t) - fast * std::exp(-q * t),
                3e-5);
    EXPECT_LT(energy_change(run), 5e-4 * (m * v * v / 2));
    for (std::size_t i = 0; i < run.rows.size(); ++i) EXPECT_LT(run.value(i, "load.vz [m/s]"), 0.1);
  }
}

// A pendulum of 2 m from 60 degrees: period 4 K(sin 30) sqrt(l/g).
TEST(Rod, IsAPendulums) {
  const CaseRun run = run_mechanics(
      rope,
      {"connectors[0]={\"name\": \"rod\", \"from\": {\"body\": \"load\"}, \"to\": {\"point\": [0, 0, 0]}, "
       "\"type\": \"rod\"}",
       "bodies[0]={\"name\": \"load\", \"mass\": 3, \"position\": [1.7320508075688772, 0, -1]}",
       "analysis={\"end_time\": 3.0446245519918849, \"step\": 5e-4}"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double period = 4 * std::comp_ellint_1(0.5) * std::sqrt(2 / 9.81);
  EXPECT_NEAR(period, 3.0446245519918849, 1e-12);
  EXPECT_NEAR(run.last("load.x [m]"), std::sqrt(3.0), 1e-5);
  double greatest = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    greatest = std::max(greatest, run.value(i, "rod.force [N]"));
    EXPECT_NEAR(run.value(i, "rod.length [m]"), 2, 1e-10);
  }
  EXPECT_NEAR(greatest, 3 * 9.81 * 2, 1e-3);  // m g (3 - 2 cos 60)
  EXPECT_LT(energy_change(run), 2e-4);
}

// A string of 10 m under 2000 N.
const std::string taut_string = R"({
  "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] }, "tension": 2000,
              "section": { "area": 1e-4, "second_moment": 1e-18 },
              "material": { "density": 5000, "youngs_modulus": 1e10 }, "elements": { "count": 20 } }],
  "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
               { "beam": "string", "at": "end", "type": "guided", "direction": [1, 0, 0], "force": 2000,
                 "mass": 200, "name": "weight" }],
  "analysis": { "type": "static" },
  "output": { "report": false, "probes": [{ "name": "p", "beam": "string", "at": "end" }] }
})";

TEST(Tension, IsThatOfTheDrawingAndOfItsWeight) {
  const CaseRun run = run_mechanics(taut_string);
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("p.ux [m]"), 0, 1e-12);
  EXPECT_NEAR(run.last("string.axial_force.max [N]"), 2000, 1e-6);
  // N = (S + EA eps) lambda.
  const CaseRun heavier = run_mechanics(taut_string, {"supports[1].force=3000"});
  ASSERT_EQ(heavier.code, 0) << heavier.messages;
  const double stretch = 1 + heavier.last("p.ux [m]") / 10;
  EXPECT_NEAR((2000 + 1e6 * (stretch * stretch - 1) / 2) * stretch, 3000, 1e-6);
  EXPECT_NEAR(heavier.last("string.axial_force.max [N]"), 3000, 1e-6);
  EXPECT_NEAR(heavier.last("weight.fx [N]"), 0, 1e-9);
}

// The mass over the pulley and the string as a spring: EA/l = 1e5 N/m, 200 kg and a third of the string's 5
// kg.
TEST(Tension, OfAWeightSwingsWithItsMass) {
  const double omega = std::sqrt((1e6 + 3 * 2000.0) / 10 / (200 + 5.0 / 3));
  std::ostringstream set;
  set.precision(12);
  set << "analysis={\"end_time\": " << 2 * M_PI / omega << ", \"step\": 5e-5}";
  const CaseRun run = run_mechanics(taut_string, {set.str(), "supports[1].force=2010"});
  ASSERT_EQ(run.code, 0) << run.messages;
  double farthest = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) farthest = std::max(farthest, run.value(i, "p.ux [m]"));
  EXPECT_NEAR(run.last("p.ux [m]"), 0, 3e-3 * farthest);
  EXPECT_NEAR(farthest, 2 * 10 / 1e5, 2e-2 * 2 * 10 / 1e5);
  EXPECT_LT(energy_change(run), 1e-7);
}

TEST(Tension, AsksForABeamThatCanBearIt) {
  const CaseRun both = run_mechanics(taut_string, {"beams[0].unstressed_length=9.9"});
  EXPECT_EQ(both.code, 2);
  EXPECT_TRUE(both.says("exclude each other")) << both.messages;
  const CaseRun pointwise = run_mechanics(taut_string, {"beams[0].axial_strain=pointwise"});
  EXPECT_EQ(pointwise.code, 2);
  EXPECT_TRUE(pointwise.says("beams[0].tension: is for the axial strain")) << pointwise.messages;
}

// A free beam falls against its mass damping.
TEST(MassDamping, SlowsAFall) {
  const CaseRun run = run_mechanics(R"({
    "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.01 },
                "material": { "name": "steel", "mass_damping": 0.5 }, "elements": { "count": 4 } }],
    "analysis": { "end_time": 2, "step": 1e-3 },
    "output": { "report": false, "probes": [{ "name": "p", "beam": "b", "at": "start" }] } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("p.vz [m/s]"), -12.402205, 1e-5);
  EXPECT_NEAR(run.last("p.z [m]"), -14.435589, 1e-5);
  EXPECT_LT(energy_change(run), 1e-3);
}

// 800 kg held at 30 m of a rope of 121 m over 120 m, and where it rests.
const std::string loaded_rope = R"({
  "nurbeam": 1, "gravity": [0, 0, -9.81],
  "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 0], [120, 0, 0]] }, "unstressed_length": 121,
              "section": { "area": 1e-4, "second_moment": 1e-18 }, "stress_free": "straight",
              "material": { "density": 25000, "youngs_modulus": 1.5e11 }, "elements": { "count": 48 } }],
  "bodies": [{ "name": "load", "mass": 800 }],
  "sliding_joints": [{ "body": "load", "beam": "rope", "at": { "fraction": 0.24793388429752067 },
                       "slope": "discontinuous", "equilibrium": "held" }],
  "supports": [{ "beam": "rope", "at": "start", "type": "pinned", "name": "left" },
               { "beam": "rope", "at": "end", "type": "pinned" }],
  "analysis": { "type": "static" },
  "output": { "report": false }
})";

TEST(StaticPlace, HeldOrFreeOnAHangingRope) {
  const CaseRun held = run_mechanics(loaded_rope);
  ASSERT_EQ(held.code, 0) << held.messages;
  EXPECT_NEAR(held.last("load.x [m]"), 29.148690, 2e-5);
  EXPECT_NEAR(held.last("load.z [m]"), -7.333208, 2e-5);
  EXPECT_NEAR(held.last("left.fx [N]"), -28077.985, 0.3);
  const CaseRun free = run_mechanics(loaded_rope, {"sliding_joints[0].equilibrium=free"});
  ASSERT_EQ(free.code, 0) << free.messages;
  EXPECT_NEAR(free.last("load.s [m]"), 60, 1e-4);
  EXPECT_NEAR(free.last("load.z [m]"), -8.687985, 2e-5);
}

// A motion that starts where the body rests stays there.
TEST(StaticPlace, FreeAtTheStartOfAMotion) {
  const CaseRun run = run_mechanics(
      loaded_rope, {"sliding_joints[0].equilibrium=free",
                    "analysis={\"end_time\": 1, \"step\": 0.01, \"initial\": \"equilibrium\"}"});
  ASSERT_EQ(run.code, 0) << run.messages;
  for (std::size_t i = 0; i < run.rows.size(); ++i) EXPECT_NEAR(run.value(i, "load.s [m]"), 60, 1e-3);
  EXPECT_LT(run.last("energy.kinetic [J]"), 1e-4);
}

// Heights count from the world's origin, whichever end of a beam its axis starts at: m g z of the beam, of
// the lump at a quarter of its height, and nothing of the mass of what pulls at a support.
TEST(Connectors, TheirEndMassesHaveTheirHeightFromTheOrigin) {
  for (const char* ends : {"[[0, 0, 0], [2, 0, 1]]", "[[2, 0, 1], [0, 0, 0]]"}) {
    const std::string text = R"({ "nurbeam": 1, "gravity": [0, 0, -10],
      "beams": [{ "name": "w", "axis": { "polyline": )" +
                             std::string(ends) + R"( }, "elements": { "count": 4 },
                  "section": { "area": 1e-4, "second_moment": 1e-9 },
                  "material": { "density": 1000, "youngs_modulus": 1e9 } }],
      "supports": [{ "beam": "w", "at": "start", "type": "clamped" },
                   { "beam": "w", "at": "end", "type": "guided", "direction": [0, 0, 1], "force": 1, "mass": 5 }],
      "connectors": [{ "name": "c", "from": { "beam": "w", "at": { "near": [0.5, 0, 0.25] } },
                       "to": { "point": [0.5, 0, 3] }, "stiffness": 1, "end_masses": [0.1, 0] }],
      "analysis": { "end_time": 1e-3, "step": 1e-3 }, "output": { "report": false } })";
    const CaseRun run = run_mechanics(text, {});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.value(0, "energy.gravity [J]"), 0.1 * std::sqrt(5) * 10 * 0.5 + 0.1 * 10 * 0.25, 1e-12);
  }
}

// What is refused before a run, with the place of it.
// From where the body is drawn, not from the axis below it: nothing moves.
TEST(Connectors, MeasureBodiesWithAnOffsetWhereTheseAreDrawn) {
  const std::string bar = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "w", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.05 },
                "material": "steel", "elements": { "count": 6 }, "orientation": { "up": [0, 0, 1] } }],
    "supports": [{ "beam": "w", "at": "start", "type": "clamped" }, { "beam": "w", "at": "end", "type": "clamped" }],
    "bodies": [{ "name": "b", "mass": 1 }],
    "sliding_joints": [{ "body": "b", "beam": "w", "at": { "length": 1 }, "follows_section": true, "offset": [0, 0.2] }],
    "connectors": [{ "name": "k", "from": { "body": "b" }, "to": { "point": [1, 0, 1] }, "stiffness": 1e4 }],
    "analysis": { "end_time": 0.01, "step": 1e-4 }, "output": { "every": 0.001, "report": false } })";
  const CaseRun spring = run_mechanics(bar), rod = run_mechanics(bar, {R"(connectors[0]={"name": "k",
    "from": {"body": "b"}, "to": {"point": [1, 0, 1]}, "type": "rod"})"});
  for (const CaseRun* run : {&spring, &rod}) {
    ASSERT_EQ(run->code, 0) << run->messages;
    EXPECT_NEAR(run->value(0, "k.length [m]"), 0.8, 1e-12);
    EXPECT_NEAR(run->last("k.force [N]"), 0, 1e-6);
    EXPECT_LT(run->last("energy.kinetic [J]"), 1e-12);
  }
}

// Of a bead on a rail that hardly strains as much as shorter steps say; 0.68 J once.
TEST(Damping, OfARailTakesNoMoreInLongSteps) {
  const std::string rail = R"({ "nurbeam": 1,
    "beams": [{ "name": "w", "axis": { "arc": { "center": [0, 0, 0], "start": [-2, 0, 0], "end": [0, 0, -2],
                                                "normal": [0, -1, 0] } },
                "section": { "radius": "25 mm" }, "elements": { "count": 12 },
                "material": { "name": "steel", "damping": 1e-4 } }],
    "supports": [{ "beam": "w", "at": "start", "type": "clamped" }, { "beam": "w", "at": "end", "type": "clamped" }],
    "bodies": [{ "name": "b", "mass": 20 }],
    "sliding_joints": [{ "body": "b", "beam": "w", "at": { "length": 0.3 } }],
    "analysis": { "end_time": 0.8 }, "output": { "every": 0.1, "report": false } })";
  const CaseRun by_tolerance = run_mechanics(rail), by_steps = run_mechanics(rail, {"analysis.step=2.5e-4"});
  ASSERT_EQ(by_tolerance.code, 0) << by_tolerance.messages;
  ASSERT_EQ(by_steps.code, 0) << by_steps.messages;
  EXPECT_NEAR(by_steps.last("energy.dissipated [J]"), 2.85e-3, 2e-4);
  EXPECT_NEAR(by_tolerance.last("energy.dissipated [J]"), 2.85e-3, 3e-4);
}

TEST(Connectors, ThatCannotBeAreRefused) {
  const auto refused = [](const std::vector<std::string>& overrides, const std::string& part) {
    const CaseRun run = run_mechanics(rope, overrides);
    EXPECT_EQ(run.code, 2) << part;
    EXPECT_TRUE(run.says(part)) << run.messages;
  };
  refused({"connectors[0].from={\"point\": [0, 0, 1]}", "connectors[0].name=x"}, "joins two points");
  refused({"connectors[0].to={\"body\": \"load\"}"}, "connectors[0]: joins the body \"load\" to itself");
  refused({"connectors[0].to={\"body\": \"lode\"}"}, "connectors[0].to.body: there is no body \"lode\"");
  refused({"connectors[0].to={\"beam\": \"pots\", \"at\": \"end\"}"}, "there is no beam \"pots\"");
  refused({"connectors[0].to={\"beam\": \"post\"}"}, "needs \"at\" beside it");
  refused({"connectors[0].stiffness=null"}, "\"stiffness\" is missing");
  refused({"connectors[0].type=rod"}, "connectors[0].stiffness: is not for a rod");
  refused({"connectors[0].length=as-drawn"}, "but the run starts as drawn");
  refused({"connectors[0].direction=[0, 0, 0]"}, "connectors[0].direction: is [0, 0, 0]");
  refused({"connectors[0].end_masses=[0, 2]"}, "connectors[0].end_masses[1]: is 2 kg at a point");
  refused({"connectors=[]"}, "bodies[0]: no sliding joint and no connector holds the body \"load\"");
  refused({"bodies[0].position=null", "bodies[0].velocity=null"}, "give its \"position\"");
  refused({"bodies[0].position=[0, 0, 0]", "connectors[0].length=1"}, "has both ends in one place as drawn");
  refused({"connectors[0]={\"name\": \"r\", \"from\": {\"body\": \"load\"}, \"to\": {\"point\": [0, 0, 0]}, "
           "\"type\": \"rod\", \"length\": 1.5}"},
          "connectors[0].length: is 1.5 m, but the ends of the rod are 1 m apart as drawn");
  refused({"connectors[0].force=-5"}, "connectors[0].force: is -5 N, a push, but \"tension-only\" pulls");
  refused({"stops=[{\"beam\": \"post\", \"at\": \"end\"}]"},
          "stops[0].beam: names \"post\", on which no body slides");
  refused({R"(supports[0].type="pinned")", "supports[0].direction=[1, 0, 0]"}, "is of supports that slide");
  refused({"supports[0].type=guided"}, "\"guided\" needs the \"direction\"");
}

const char* const trolleys = R"({
  "nurbeam": 1,
  "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[0, 0, 0], [20, 0, -2]] } },
            { "name": "cross", "rigid": true, "axis": { "polyline": [[10, -5, -1], [10, 5, -1]] } }],
  "bodies": [{ "name": "a", "mass": 3 }, { "name": "b", "mass": 3 }, { "name": "load", "mass": 2, "position": [3, 0, -3] }],
  "sliding_joints": [{ "body": "a", "beam": "rail", "at": { "length": 2 } },
                     { "body": "b", "beam": "rail", "at": { "length": 4 } }],
  "connectors": [{ "name": "link", "type": "rod", "from": { "body": "a" }, "to": { "body": "b" } },
                 { "name": "one", "type": "rod", "from": { "body": "a" }, "to": { "body": "load" } }],
  "analysis": { "end_time": 0.1, "step": 0.002 },
  "output": { "report": false }
})";

// A rod that keeps what is kept has no force that could be found: the run is refused, whatever else keeps it.
TEST(Rods, ThatKeepWhatIsKeptAreRefused) {
  EXPECT_EQ(run_mechanics(trolleys).code, 0);
  const auto refused = [](const std::vector<std::string>& overrides, const std::vector<std::string>& parts) {
    const CaseRun run = run_mechanics(trolleys, overrides);
    EXPECT_EQ(run.code, 2) << overrides[0];
    for (const std::string& part : parts) EXPECT_TRUE(run.says(part)) << part << run.messages;
  };
  const std::string rod = R"({"name": "x", "type": "rod", )";
  // What stays free is not refused: a driven one of two, three rods of a triangle, a load on two rods.
  for (const std::string& fine :
       {std::string(R"(sliding_joints[0].motion={"speed": 1})"),
        "connectors[1]=" + rod + R"("from": {"body": "b"}, "to": {"body": "load"}})",
        std::string("sliding_joints[0].release=0.05")})
    EXPECT_EQ(run_mechanics(trolleys, {fine}).code, 0) << fine;
  refused({R"(sliding_joints[0].motion={"speed": 1})", R"(sliding_joints[1].motion={"speed": 1})"},
          {"connectors[0]: is a rod, but what else holds its ends",
           "the place at which body \"a\" is driven, the place at which body \"b\" is driven"});
  refused({"sliding_joints[0].release=1", "sliding_joints[1].release=2"},
          {"the place at which body \"a\" is held, the place at which body \"b\" is held"});
  refused({"connectors[1]=" + rod + R"("from": {"body": "b"}, "to": {"body": "a"}})",
           R"(bodies=[{"name": "a", "mass": 3}, {"name": "b", "mass": 3}])"},
          {"connectors[1]: is a rod", "the rod \"link\""});
  refused({"analysis.initial=equilibrium"}, {"where an equilibrium is sought", "or start as drawn"});
  refused({"analysis={\"type\": \"static\"}"}, {"where an equilibrium is sought"});
  refused(
      {R"(sliding_joints[1]={"body": "a", "beam": "cross", "at": {"length": 5}})",
       R"(sliding_joints[0].at={"fraction": 0.5})",
       "connectors[0]={\"name\": \"s\", \"stiffness\": 1, \"from\": {\"body\": \"b\"}, \"to\": {\"body\": \"a\"}}",
       "bodies[1].position=[0, 0, 1]", "connectors[1].type=spring", "connectors[1].stiffness=5"},
      {"sliding_joints[1]: body \"a\" slides on several beams, but these hold it in more ways"});
  refused({R"(connectors[0].to={"point": [4, 0, 3]})",
           R"(stops=[{"beam": "rail", "at": {"length": 2}, "bodies": ["a"]}])"},
          {"stops: body \"a\" starts at a hard stop, at s = 2 m, where a rod keeps it anyway"});
  refused({R"(connectors[0].length=0)", "analysis.initial=equilibrium"},
          {"connectors[0].length: is 0 m, with which a rod has no direction"});
}

// Speeds that a rod does not let are told.
TEST(Rods, SayWhatSpeedsTheyDoNotLet) {
  const CaseRun run = run_mechanics(trolleys, {"sliding_joints[0].speed=2"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_TRUE(run.says("connectors[0]: is a rod whose ends start at -2 m/s from each other")) << run.messages;
  EXPECT_FALSE(run_mechanics(trolleys, {"sliding_joints[0].speed=2", "sliding_joints[1].speed=2",
                                        "bodies[2].velocity=[1.990074, 0, -0.1990074]"})
                   .says("connectors[0]: is a rod whose"));
}

TEST(SpinningBar, WithTorsionKeepsItsEnergyOverTenTurns) {
  // Sections take new charts every 60 degrees: what that puts out of balance is nothing.
  const std::string bar = R"({
    "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "bar", "axis": { "polyline": [[-0.5, 0, 0], [0.5, 0, 0]] }, "torsion": true,
                "section": { "radius": 0.02 }, "material": { "density": 1000, "youngs_modulus": "10 GPa" },
                "elements": { "count": 8 }, "initial": { "velocity": { "rotation": [0, 0, 10] } } }],
    "analysis": { "end_time": 6.283185307179586, "step": "2.5 ms" },
    "output": { "every": 0.6283185307179586, "probes": [{ "name": "tip", "beam": "bar", "at": "end" }] }
  })";
  const CaseRun run = run_mechanics(bar), without = run_mechanics(bar, {"beams[0].torsion=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  ASSERT_EQ(without.code, 0) << without.messages;
  const double energy = run.value(0, "energy.kinetic [J]");
  EXPECT_NEAR(energy, 5.236, 1e-3);
  EXPECT_LT(energy_change(run), 1e-3 * energy);
  EXPECT_LT(energy_change(run), 3 * energy_change(without));
  EXPECT_NEAR(run.last("tip.x [m]"), 0.5, 1e-3);
  EXPECT_NEAR(run.last("tip.y [m]"), 0, 2 * std::abs(without.last("tip.y [m]")));
}

// 1 kg at 1 m/s on a free rod of 1 m, without other forces: 0.5 J.
const std::string turning_rod = R"({
  "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{"name": "far", "rigid": true, "axis": {"polyline": [[9, 0, 0], [10, 0, 0]]}}],
  "bodies": [{"name": "m", "mass": 1, "position": [1, 0, 0], "velocity": [0, 1, 0]}],
  "connectors": [{"name": "r", "from": {"point": [0, 0, 0]}, "to": {"body": "m"}, "type": "rod"}],
  "analysis": {"end_time": 600, "step": 0.2, "integrator": {"type": "generalized-alpha", "rho_infinity": 0.8}},
  "output": {"every": 10, "report": false}})";

TEST(Rod, ThatKeepsTurningKeepsItsEnergy) {
  const CaseRun coarse = run_mechanics(turning_rod);
  ASSERT_EQ(coarse.code, 0) << coarse.messages;
  EXPECT_LT(energy_change(coarse), 1.02e-2 * 0.5);
  const CaseRun hardly_damped =
      run_mechanics(turning_rod, {"analysis.step=0.1", "analysis.integrator.rho_infinity=0.95"});
  ASSERT_EQ(hardly_damped.code, 0) << hardly_damped.messages;
  EXPECT_LT(energy_change(hardly_damped), 4e-5 * 0.5);
}

}  // namespace
}  // namespace nurbeam::test
