#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using test::CaseRun;

std::string body(const std::string& more) {
  return R"({ "name": "body", "mass": 50, "position": [1.5, 0, -0.5], "inertia": [5, 8, 6],
    "points": { "rear": [1, 0, 0], "front": [2, 0, 0] })" +
         more + " }";
}
std::string bodies_case(const std::string& bodies, const std::string& parts, const std::string& analysis) {
  return R"({ "nurbeam": 1, "bodies": [)" + bodies + "]" + parts + R"(, "analysis": { )" + analysis +
         R"( }, "output": { "report": false } })";
}
const std::string still = R"("type": "static")";
const std::string a_second = R"("end_time": 1, "step": 2e-3)";

// A bridge of 10 m, clamped at both ends; with torsion where sections are asked for.
std::string bridge(double stiffness) {
  return R"(, "beams": [{ "name": "bridge", "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] }, "stress_free": "straight", "torsion": true,
      "section": { "area": 1e-2, "second_moment": )" +
         std::to_string(stiffness / 2e11) + R"(, "torsion_constant": 1e-5 },
      "material": { "density": 1000, "youngs_modulus": 2e11, "poissons_ratio": 0.3 }, "elements": { "count": 20 } }],
    "supports": [{ "beam": "bridge", "at": "start", "type": "clamped" },
                 { "beam": "bridge", "at": "end", "type": "clamped" }])";
}

// The known answers of samples/bodies, as its page tells them.
TEST(RigidBodies, GiveTheSamplesTheirNumbers) {
  const auto of = [](const char* name) {
    const CaseRun run =
        test::run_file(test::sample(std::string("bodies/") + name + ".json"), {"output.report=false"});
    EXPECT_EQ(run.code, 0) << run.messages;
    return run;
  };
  const CaseRun gondola = of("gondola");
  EXPECT_NEAR(gondola.last("gondola.x [m]"), 0.235592279, 1e-7);
  const CaseRun top = of("top");
  EXPECT_NEAR(top.last("top.head.x [m]"), -0.678862684, 1e-7);
  EXPECT_NEAR(top.last("top.head.y [m]"), 0.590754222, 1e-7);
  EXPECT_NEAR(top.last("top.head.z [m]"), 0.436067547, 1e-7);
  const CaseRun cart = of("cart");
  EXPECT_NEAR(cart.last("cart.front.x [m]"), 2.322883163, 1e-7);
}

// A cart on two wheels crosses a bridge: its nodes come and go, energy stays.
TEST(RigidBodies, RollOverBeamsThatBend) {
  const std::string wheels = R"(, "sliding_joints": [
      { "body": "body", "point": "rear", "beam": "bridge", "at": { "near": [1, 0, 0] }, "speed": 3 },
      { "body": "body", "point": "front", "beam": "bridge", "at": { "near": [2, 0, 0] }, "speed": 3 }])";
  const CaseRun run = test::run_text(bodies_case(body(""), bridge(1e6) + wheels, a_second));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("body.rear.s [m]"), 4, 0.05);
  EXPECT_LT(run.last("body.z [m]"), -0.5);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 0.01);
}

// What follows the section of a stiff beam does what it does on a rigid guide.
TEST(RigidBodies, FollowSectionsOfBeamsAndOfGuides) {
  const auto with = [](const std::string& beams, const std::string& follows) {
    const CaseRun run = test::run_text(bodies_case(
        body(R"(, "velocity": [3, 0, 0])"),
        beams +
            R"(, "sliding_joints": [{ "body": "body", "point": "rear", "beam": "bridge", "at": { "near": [1, 0, 0] },
                    "follows": )" +
            follows + " }]",
        a_second));
    EXPECT_EQ(run.code, 0) << run.messages;
    return run;
  };
  const std::string guide =
      R"(, "beams": [{ "name": "bridge", "rigid": true, "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] } }])";
  for (const char* follows : {R"("section")", R"("tangent")", R"("axis", "axis": [0, 0, 1])"}) {
    const CaseRun stiff = with(bridge(1e9), follows), rigid = with(guide, follows);
    EXPECT_NEAR(stiff.last("body.x [m]"), rigid.last("body.x [m]"), 1e-4) << follows;
    EXPECT_NEAR(stiff.last("body.z [m]"), rigid.last("body.z [m]"), 1e-4) << follows;
    EXPECT_NEAR(stiff.last("body.pitch [rad]"), rigid.last("body.pitch [rad]"), 1e-3) << follows;
  }
}

// The mean of both wheels' forces on a slow cart carries its weight; a passenger at rest feels 1 g.
TEST(RigidBodies, TellWhatIsFelt) {
  const CaseRun run = test::run_text(bodies_case(
      body(R"(, "axes": { "x": [0, 1, 0], "z": [0, 0, 1] })"),
      R"(, "supports": [{ "name": "held", "body": "body", "at": [1, 2, 3], "type": "clamped" }])", a_second));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("body.g_z [1]"), 9.81 / 9.80665, 1e-12);
  EXPECT_NEAR(run.last("body.rear.g_z [1]"), 9.81 / 9.80665, 1e-12);
  EXPECT_NEAR(run.last("held.fz [N]"), 50 * 9.81, 1e-8);
  EXPECT_NEAR(run.last("held.mx [N m]"), -2 * 50 * 9.81, 1e-7);
  EXPECT_NEAR(run.last("held.my [N m]"), -0.5 * 50 * 9.81, 1e-7);
}

// Statics: a body on a ball hangs down, and its turn about the vertical, which nothing opposes, stays.
TEST(RigidBodies, HangInStatics) {
  const CaseRun run = test::run_text(bodies_case(
      body(""), R"(, "supports": [{ "body": "body", "at": [1, 0, 0], "type": "pinned" }])", still));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("body.x [m]"), 1, 1e-6);
  EXPECT_NEAR(run.last("body.z [m]"), -std::sqrt(0.5), 1e-9);
}

struct Wrong {
  std::string bodies, parts, analysis, message;
};
TEST(RigidBodies, SayWhatIsWrongWithThem) {
  const std::string thin = R"({ "name": "body", "mass": 1, "position": [0, 0, 0], "inertia": [1, 1, 3] })",
                    point_mass = R"({ "name": "body", "mass": 1, "position": [0, 0, 0] })";
  const auto support = [](const std::string& more) {
    return R"(, "supports": [{ "body": "body", "type": "pinned" )" + more + " }]";
  };
  for (
      const auto& [bodies, parts, analysis, message] :
      {Wrong{thin, "", a_second, "is 1 more than the sum of the others"},
       Wrong{body(""), support(R"(, "at": "raer")"), a_second,
             "has no point \"raer\"; did you mean \"rear\"?"},
       Wrong{body(""), "", still, "nothing holds body \"body\""},
       Wrong{
           point_mass,
           R"(, "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[0, 1, 0], [1, 1, 0]] } }],
                   "connectors": [{ "name": "spring", "type": "spring", "stiffness": 1, "from": { "body": "body" },
                                    "to": { "point": [0, 0, 1] } }],
                   "joints": [{ "between": [{ "body": "body" }, { "point": [0, 0, 0] }], "type": "rigid" }])",
           a_second, "a point mass, which has none"},
       Wrong{body(R"(, "turned": { "axis": [0, 1, 0], "angle": 30 })"),
             support(R"(, "at": "rear", "axis": [1, 0, 0])"), a_second, "which \"turned\" takes"},
       Wrong{
           body(""),
           R"(, "loads": [{ "body": "body", "force": [1, 0, 0] }, { "body": "nobody", "force": [1, 0, 0] }])",
           a_second, "there is no body \"nobody\""},
       Wrong{body(""),
             bridge(1e6) + R"(, "sliding_joints": [{ "body": "body", "point": "rear", "beam": "bridge",
                 "at": { "fraction": 0.5 } }])",
             a_second, "4 m from the place of the beam that it is to slide on"},
       Wrong{"", "", a_second, "and there are no rigid bodies"}}) {
    const CaseRun run = test::run_text(bodies_case(bodies, parts, analysis));
    EXPECT_NE(run.code, 0) << message;
    EXPECT_NE(run.messages.find(message), std::string::npos) << message << "\nin\n" << run.messages;
  }
}

}  // namespace
}  // namespace nurbeam
