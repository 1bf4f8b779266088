#include "pipelines/model/build_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

/// Two quarter circles of radius 1 m and a support on the second one, at 0.2 pi from its start.
const std::vector<std::string> half_circle = {
    R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [-1, 0, 0], "normal": [0, 0, 1]}})",
    R"(supports=[{"beam": "cable", "at": {"fraction": 0.7}, "type": "clamped"}])"};
const std::string straight = "beams[0].stress_free=straight";

BuildReport build(const std::string& elements) {
  const test::TemporaryDirectory directory;
  std::vector<std::string> overrides = half_circle;
  overrides.insert(overrides.end(), {straight, "beams[0].elements=" + elements});
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  return build_model(report.value.value());
}

std::vector<double> lengths(const BuildReport& report) {
  const std::vector<HomeNode>& home = report.value.value().model.beams.at(0).home;
  std::vector<double> found;
  for (std::size_t i = 1; i < home.size(); ++i) found.push_back(home[i].s - home[i - 1].s);
  return found;
}

TEST(BuildModel, ElementsOfEachSegmentGrowByTheGrading) {
  const double pi = std::numbers::pi;
  for (const auto& [grading, k] : {std::pair{"\"10 cm\"", 0.1}, {"-0.1", -0.1}, {"0", 0.0}}) {
    const BuildReport report = build(std::string(R"({"per_segment": 3, "grading": )") + grading + "}");
    EXPECT_TRUE(report.diagnostics.empty());
    const std::vector<double> found = lengths(report);
    ASSERT_EQ(found.size(), 9u);
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(found[i], (i < 3 ? 0.5 : i < 6 ? 0.2 : 0.3) * pi / 3 + (i % 3 - 1) * k, 1e-13);
  }
}

TEST(BuildModel, AnArcWhoseEndsAreOnePointIsAWholeCircleAndARing) {
  const test::TemporaryDirectory directory;
  const CaseFileReport report = read_case_file(
      directory.write("case.json", test::smallest_case),
      {R"(beams[0].axis={"arc": {"center": [0, 1, 0], "start": [2, 1, 0], "end": [2, 1, 0], "normal": [0, 0, 1]}})",
       "beams[0].closed=true"});
  ASSERT_TRUE(report.value);
  const BuildReport built = build_model(*report.value);
  ASSERT_TRUE(built.value);
  const Beam& beam = built.value->model.beams.at(0);
  EXPECT_NEAR(beam.curve.length(), 4 * std::numbers::pi, 1e-13);
  EXPECT_TRUE(beam.is_ring());
}

TEST(BuildModel, KnowsTheForcesOfEachLoadAmongOthers) {
  const test::TemporaryDirectory directory;
  const std::string pinned = R"({"beam": "cable", "at": "start", "type": "pinned"})",
                    pulled = R"({"beam": "cable", "at": "end", "type": "guided", "direction": [1, 0, 0],)"
                             R"( "force": 5})",
                    across = R"({"beam": "cable", "at": {"fraction": 0.5}, "force": [0, 0, -1]})",
                    along = R"({"beam": "cable", "force_per_length": [0, 0, -2]})";
  const CaseFileReport report =
      read_case_file(directory.write("case.json", test::smallest_case),
                     {"supports=[" + pinned + "," + pulled + "]", "loads=[" + across + "," + along + "]"});
  ASSERT_TRUE(report.value);
  const BuiltModel built = build_model(*report.value).value.value();
  const std::vector<Force>& forces = built.model.forces;
  EXPECT_EQ(forces.size(), 3u);  // and what pulls the support
  ASSERT_EQ(built.loads.size(), 2u);
  ASSERT_EQ(built.loads[0].size(), 1u);
  EXPECT_NEAR(std::get<PointLoad>(forces.at(built.loads[0][0])).value.norm(), 1, 1e-15);
  ASSERT_EQ(built.loads[1].size(), 1u);
  EXPECT_NEAR(std::get<LineLoad>(forces.at(built.loads[1][0])).value.norm(), 2, 1e-15);
}

TEST(BuildModel, AGradingThatLeavesNoRoomIsRefusedWithItsRange) {
  // The tightest interval is the one before the support: |k| < 2 (0.2 pi) / (3 * 2).
  const BuildReport report = build(R"({"per_segment": 3, "grading": "30 cm"})");
  EXPECT_FALSE(report.value);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_NE(report.diagnostics[0].where.find("beams[0].elements.grading"), std::string::npos);
  for (const char* part : {"0.3 m", "3 parts", "0.6283185307 m", "greater than -0.2094395102 m",
                           "less than 0.2094395102 m", "between s = 1.570796327 m and s = 2.199114858 m"})
    EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
}

TEST(BuildModel, AGradingWithoutEffectIsMentioned) {
  const BuildReport report = build(R"({"per_segment": 1, "grading": 0.1})");
  EXPECT_EQ(lengths(report).size(), 3u);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].message.find("no effect"), std::string::npos);
}

/// The half circle as a cable of EI = 20 MPa pi (0.01 m)^4 / 4, out of the plane of gravity, with more
/// overrides.
BuildReport build_in_space(const std::vector<std::string>& more) {
  const test::TemporaryDirectory directory;
  std::vector<std::string> overrides = half_circle;
  overrides.insert(overrides.end(), {"gravity=[0, -3, -9]", "beams[0].section={\"radius\": 0.01}",
                                     "beams[0].material={\"density\": 7200, \"youngs_modulus\": 2e7}"});
  overrides.insert(overrides.end(), more.begin(), more.end());
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  return build_model(report.value.value());
}

TEST(BuildModel, ABentDrawingOfAStraightBeamIsToldWithItsEnergy) {
  const double pi = std::numbers::pi;
  const double energy = 0.5 * 2e7 * pi * 1e-8 / 4 * pi;  // EI kappa^2 L / 2 with kappa = 1 / m
  const BuildReport report = build_in_space({"beams[0].torsion=false"});
  ASSERT_EQ(report.value.value().model.dimension, 3);
  EXPECT_NEAR(report.value->sources[0].drawn_bending, energy, 1e-9 * energy);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].where.find("beams[0].stress_free"), std::string::npos);
  for (const char* part : {"0.2467 J", "radius of 1 m", "\"straight\"", "\"as-drawn-without-torsion\""})
    EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
}

TEST(BuildModel, ABentDrawingInSpaceHasTorsionWhenNothingIsSaid) {
  const BuildReport report = build_in_space({});
  ASSERT_TRUE(report.value);
  EXPECT_TRUE(report.value->model.beams[0].has_torsion());
  EXPECT_FALSE(report.value->model.beams[0].curve.straight());
  EXPECT_EQ(report.value->sources[0].drawn_bending, 0);
  ASSERT_EQ(report.diagnostics.size(), 1u);  // of Poisson's ratio
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
}

TEST(BuildModel, ABentDrawingInSpaceHasTorsionWhereABodySlidesOnItToo) {
  for (const bool continuous : {true, false}) {
    const std::string slope = continuous ? "continuous" : "discontinuous";
    const BuildReport report = build_in_space(
        {R"(bodies=[{"name": "bead", "mass": 1}])",
         R"(sliding_joints=[{"body": "bead", "beam": "cable", "at": {"fraction": 0.5}, "slope": ")" + slope +
             "\"}]"});
    ASSERT_TRUE(report.value);
    EXPECT_TRUE(report.value->model.beams[0].has_torsion());
    EXPECT_FALSE(report.value->model.beams[0].curve.straight());
  }
}

TEST(BuildModel, ABentDrawingThatIsSaidToBeStraightKeepsItsEnergyWithoutAWarning) {
  const BuildReport report = build_in_space({straight});
  EXPECT_TRUE(report.diagnostics.empty());
  EXPECT_NEAR(report.value.value().sources[0].drawn_bending, 0.2467, 1e-4);
}

TEST(BuildModel, ADrawingThatHoldsNothingIsNotTold) {
  const BuildReport as_drawn = build_in_space({"beams[0].stress_free=as-drawn-without-torsion"});
  EXPECT_TRUE(as_drawn.diagnostics.empty());
  EXPECT_EQ(as_drawn.value.value().sources[0].drawn_bending, 0);
  const BuildReport straight = build_in_space({R"(beams[0].axis={"polyline": [[0, 0, 0], [1, 1, 1]]})"});
  EXPECT_TRUE(straight.diagnostics.empty());
  EXPECT_EQ(straight.value.value().sources[0].drawn_bending, 0);
}

// ---- Torsion ----

BuildReport built(std::vector<std::string> overrides) {
  const test::TemporaryDirectory directory;
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  if (!report.value) return {{}, report.diagnostics};
  return build_model(*report.value);
}

/// Whether one of the errors is at that place and says all that.
bool refuses(const BuildReport& report, const std::string& where, const std::vector<std::string>& parts) {
  for (const Diagnostic& d : report.diagnostics) {
    if (d.severity != Severity::error || d.where.find(where) == std::string::npos) continue;
    bool all = true;
    for (const std::string& part : parts) all = all && d.message.find(part) != std::string::npos;
    if (all) return true;
  }
  return false;
}

/// The greatest jump of the tangent of the first beam, between its segments and at its seam.
double greatest_kink(const BuildReport& report) {
  const Beam& beam = report.value.value().model.beams.at(0);
  double greatest = 0;
  for (const HomeNode& node : beam.home)
    greatest = std::max(greatest, (beam.curve.tangent(node.s, true) - beam.curve.tangent(node.s)).norm());
  return std::max(
      greatest,
      beam.is_ring() ? (beam.curve.tangent(beam.curve.length(), true) - beam.curve.tangent(0)).norm() : 0.0);
}

// Within the 1e-6 m of the "approximation_tolerance"; the second is a parabola as a quartic.
TEST(BuildModel, ACurveOfDegreeAboveThreeIsToldWithItsDeviationWhereItIsNoCubic) {
  const auto told = [](const std::string& points) -> std::string {
    const test::TemporaryDirectory directory;
    const CaseFileReport report =
        read_case_file(directory.write("case.json", test::smallest_case),
                       {R"(beams[0].axis={"nurbs": {"degree": 4, "knots": [0, 0, 0, 0, 0, 1, 1, 1, 1, 1],
                           "control_points": )" +
                        points + "}}"});
    for (const Diagnostic& d : build_model(report.value.value()).diagnostics)
      if (d.message.find("was approximated") != std::string::npos) return d.where + ": " + d.message;
    return "";
  };
  const std::string quartic = told("[[0, 0, 0], [0.2, 0, 0.4], [0.5, 0, -0.3], [0.7, 0, 0.5], [1, 0, 0]]");
  EXPECT_NE(quartic.find("beams[0].axis: a curve of degree above 3 was approximated; largest deviation "),
            std::string::npos)
      << quartic;
  EXPECT_EQ(told("[[0, 0, 0], [0.25, 0, 0.3], [0.5, 0, 0.4], [0.75, 0, 0.3], [1, 0, 0]]"), "");
}

// A quarter circle of 1 m: with t = pi / 8 the middle of each of two elements has a radius of cos t + t sin t
// / 2.
TEST(BuildModel, PolynomialElementsAreToldWithTheirDistanceFromTheDrawing) {
  const auto told = [](const std::string& element, const std::string& count, const std::string& axis) {
    const test::TemporaryDirectory directory;
    const CaseFileReport report =
        read_case_file(directory.write("case.json", test::smallest_case),
                       {"gravity=[0, -9.81, 0]", "beams[0].element=" + element,
                        "beams[0].elements={\"count\": " + count + "}", "beams[0].axis=" + axis});
    std::string text;
    for (const Diagnostic& d : build_model(report.value.value()).diagnostics)
      text += d.where + ": " + d.message + "\n";
    return text;
  };
  const std::string arc =
      R"({"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0], "normal": [0, 0, 1]}})";
  const std::string coarse = told("ale-ancf", "2", arc);
  for (const char* part : {"beams[0].element: is \"ale-ancf\"", "by up to 0.000981 m", "\"ale-rancf\""})
    EXPECT_NE(coarse.find(part), std::string::npos) << coarse;
  EXPECT_EQ(told("ale-rancf", "2", arc), "");
  EXPECT_EQ(told("ale-ancf", "40", arc), "");
  EXPECT_EQ(told("ale-ancf", "2", R"({"polyline": [[0, 0, 0], [1, 1, 0]]})"), "");
}

// An element beside a kink would hold its angle in the drawn direction while the beam turns.
TEST(BuildModel, KinksOfTheDigitsOfADrawingGoWithANote) {
  const BuildReport line = built({"beams[0].axis={\"polyline\": [[0, 0, 0], [1, 0, 0], [2, 5e-5, 0]]}",
                                  "beams[0].torsion=true", "beams[0].material.poissons_ratio=0.3"});
  EXPECT_LT(greatest_kink(line), 1e-14);
  EXPECT_TRUE(std::any_of(line.diagnostics.begin(), line.diagnostics.end(), [](const Diagnostic& d) {
    return d.severity == Severity::note && d.message.find("were made one") != std::string::npos;
  }));
  EXPECT_TRUE(refuses(built({"beams[0].axis={\"polyline\": [[0, 0, 0], [1, 0, 0], [2, 5e-4, 0]]}"}),
                      "beams[0].axis", {"a corner of 0.0286"}));
  const BuildReport ring = built(
      {R"(beams[0].axis={"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2], "control_points":)"
       " [[0, 0, 0], [1, 0, 0], [2, 1, 0], [2, 2, 0], [2, 3, 0], [-1, 5e-5, 0], [0, 0, 0]]}}",
       "beams[0].closed=true", "supports[0].at=start"});
  EXPECT_LT(greatest_kink(ring), 1e-14);
}

TEST(BuildModel, GivesABeamWithTorsionTheStiffnessOfItsSections) {
  const BuildReport report = built({"beams[0].torsion=true", "beams[0].material.poissons_ratio=0.25"});
  ASSERT_TRUE(report.value);
  EXPECT_TRUE(report.diagnostics.empty());
  const BeamModel& model = report.value->model;
  EXPECT_EQ(model.dimension, 3);  // though everything lies in a plane
  const Beam& beam = model.beams[0];
  ASSERT_TRUE(beam.has_torsion());
  const double I = std::numbers::pi * 1e-8 / 4, E = 20e6;
  EXPECT_NEAR(beam.properties.sections->bending_1, E * I, 1e-12 * E * I);
  EXPECT_NEAR(beam.properties.sections->bending_2, E * I, 1e-12 * E * I);
  EXPECT_NEAR(beam.properties.sections->torsion, E / 2.5 * 2 * I, 1e-12 * E * I);
  EXPECT_NEAR(beam.properties.sections->spin_inertia, 7200 * 2 * I, 1e-12 * 7200 * I);
  EXPECT_LT((beam.curve.section(0.5).d2 - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_FALSE(built({}).value->model.beams[0].has_torsion());
}

TEST(BuildModel, DrawsSectionsOfAnyKindAlongTheAxis) {
  const BuildReport report = built(
      {R"(beams[0].section={"area": 1e-4, "second_moments": [2e-9, 1e-9], "product": 5e-10, "torsion_constant": 1e-9})",
       R"(beams[0].orientation={"up": [0, 1, 0], "twist": [[0, 0], ["50 cm", 90]]})",
       R"(beams[0].material.shear_modulus="8 MPa")", R"(supports[0].type="fork")"});
  ASSERT_TRUE(report.value) << report.diagnostics[0].message;
  const Beam& beam = report.value->model.beams[0];
  ASSERT_TRUE(beam.has_torsion());  // the keys ask for it
  EXPECT_NEAR(beam.properties.sections->bending_1, 20e6 * 2e-9, 1e-15);
  EXPECT_NEAR(beam.properties.sections->bending_2, 20e6 * 1e-9, 1e-15);
  EXPECT_NEAR(beam.properties.sections->bending_product, -20e6 * 5e-10, 1e-15);
  EXPECT_NEAR(beam.properties.sections->torsion, 8e6 * 1e-9, 1e-15);
  EXPECT_LT((beam.curve.section(0).d2 - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((beam.curve.section(0.8).d2 + beam.curve.section(0).d1).norm(), 1e-14);
  EXPECT_TRUE(std::get<Support>(report.value->model.constraints[0]).fork);
}

TEST(BuildModel, SaysThatAnExtremeFibreHasNoPlaceOnASectionThatBendsUnalike) {
  const BuildReport report = built(
      {R"(beams[0].section={"area": 1e-4, "second_moments": [2e-9, 1e-9], "torsion_constant": 1e-9, "extreme_fibre": 0.01})",
       "beams[0].torsion=true", "beams[0].material.poissons_ratio=0.3"});
  ASSERT_TRUE(report.value);
  EXPECT_TRUE(std::ranges::any_of(report.diagnostics, [](const Diagnostic& d) {
    return d.severity == Severity::warning &&
           d.where.find("beams[0].section.extreme_fibre") != std::string::npos &&
           d.message.find("that needs a \"profile\"") != std::string::npos;
  }));
}

TEST(BuildModel, PlacesWarpingWhereTheSectionIsGiven) {
  const BuildReport report = built(
      {"beams[0].torsion=true",
       R"(beams[0].section={"i_section": {"width": 0.05, "height": 0.1, "flange": 0.002, "web": 0.002}})"});
  ASSERT_TRUE(report.value);
  const auto warps = [](const Diagnostic& d) { return d.message.find("warping") != std::string::npos; };
  const auto found = std::find_if(report.diagnostics.begin(), report.diagnostics.end(), warps);
  ASSERT_NE(found, report.diagnostics.end());
  EXPECT_TRUE(found->where.ends_with(": beams[0].section")) << found->where;
}

TEST(BuildModel, GivesTorsionWhereAKeyNeedsSections) {
  for (const char* key :
       {R"(supports[0].type="fork")", R"(loads=[{"beam": "cable", "torque_per_length": "2 N m/m"}])",
        R"(loads=[{"beam": "cable", "at": "end", "force": [0, 0, 1], "offset": [0, "5 mm"]}])",
        R"(supports[0]={"beam": "cable", "at": "start", "type": "pinned", "axis": [0, 1, 0]})"}) {
    const BuildReport report = built({key});
    ASSERT_TRUE(report.value) << key << report.diagnostics[0].message;
    EXPECT_TRUE(report.value->model.beams[0].has_torsion()) << key;
    EXPECT_EQ(report.value->model.dimension, 3) << key;
  }
  const BuildReport trolley = built(
      {R"(bodies=[{"name": "car", "mass": 1, "roll_inertia": "2 kg m^2"}])",
       R"(sliding_joints=[{"body": "car", "beam": "cable", "at": {"fraction": 0.5}, "follows_section": true,
           "offset": ["1 cm", -0.02]}])"});
  ASSERT_TRUE(trolley.value) << trolley.diagnostics[0].message;
  EXPECT_TRUE(trolley.value->model.beams[0].has_torsion());
  EXPECT_EQ(trolley.value->model.bodies[0].roll_inertia, 2);
  EXPECT_EQ(trolley.value->model.riders[0].offset, Eigen::Vector2d(0.01, -0.02));
}

TEST(BuildModel, NotesWhatIsTakenForTorsionWhenNothingIsSaid) {
  const BuildReport report =
      built({"beams[0].torsion=true", R"(beams[0].section={"area": 1e-4, "second_moment": 1e-9})"});
  ASSERT_TRUE(report.value);
  ASSERT_EQ(report.diagnostics.size(), 2u);
  EXPECT_NE(report.diagnostics[0].message.find("twice"), std::string::npos);
  EXPECT_NE(report.diagnostics[1].message.find("0.3"), std::string::npos);
  EXPECT_NEAR(report.value->model.beams[0].properties.sections->torsion, 20e6 / 2.6 * 2e-9, 1e-15);
}

TEST(BuildModel, RefusesWhatABeamWithTorsionCannotBe) {
  const std::string on = "beams[0].torsion=true";
  EXPECT_TRUE(refuses(built({"beams[0].torsion=false", R"(beams[0].orientation={"up": [0, 0, 1]})"}),
                      "beams[0].orientation", {"\"torsion\" is false"}));
  EXPECT_TRUE(refuses(built({on, R"(beams[0].curvature="spatial")"}), "beams[0].curvature", {"torsion"}));
  EXPECT_TRUE(refuses(built({on, R"(beams[0].stress_free="as-drawn-without-torsion")"}),
                      "beams[0].stress_free", {"torsion"}));
  EXPECT_TRUE(
      refuses(built({R"(beams[0].orientation={"up": [1, 0, 0]})"}), "beams[0].orientation", {"s = 0 m"}));
  const std::string off = "beams[0].torsion=false";
  EXPECT_TRUE(refuses(built({off, R"(supports[0].type="fork")"}), "supports[0].type", {"no torsion"}));
  EXPECT_TRUE(refuses(built({off, R"(loads=[{"beam": "cable", "torque_per_length": 2}])"}),
                      "loads[0].torque_per_length", {"no torsion"}));
  EXPECT_TRUE(refuses(
      built({R"(supports[0]={"beam": "cable", "at": "start", "type": "clamped", "axis": [0, 1, 0]})"}),
      "supports[0].axis", {"hinge", "pinned"}));
  EXPECT_TRUE(refuses(built({R"(beams[0].section={"area": 1e-4, "second_moments": [1e-9, 1e-9]})"}),
                      "beams[0].section", {"torsion_constant"}));
  EXPECT_TRUE(refuses(built({R"(beams[0].section={"area": 1e-4, "second_moments": [1e-9]})"}),
                      "beams[0].section.second_moments", {"expected"}));
  const auto with_bead = [](const std::string& more, const std::string& roll) {
    return std::vector<std::string>{
        R"(bodies=[{"name": "bead", "mass": 1)" + roll + "}]",
        R"(sliding_joints=[{"body": "bead", "beam": "cable", "at": {"fraction": 0.5})" + more + "}]"};
  };
  EXPECT_TRUE(refuses(built(with_bead(R"(, "follows_section": true, "slope": "discontinuous")", "")),
                      "sliding_joints[0].follows_section", {"bead", "kink", "continuous"}));
  EXPECT_TRUE(refuses(built(with_bead(R"(, "carried_as": "point", "slope": "discontinuous")", "")),
                      "sliding_joints[0].carried_as", {"kink", "node"}));
  EXPECT_TRUE(
      refuses(built(with_bead("", R"(, "roll_inertia": 0.1)")), "bodies", {"bead", "follows_section"}));
  EXPECT_TRUE(refuses(built(with_bead(R"(, "follows_section": false, "offset": [0, 1])", "")),
                      "sliding_joints[0].offset", {"follows_section"}));
  EXPECT_TRUE(refuses(built({on, R"(beams[0].orientation={"twist": [[1, 0], [0, 9]]})"}),
                      "beams[0].orientation.twist", {"places must increase"}));
  EXPECT_TRUE(refuses(built({on, "beams[0].corners=hinge",
                             R"(beams[0].axis={"polyline": [[0, 0, 0], [1, 0, 0], [0.5, 0, 0]]})"}),
                      "beams[0].axis", {"turns right back", "(1, 0, 0) m", "\"curve\""}));
}

}  // namespace
}  // namespace nurbeam
