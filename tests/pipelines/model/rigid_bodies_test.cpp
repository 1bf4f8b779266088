#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "pipelines/model/build_model.h"

namespace nurbeam {
namespace {

// A crank on a frame, a point mass and a shaft; `parts` are further lists.
std::string machine(const std::string& parts, const std::string& more_of_crank = {},
                    const std::string& analysis = R"({ "end_time": 1 })") {
  return R"({ "nurbeam": 1, "bodies": [
    { "name": "crank", "mass": 1, "position": [0, 0, 0], "inertia": [1, 1, 1], "points": { "pin": [0.1, 0, 0] })" +
         more_of_crank + R"( },
    { "name": "frame", "mass": 5, "position": [0, 0, 0], "inertia": [2, 2, 2] },
    { "name": "dot", "mass": 1, "position": [0, 0, 3] }],
    "beams": [{ "name": "shaft", "torsion": false, "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] },
      "section": { "radius": 0.01 }, "material": { "density": 7200, "youngs_modulus": 20e9 } }],
    "connectors": [{ "name": "rope", "type": "spring", "stiffness": 1, "from": { "body": "dot" }, "to": { "point": [0, 0, 4] } }],
    "analysis": )" +
         analysis + parts + " }";
}

std::vector<Diagnostic> said(const std::string& text) {
  const CaseFileReport read = read_case_text(text, "case");
  if (!read.value) return read.diagnostics;
  return build_model(*read.value).diagnostics;
}

// Whether an error stands at a place of the case and says all of this.
::testing::AssertionResult refuses(const std::string& text, const std::string& where,
                                   const std::vector<std::string>& words) {
  std::string all;
  for (const Diagnostic& each : said(text)) {
    all += each.where + ": " + each.message + "\n";
    if (each.severity == Severity::error && each.where.ends_with(where) &&
        std::ranges::all_of(
            words, [&](const std::string& word) { return each.message.find(word) != std::string::npos; }))
      return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << all;
}
std::string hinge(const std::string& more) {
  return R"(, "joints": [{ "between": [{ "body": "crank" }, { "body": "frame" }], "type": "hinged", )" +
         more + " }]";
}

TEST(DrivenHinge, NeedsAnAxisAndOneLaw) {
  EXPECT_TRUE(refuses(machine(hinge(R"("drive": { "motion": { "speed": 1 } })")), "joints[0].drive",
                      {"\"hinged\"", "axis"}));
  const std::string axis = R"("axis": [0, 0, 1], )";
  EXPECT_TRUE(refuses(machine(hinge(axis + R"("drive": {})")), "joints[0].drive", {"motion", "moment"}));
  EXPECT_TRUE(refuses(machine(hinge(axis + R"("drive": { "motion": { "speed": 1 }, "moment": 2 })")),
                      "joints[0].drive", {"motion", "moment"}));
  EXPECT_TRUE(refuses(machine(hinge(axis + R"("drive": { "motion": { "table": [[0, 20], [1, 30]] } })")),
                      "joints[0]", {"20 degrees", "\"turned\""}));
  EXPECT_TRUE(refuses(
      machine(hinge(axis + R"("drive": { "motion": { "speed": 1 } })"), "", R"({ "type": "static" })"),
      "joints[0].drive.motion.speed", {"motion", "table"}));
}

TEST(DrivenHinge, BeginsWhereTheBodyIsTurned) {
  const std::string turned = R"(, "turned": { "axis": [0, 0, 1], "angle": 20 })";
  const auto report = said(
      machine(hinge(R"("axis": [0, 0, 1], "drive": { "motion": { "table": [[0, 20], [1, 30]] } })"), turned));
  EXPECT_TRUE(
      std::ranges::none_of(report, [](const Diagnostic& each) { return each.severity == Severity::error; }));
}

TEST(TurnedSupportOfABody, TurnsWhatItHolds) {
  const auto support = [](const std::string& type, const std::string& rotation) {
    return machine(R"(, "supports": [{ "body": "crank", "type": )" + type + R"(, "rotation": )" + rotation +
                   " }]");
  };
  EXPECT_TRUE(refuses(support(R"("pinned")", R"({ "axis": [0, 0, 1], "speed": 1 })"), "supports[0].rotation",
                      {"turns nothing", "clamped"}));
  EXPECT_TRUE(refuses(support(R"("pinned", "axis": [0, 0, 1])", R"({ "axis": [0, 0, -2], "speed": 1 })"),
                      "supports[0].rotation", {"turns nothing", "clamped"}));
  EXPECT_TRUE(refuses(support(R"("guided", "direction": [1, 0, 0])", R"({ "axis": [0, 0, 1], "speed": 1 })"),
                      "supports[0].rotation", {"clamped"}));
  EXPECT_TRUE(refuses(support(R"("clamped")", R"({ "axis": [0, 0, 0], "speed": 1 })"),
                      "supports[0].rotation.axis", {"[0, 0, 0]"}));
}

TEST(RotationalConnectorOfABody, NeedsWhatTurns) {
  const auto spring = [](const std::string& from, const std::string& to) {
    std::string text = machine("");
    const std::string key = R"("connectors": [)";
    text.insert(text.find(key) + key.size(),
                R"({ "name": "spring", "type": "rotational", "stiffness": 1, "axis": [0, 0, 1], "from": )" +
                    from + R"(, "to": )" + to + " }, ");
    return text;
  };
  EXPECT_TRUE(refuses(spring(R"({ "body": "dot" })", R"({ "body": "crank" })"), "connectors[0].from",
                      {"point mass", "inertia"}));
  EXPECT_TRUE(refuses(spring(R"({ "body": "crank", "at": "pin" })", R"({ "body": "crank" })"),
                      "connectors[0]", {"itself", "crank"}));
  EXPECT_TRUE(refuses(spring(R"({ "beam": "shaft", "at": "end" })", R"({ "body": "crank" })"),
                      "connectors[0].from", {"torsion"}));
}

TEST(FixedBody, NeedsABeamWithSectionsAndIsHeldOnce) {
  EXPECT_TRUE(refuses(machine("", R"(, "fixed_to": { "beam": "shaft", "at": "start" })"),
                      "bodies[0].fixed_to", {"torsion"}));
  EXPECT_TRUE(refuses(machine("", R"(, "fixed_to": { "beam": "shift", "at": "start" })"),
                      "bodies[0].fixed_to.beam", {"shift", "shaft"}));
}

TEST(BodyProbe, NeedsAPointOfARigidBody) {
  const auto probe = [](const std::string& of) {
    return machine(R"(, "output": { "probes": [{ "name": "seat", )" + of + " }] }");
  };
  EXPECT_TRUE(refuses(probe(R"("body": "dot", "at": [0, 0, 0])"), "output.probes[0].body", {"point mass"}));
  EXPECT_TRUE(refuses(probe(R"("body": "crank", "at": "pim")"), "output.probes[0].at", {"pim", "pin"}));
  EXPECT_TRUE(refuses(probe(R"("body": "crunk", "at": "pin")"), "output.probes[0].body", {"crunk", "crank"}));
  EXPECT_TRUE(refuses(probe(R"("beam": "shaft")"), "output.probes[0]", {"\"at\" is missing"}));
  const CaseFileReport read = read_case_text(probe(R"("body": "crank", "at": "pin")"), "case");
  ASSERT_TRUE(read.value);
  const BuildReport built = build_model(*read.value);
  ASSERT_TRUE(built.value);
  EXPECT_TRUE(built.value->probes.empty());
  EXPECT_EQ(built.value->model.bodies.back().name, "seat");
  EXPECT_EQ(built.value->model.bodies.back().point_of->arm, Eigen::Vector3d(0.1, 0, 0));
}

TEST(DragOfABody, ActsAtItsPoint) {
  const std::string drag = R"(, "drag_area": 0.5, "drag_at": )", air = R"(, "air": { "density": 1.2 })";
  EXPECT_TRUE(refuses(machine(air, drag + R"("pim")"), "bodies[0].drag_at", {"pim", "pin"}));
  const CaseFileReport read = read_case_text(machine(air, drag + R"("pin")"), "case");
  ASSERT_TRUE(read.value);
  const BuildReport built = build_model(*read.value);
  ASSERT_TRUE(built.value);
  for (const Body& body : built.value->model.bodies)
    EXPECT_EQ(body.drag_area, body.name == "crank.pin" ? 0.5 : 0) << body.name;
}

TEST(Rotor, IsNoPartOfBuckling) {
  EXPECT_TRUE(refuses(
      machine(R"(, "loads": [{ "beam": "shaft", "at": "end", "force": [1, 0, 0] }])",
              R"(, "rotor": { "axis": [0, 0, 1], "inertia": 1, "speed": 3 })", R"({ "type": "buckling" })"),
      "bodies[0].rotor", {"modes"}));
}

}  // namespace
}  // namespace nurbeam
