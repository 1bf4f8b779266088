#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using test::CaseRun;

// A rope of 1 kg/m and 4 m that hangs down from a reel, with 20 kg at its end; `more` are keys beside it.
std::string hanging(const std::string& reel, const std::string& analysis, const std::string& more = "") {
  return R"({ "nurbeam": 1,
    "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 0], [0, 0, -4]] }, "stress_free": "straight",
      "section": { "area": 1e-4, "second_moment": 1e-12 },
      "material": { "density": 10000, "youngs_modulus": 2e11, "damping": 1e-4 }, "elements": { "max_length": 0.5 } }],
    "bodies": [{ "name": "load", "mass": 20, "fastened": { "beam": "rope", "at": "end" } }],
    "reels": [{ "name": "drum", "beam": "rope", "end": "start", )" +
         reel + R"( }], "analysis": { )" + analysis + R"( }, "output": { "report": false })" + more + " }";
}

std::string motion_until(double end_time) {
  return R"("initial": "equilibrium", "step": 1e-3, "end_time": )" + std::to_string(end_time);
}
const std::string motion = motion_until(2);

TEST(Reels, HoldTheRopeInStatics) {
  const CaseRun run = test::run_text(hanging(R"("stored": 5)", R"("type": "static")"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("drum.axial_force [N]"), 24 * 9.81, 1e-3);
  EXPECT_NEAR(run.last("drum.fz [N]"), -24 * 9.81, 1e-3);  // of the rope on the drum, without what is stored
  EXPECT_NEAR(run.last("drum.stored [m]"), 5, 1e-12);
  EXPECT_NEAR(run.last("drum.out [m]"), 4, 1e-12);
}

// At the other end of the rope the reel does the same.
TEST(Reels, StandAtEitherEnd) {
  std::string at_end = hanging(R"("stored": 5, "motion": { "table": [[0, 0], [1, 1], [2, 3]] })", motion);
  const auto replace = [&](const std::string& from, const std::string& to) {
    at_end.replace(at_end.find(from), from.size(), to);
  };
  const CaseRun start = test::run_text(at_end);
  replace("[[0, 0, 0], [0, 0, -4]]", "[[0, 0, -4], [0, 0, 0]]");
  replace(R"("at": "end")", R"("at": "start")");
  replace(R"("end": "start")", R"("end": "end")");
  const CaseRun end = test::run_text(at_end);
  ASSERT_EQ(start.code, 0) << start.messages;
  ASSERT_EQ(end.code, 0) << end.messages;
  for (const char* column : {"drum.out [m]", "drum.rate [m/s]", "drum.axial_force [N]", "drum.fz [N]",
                             "drum.power [W]", "drum.drive_force [N]", "load.z [m]", "energy.total [J]"})
    EXPECT_NEAR(start.last(column), end.last(column), 1e-6 * std::abs(start.last(column)) + 1e-9) << column;
  EXPECT_NEAR(start.last("drum.out [m]"), 7, 1e-9);
}

// A load that falls is stopped by the end that is tied to the drum, at a loss; or takes the rope along.
TEST(Reels, StopOrLetGoWhereTheyAreEmpty) {
  const std::string falling = R"("stored": 2, "inertia": 1)";
  const CaseRun tied = test::run_text(hanging(falling, motion_until(0.68)));
  ASSERT_EQ(tied.code, 0) << tied.messages;
  EXPECT_NEAR(tied.last("drum.stored [m]"), 0, 1e-6);
  EXPECT_NEAR(tied.last("load.z [m]"), -6, 0.05);
  const CaseRun loose = test::run_text(hanging(falling + R"(, "at_empty": "leave")", motion));
  ASSERT_EQ(loose.code, 0) << loose.messages;
  EXPECT_LT(loose.last("load.z [m]"), -12);
  EXPECT_TRUE(std::isnan(loose.last("drum.stored [m]")));
  // The load falls freely from where the rope left: (m + rho L + J) a = (m + rho l) g before.
  EXPECT_NEAR(loose.last("load.vz [m/s]"), -9.81 * 2, 1);
}

// What a brake takes is booked.
TEST(Reels, AreBraked) {
  const std::string text =
      hanging(R"("stored": 5, "inertia": 3, "friction": { "force": 100, "quadratic": 4 })", motion_until(1));
  const CaseRun whole = test::run_text(text);
  ASSERT_EQ(whole.code, 0) << whole.messages;
  EXPECT_LT(whole.last("drum.stored [m]"), 4.5);
  EXPECT_GT(whole.last("energy.dissipated [J]"), 10);
  EXPECT_NEAR(whole.last("energy.total [J]"), whole.value(0, "energy.total [J]"), 1e-3);
}

// A drum that a motor has lifted runs back when that stops: the brake, which acts against the motion, turns
// round with it, with fixed and with adaptive steps. The rope of rho = 1 kg/m hardly stretches: (J + m + rho
// L) l'' = (m + rho l) g - F - B sgn(l').
TEST(Reels, AreBrakedAgainstTheWayTheyRun) {
  constexpr double rho = 1, m = 20, J = 3, L = 9, g = 9.81, brake = 100, stop = 0.5, end = 1.5, h = 1e-5;
  double l = 4, v = 0;
  for (int i = 0; i < std::lround(end / h); ++i) {
    const double pulled = (m + rho * l) * g - (i * h < stop ? 500 : 0);
    const double way = v != 0 ? (v > 0 ? 1 : -1) : (pulled > 0 ? 1 : -1);
    const double next = v + h * (pulled - way * brake) / (J + m + rho * L);
    l += h * (v + next) / 2;
    v = v * next < 0 ? 0 : next;
  }
  for (const char* steps : {R"("step": 1e-3)", R"("tolerance": 1e-6)",
                            R"("tolerance": 1e-6, "integrator": { "type": "radau" })"}) {
    const CaseRun run = test::run_text(hanging(
        R"("stored": 5, "inertia": 3, "friction": { "force": 100 }, "force": [[0, 500], [0.5, 500], [0.500001, 0]])",
        std::string(R"("initial": "equilibrium", "end_time": 1.5, )") + steps));
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("drum.rate [m/s]"), v, 0.01 * v) << steps;
    EXPECT_NEAR(run.last("drum.out [m]"), l, 0.005) << steps;
  }
}

// Behind the ramp the speed stays what was asked for.
TEST(Reels, KeepTheSpeedThatARampReaches) {
  const CaseRun run = test::run_text(hanging(R"("stored": 30, "motion": { "speed": 1.5, "ramp": 0.4 })",
                                             R"("initial": "equilibrium", "step": 1e-3, "end_time": 2)"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("drum.out [m]"), 4 + 1.5 * (2 - 0.4 / 2), 1e-6);
  EXPECT_NEAR(run.last("drum.rate [m/s]"), 1.5, 1e-6);
  EXPECT_FALSE(run.says("an impact of")) << run.messages;
}

// A support that is nearer to the mouth than an element is taken in no farther than it is drawn.
TEST(Reels, MayStartNearASupport) {
  const CaseRun run = test::run_text(
      hanging(R"("stored": 5, "inertia": 1, "force": 400)", motion_until(0.2),
              R"(, "supports": [{ "beam": "rope", "at": { "length": 0.1 }, "type": "pinned" }])"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("drum.out [m]"), 4, 1e-4);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 1e-3);
}

// What is fastened to the rope is not wound up either.
TEST(Reels, StopBeforeAFastenedBody) {
  std::string text = hanging(R"("stored": 5, "inertia": 1, "force": 450)", motion_until(1.5));
  const std::string load = R"({ "name": "load")";
  text.insert(text.find(load),
              R"({ "name": "knot", "mass": 1, "fastened": { "beam": "rope", "at": { "length": 2 } } }, )");
  const CaseRun run = test::run_text(text);
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("drum.out [m]"), 4 - 2 + 0.5, 0.02);
}

// A speed that is there at once is an impact of rho c v.
TEST(Reels, WarnOfImpacts) {
  const auto with = [](const std::string& motion) {
    return test::run_text(hanging(R"("stored": 5, "motion": )" + motion,
                                  R"("initial": "equilibrium", "step": 1e-4, "end_time": 1e-3)"));
  };
  const CaseRun at_once = with(R"({ "speed": 0.5 })");
  EXPECT_TRUE(at_once.says("an impact of 2236 N")) << at_once.messages;  // 0.5 sqrt(2e7 N 1 kg/m)
  const CaseRun at_rest = with(R"({ "table": [[0, 0], [1, 1], [2, 4], [3, 9]] })");
  EXPECT_FALSE(at_rest.says("an impact of")) << at_rest.messages;
}

// In a frame that turns the body at the rope's end pulls with its weight and its centrifugal force.
TEST(Frames, AddToTheForceOfABodyOnItsBeam) {
  const CaseRun run = test::run_text(hanging(R"("stored": 5)", R"("type": "static")",
                                             R"(, "frame": { "rate": [0, 0, 2], "about": [-3, 0, 0] })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double radius = run.last("load.x [m]") + 3;
  EXPECT_GT(radius, 4);
  EXPECT_NEAR(run.last("load.joint_force.x [N]"), -20 * 4 * radius, 1e-6 * 80 * radius);
  EXPECT_NEAR(run.last("load.joint_force.z [N]"), 20 * 9.81, 1e-3);
  const CaseRun bead =
      test::run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0], "frame": { "rate": [0, 0, 1.5] },
    "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[0, 0, 0], [20, 0, 0]] } }],
    "bodies": [{ "name": "bead", "mass": 2 }],
    "sliding_joints": [{ "body": "bead", "beam": "rail", "at": { "length": 0.5 } }],
    "analysis": { "end_time": 1, "step": 1e-3 }, "output": { "report": false } })");
  ASSERT_EQ(bead.code, 0) << bead.messages;
  EXPECT_NEAR(bead.last("bead.vx [m/s]"), 0.5 * 1.5 * std::sinh(1.5), 1e-5);
  EXPECT_NEAR(bead.last("bead.joint_force.y [N]"), 2 * 2 * 1.5 * bead.last("bead.vx [m/s]"),
              1e-4);  // Coriolis
}

// The known answers of samples/ropes, as its page tells them.
TEST(Reels, GiveTheSamplesTheirNumbers) {
  const auto of = [](const char* name) {
    const CaseRun run =
        test::run_file(test::sample(std::string("ropes/") + name + ".json"), {"output.report=false"});
    EXPECT_EQ(run.code, 0) << run.messages;
    return run;
  };
  const CaseRun atwood = of("atwood");
  EXPECT_NEAR(atwood.value(0, "heavy.z [m]") - atwood.last("heavy.z [m]"), 0.6852766, 1e-4);
  const CaseRun winch = of("winch");
  EXPECT_NEAR(winch.last("load.z [m]") - winch.value(0, "load.z [m]"), 14.8712429, 0.02);
  EXPECT_NEAR(winch.last("winch.axial_force [N]"), 3576.71, 1);
  const CaseRun arrested = of("arresting_gear");
  double stop = 0;
  for (std::size_t i = 0; i < arrested.rows.size(); ++i)
    stop = std::max(stop, arrested.value(i, "aircraft.y [m]"));
  EXPECT_NEAR(stop, 61.36, 0.3);
  const CaseRun tether = of("tether");
  for (std::size_t i = 0; i < tether.rows.size(); ++i)
    if (tether.value(i, "time [s]") == 1500) {
      EXPECT_NEAR(
          std::atan2(tether.value(i, "satellite.y [m]"), tether.value(i, "satellite.x [m]")) * 180 / M_PI,
          -48.8166444, 0.15);
    }
  const CaseRun tackle = of("tackle");
  double least = 1e9, most = 0;
  for (std::size_t i = 5; i < tackle.rows.size(); ++i) {
    least = std::min(least, -tackle.value(i, "pull.fz [N]"));
    most = std::max(most, -tackle.value(i, "pull.fz [N]"));
  }
  EXPECT_NEAR((least + most) / 2, 357.67, 6);
}

TEST(Reels, TellWhatTheyCannotTakeIn) {
  const auto refused = [](const std::string& text) {
    const CaseRun run = test::run_text(text);
    EXPECT_EQ(run.code, 2) << run.messages;
    return run.messages;
  };
  const auto says = [](const std::string& messages, const std::string& text) {
    EXPECT_NE(messages.find(text), std::string::npos) << messages;
  };
  says(refused(hanging(R"("stored": 5)", motion,
                       R"(, "supports": [{ "beam": "rope", "at": "start", "type": "pinned" }])")),
       "the reel holds that end: remove what else does");
  says(refused(hanging(R"("stored": 5, "feed": "spool", "inertia": 3)", motion)), "a spool does not turn");
  says(refused(hanging(R"("stored": 5, "feed": "spool", "motion": { "speed": -1 })", motion)),
       "takes rope in, which a spool cannot");
  says(refused(hanging(R"("stored": 5, "feed": "spool", "force": 10)", motion)),
       "takes rope in, which a spool cannot; let");
  says(refused(hanging(R"("stored": 5, "pickup": 2)", motion)), "is of a spool");
  says(refused(hanging(R"("stored": 5, "friction": { "force": 3, "law": "capstan" })", motion)),
       "the only law for a reel");
  says(refused(hanging(R"("stored": 5, "motion": { "table": [[0, 0], [1, 6]] })", motion)),
       "must be between -3.5 and 5 m");
  says(refused(hanging(R"("stored": 5)", motion,
                       R"(, "loads": [{ "beam": "rope", "force_per_length": [1, 0, 0] }])")),
       "part of which is on the reel");
  says(refused(R"({ "nurbeam": 1, "beams": [{ "name": "rail", "rigid": true,
      "axis": { "polyline": [[0, 0, 0], [0, 0, -4]] } }],
    "reels": [{ "name": "drum", "beam": "rail", "end": "start", "stored": 5 }],
    "analysis": { "end_time": 1, "step": 1e-3 } })"),
       "a rigid guide, which is not wound up");
}

TEST(Reels, CountAsOutWhatIsOnNeither) {
  std::string text = hanging(R"("stored": 5, "motion": { "speed": 1, "ramp": 0.1 })", motion_until(0.5));
  const std::string bodies =
      R"("bodies": [{ "name": "load", "mass": 20, "fastened": { "beam": "rope", "at": "end" } }],)";
  text.erase(text.find(bodies), bodies.size());
  text.insert(text.find(R"({ "name": "drum")"),
              R"({ "name": "low", "beam": "rope", "end": "end", "stored": 3, "motion": { "speed": 0 } }, )");
  const CaseRun run = test::run_text(text);
  ASSERT_EQ(run.code, 0) << run.messages;
  for (const char* reel : {"drum", "low"}) {
    EXPECT_NEAR(run.value(0, std::string(reel) + ".out [m]"), 4, 1e-9);
    EXPECT_NEAR(run.last(std::string(reel) + ".out [m]"), 4.45, 1e-9);
  }
  EXPECT_NEAR(run.last("low.stored [m]"), 3, 1e-9);
}

TEST(Reels, AreToldByCheck) {
  const test::TemporaryDirectory directory;
  std::ostringstream out, err;
  const std::string file =
      directory.write("case.json", hanging(R"("stored": 5, "force": 100)", motion)).string();
  EXPECT_EQ(run_command_line({"check", file}, out, err), 0) << err.str();
  EXPECT_NE(out.str().find("reel      drum on rope at s = 0 m, 5 m stored"), std::string::npos) << out.str();
}

}  // namespace
}  // namespace nurbeam
