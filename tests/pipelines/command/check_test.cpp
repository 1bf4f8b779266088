#include "pipelines/command/check.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

struct Checked {
  std::string out, err;
};

Checked checked_both(const std::vector<std::string>& overrides) {
  const test::TemporaryDirectory directory;
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  std::ostringstream out, err;
  EXPECT_EQ(check_case(report.value.value(), out, err), 0) << err.str();
  return {out.str(), err.str()};
}

std::string checked(const std::vector<std::string>& overrides) { return checked_both(overrides).out; }

TEST(CheckCase, PrintsTheShortestAndTheLongestElement) {
  const std::string out = checked({R"(beams[0].elements={"per_segment": 4, "grading": "10 cm"})"});
  EXPECT_NE(out.find("4 elements of 0.1 to 0.4 m"), std::string::npos) << out;
}

TEST(CheckCase, CountsForcesMomentsAndLoadsPerLengthApart) {
  const std::string out = checked({R"(loads=[{"beam": "cable", "at": "end", "force": [0, 0, -1]},
    {"beam": "cable", "at": "end", "moment": [0, 1, 0]}, {"beam": "cable", "force_per_length": [0, 0, -1]}])"});
  EXPECT_NE(out.find("point loads 1, moments 1, distributed loads 1"), std::string::npos) << out;
  const std::string twisted =
      checked({"beams[0].torsion=true", R"(loads=[{"beam": "cable", "torque_per_length": 3},
    {"beam": "cable", "force_per_length": [0, 0, -1]}])"});
  EXPECT_NE(twisted.find("distributed loads 2"), std::string::npos) << twisted;
}

TEST(CheckCase, SaysOfEachBeamInSpaceWhetherItHasTorsionAndWhy) {
  const std::string sideways = R"(loads=[{"beam": "cable", "at": "end", "force": [0, 1, 1]},
    {"beam": "cable", "at": "start", "force": [0, 1, 0]}])";
  const std::string bent =
      R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0],
    "normal": [0, 0, 1]}})";
  EXPECT_EQ(checked({}).find("torsion"), std::string::npos) << "a planar model has none";
  const auto says = [](const std::vector<std::string>& overrides, const std::string& why) {
    const std::string out = checked(overrides);
    EXPECT_NE(out.find("torsion   of cable: " + why), std::string::npos) << out;
  };
  says({"beams[0].torsion=true"}, "yes, as the case asks for it");
  says({bent, sideways}, "yes, as it is drawn curved in space");
  says({sideways}, "no, as it is drawn straight and bends alike");
  says(
      {R"(loads=[{"beam": "cable", "at": "end", "force": [0, 1, 1]}, {"beam": "cable", "at": "start", "force": [0, 1, 0]},
    {"beam": "cable", "at": "end", "moment": [0, 1, 0]}])"},
      "yes, as a moment on it has a part along it where it bends");
  says({bent, sideways, "beams[0].torsion=false"}, "no, as the case asks for an element without it");
}

// Of a beam of 1 m; 7200 kg/m^3 x 9.81 m/s^2 x 1 m over the modulus is the strain of its own weight.
TEST(CheckCase, WarnsOfWhatIsNoBeam) {
  const auto warned = [](const std::vector<std::string>& overrides) { return checked_both(overrides).err; };
  const auto has = [](const std::string& said, const std::string& part) {
    return said.find(part) != std::string::npos;
  };
  EXPECT_EQ(warned({}), "");
  const std::string metres = warned({"beams[0].section.radius=10"});
  EXPECT_TRUE(has(metres, "beams[0].section: is 20 m thick, of a beam 1 m long")) << metres;
  EXPECT_TRUE(has(warned({"beams[0].section={\"rectangle\": [0.6, 0.7]}"}), "is 0.6 m thick"));
  EXPECT_FALSE(has(warned({"beams[0].section={\"rectangle\": [0.3, 0.7]}"}), "thick"));  // a wide plate
  EXPECT_FALSE(has(warned({"beams[0].material.youngs_modulus=1e6"}), "soft"));
  const std::string soft = warned({"beams[0].material.youngs_modulus=70632"});
  EXPECT_TRUE(has(soft, "beams[0].material: is so soft that the weight of the beam strains it by 1 ("))
      << soft;
  EXPECT_FALSE(has(warned({"beams[0].material.youngs_modulus=70632", "gravity=[0, 0, -0.1]"}), "soft"));
}

TEST(CheckCase, RefusesFilesOfSectionsThatNothingOrients) {
  const test::TemporaryDirectory directory;
  const auto refused = [&](const std::vector<std::string>& overrides) {
    std::vector<std::string> all = {R"(output.cad={"formats": ["step", "step-section-lines"]})"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), all);
    std::ostringstream out, err;
    const int code = check_case(report.value.value(), out, err);
    return std::pair{code, err.str()};
  };
  const auto [code, said] = refused({});
  EXPECT_EQ(code, 2);
  EXPECT_NE(
      said.find("output.cad.formats[1]: is \"step-section-lines\", but the beam \"cable\" has no torsion"),
      std::string::npos)
      << said;
  EXPECT_EQ(refused({"beams[0].torsion=true", "supports[0].type=clamped"}).first, 0);
}

TEST(CheckCase, GivesTheHolonomyOfRings) {
  const std::string ring =
      R"(beams[0].axis={"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1],
    "control_points": [[1, 0, 0], [1, 1.3, 0.4], [-1, 1.3, 0.8], [-1, 0, 0.4], [-1, -1.3, 0], [1, -1.3, -0.4],
                       [1, 0, 0]]}})";
  const std::string out =
      checked({ring, "beams[0].closed=true", "beams[0].torsion=true", "supports[0].at=start"});
  EXPECT_NE(out.find("holonomy  of cable: sections carried around the ring"), std::string::npos) << out;
}

TEST(CheckCase, WarnsOfElementsThatTurnByMoreThan60Degrees) {
  const std::string bent =
      R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0],
    "normal": [0, 0, 1]}})";
  const Checked coarse = checked_both({bent, "beams[0].torsion=true", R"(beams[0].elements={"count": 1})"});
  EXPECT_NE(coarse.err.find("beams[0].elements: the axis turns by 90 degrees within the element"),
            std::string::npos)
      << coarse.err;
  const Checked fine = checked_both({bent, "beams[0].torsion=true", R"(beams[0].elements={"count": 2})"});
  EXPECT_EQ(fine.err.find("turns by"), std::string::npos) << fine.err;
}

TEST(CheckCase, WarnsOfSectionsThatTurnByMoreThan30DegreesInAnElement) {
  const auto warnings = [](const std::string& section, int count) {
    return checked_both({"beams[0].section=" + section, "beams[0].torsion=true",
                         "beams[0].elements={\"count\": " + std::to_string(count) + "}",
                         R"(beams[0].orientation={"start": [0, 0, 1], "twist": [[0, 0], [1, 350]]})"})
        .err;
  };
  const std::string strip = R"({"rectangle": ["40 mm", "5 mm"]})";
  const std::string coarse = warnings(strip, 5), fine = warnings(strip, 18);
  EXPECT_NE(coarse.find("beams[0].elements: the section is drawn with a twist, and turns by 7"),
            std::string::npos)
      << coarse;
  EXPECT_EQ(fine.find("turns by"), std::string::npos) << fine;
  EXPECT_EQ(warnings(R"({"radius": "5 mm"})", 5).find("turns by"), std::string::npos);
}

TEST(CheckCase, NotesWhatDampingDoesNotReachInBarsInSpaceWithoutTorsion) {
  const std::string sideways = R"(loads=[{"beam": "cable", "at": "end", "force": [0, 1, 1]},
    {"beam": "cable", "at": "start", "force": [0, 1, 0]}])";
  const std::string damped = "beams[0].material.damping=1e-3";
  const std::string thick = "beams[0].section.radius=\"50 mm\"", thin = "beams[0].section.radius=\"0.5 mm\"";
  const auto notes = [](const std::vector<std::string>& overrides) {
    return checked_both(overrides).err.find("a beam without torsion is damped in how much it bends") !=
           std::string::npos;
  };
  EXPECT_TRUE(notes({sideways, damped, thick}));
  EXPECT_FALSE(notes({sideways, thick})) << "no damping";
  EXPECT_FALSE(notes({damped, thick})) << "a plane";
  EXPECT_FALSE(notes({sideways, damped, thin})) << "a cable";
  EXPECT_FALSE(notes({sideways, damped, thick, "beams[0].torsion=true"}));
}

}  // namespace
}  // namespace nurbeam
