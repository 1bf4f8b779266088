// Slender beams on meshes on which an element that locks is wrong: case files and their known answers.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "pipelines/results/frame_reader.h"
#include "pipelines/verification/verify_oracles.h"
#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam::test {
namespace {

using namespace verification;

/// The state in which a static case ends.
Snapshot at_rest(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  const std::filesystem::path results = directory.path() / "results";
  const std::filesystem::path file = test::source_directory() / "tests/cases" / name;
  std::vector<std::string> words = {"run", file.string(), "--quiet", "--out", results.string()};
  for (const std::string& override : overrides) words.insert(words.end(), {"--set", override});
  std::ostringstream out, err;
  EXPECT_EQ(run_command_line(words, out, err), 0) << err.str();
  return FrameReader(results / "results.nc").read(0, 1).at(0);
}

struct Range {
  double least, greatest;
};
Range axial_force(const BeamRecord& beam) {
  Range range{INFINITY, -INFINITY};
  for (const ElementRecord& element : beam.elements) {
    range.least = std::min(range.least, element.axial_force.minCoeff());
    range.greatest = std::max(range.greatest, element.axial_force.maxCoeff());
  }
  return range;
}

TEST(SlackCable, HasTheTensionOfTheCatenaryOnFortyElements) {
  // 20 m of wire of 1 mm radius between pins 10 m apart, with a hundredth of its bending stiffness, which as
  // it is takes 2.5 % from the tension at mid span.
  const double A = std::numbers::pi * 1e-6, w = 7850 * A * 9.81;
  const std::string section =
      "beams[0].section={\"area\":" + std::to_string(1e6 * A) + "e-6,\"second_moment\":7.85e-15}";
  const Snapshot rest = at_rest("d_axial_sawtooth.json", {"beams[0].elements.count=40", section});
  double length = 0;  // unstressed
  for (const ElementRecord& element : rest.beams[0].elements) length += element.s_end - element.s_start;
  const Hanging exact = hang({200e9 * A, w}, length, 10, 0);
  const Range N = axial_force(rest.beams[0]);
  EXPECT_NEAR(N.least, exact.H, 0.01 * exact.H);
  const double greatest = std::hypot(exact.H, w * length / 2);
  EXPECT_NEAR(N.greatest, greatest, 0.01 * greatest);
}

TEST(SlackCable, HasTheSameTensionOnCoarseAndFineMeshes) {
  const Range fine = axial_force(at_rest("d_axial_sawtooth.json").beams[0]);
  for (const int elements : {40, 80}) {
    const Range coarse = axial_force(
        at_rest("d_axial_sawtooth.json", {"beams[0].elements.count=" + std::to_string(elements)}).beams[0]);
    EXPECT_NEAR(coarse.least, fine.least, 0.01 * fine.least) << elements;
    EXPECT_NEAR(coarse.greatest, fine.greatest, 0.01 * fine.greatest) << elements;
  }
}

TEST(LoadedCantilever, HasNoAxialForceAtItsRoot) {
  // A dead load F at the tip pulls with its part along the tangent, which at the clamp is none.
  const Snapshot rest = at_rest("d_axial_cantilever.json");
  const BeamRecord& beam = rest.beams[0];
  EXPECT_NEAR(beam.elements[0].axial_force[0], 0, 1e-3);
  double largest = 0;
  for (const ElementRecord& element : beam.elements) {
    const RationalCubic cubic(element.control_points);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d tangent = cubic.derivatives(i / 3.0).col(1).normalized();
      largest = std::max(largest, std::abs(element.axial_force[i] - tangent.dot(Eigen::Vector3d(0, 0, -20))));
    }
  }
  EXPECT_LT(largest, 1e-2);
}

TEST(ClosedRail, HasTheSameRestShapeOnEveryMesh) {
  // The total energy of the fine meshes is 170,458.3 J; pointwise strain ends at 171,482 J with 64 elements.
  for (const int elements : {48, 64, 96}) {
    const Snapshot rest =
        at_rest("d_ring_static_spurious64.json", {"beams[0].elements.count=" + std::to_string(elements)});
    EXPECT_NEAR(rest.energy.total, 170458.3, 4) << elements;
  }
}

TEST(ZipLine, IsAccurateOnCoarseMeshes) {
  // A taut cable with a kink under its trolley, to 3 s: the trolley against that of 80 elements.
  const auto run = [](int elements) {
    return run_file(sample("zipline/zipline.json"),
                    {"beams[0].elements.count=" + std::to_string(elements), "analysis.end_time=3",
                     "output.every=0.05", "output.cad=null", "output.report=false"});
  };
  const CaseRun fine = run(80);
  for (const auto& [elements, error] : {std::pair{10, 2.4e-5}, {20, 7.9e-6}, {40, 1.3e-6}}) {
    const CaseRun coarse = run(elements);
    double farthest = 0;
    for (std::size_t i = 0; i < fine.rows.size(); ++i)
      farthest =
          std::max(farthest, std::hypot(coarse.value(i, "trolley.x [m]") - fine.value(i, "trolley.x [m]"),
                                        coarse.value(i, "trolley.z [m]") - fine.value(i, "trolley.z [m]")));
    EXPECT_LT(farthest, 1.2 * error) << elements;
  }
}

// A glass fibre of 30 m: forces along it of last bits are as large as its tip load, which bends it as the
// elastica of that load (Mattiasson; P L^2 / EI = 1, 5).
TEST(Fibre, BendsAsItsLoadSaysOrSaysThatNobodyKnows) {
  constexpr double length = 30, radius = 62.5e-6, E = 70e9;
  const double EI = E * std::numbers::pi * std::pow(radius, 4) / 4;
  const TemporaryDirectory directory;
  for (const auto& [q, deflection] : {std::pair{0.05, 0.016662}, {1.0, 0.30172}, {5.0, 0.71379}})
    for (const int elements : {20, 80, 200}) {
      std::ostringstream text;
      text.precision(17);
      text << R"({"nurbeam": 1, "gravity": [0, 0, 0],
        "beams": [{"name": "fibre", "axis": {"polyline": [[0, 0, 0], [30, 0, 0]]},
                   "section": {"radius": 6.25e-5}, "material": {"density": 2200, "youngs_modulus": 7e10},
                   "elements": {"count": )"
           << elements << R"(}}], "supports": [{"beam": "fibre", "at": "start", "type": "clamped"}],
        "loads": [{"beam": "fibre", "at": "end", "force": [0, 0, )"
           << -q * EI / (length * length) << R"(]}], "analysis": {"type": "static"},
        "output": {"probes": [{"name": "tip", "beam": "fibre", "at": "end"}]}})";
      const CaseRun run = run_file(directory.write("fibre.json", text.str()));
      if (run.code == 0)
        EXPECT_NEAR(-run.last("tip.z [m]") / length, deflection, 1e-3 * deflection) << q << " " << elements;
      else
        EXPECT_NE(run.messages.find("lost in the round-off"), std::string::npos) << run.messages;
    }
}

// A straight strut, clamped at its foot, above its critical load: the elastica, by Timoshenko & Gere's table
// 2-4.
TEST(Strut, BucklesIntoTheElastica) {
  const TemporaryDirectory directory;
  constexpr double radius = 0.002, E = 210e9;
  const double critical = std::pow(std::numbers::pi, 3) * E * std::pow(radius, 4) / 16;  // pi^2 EI / 4 L^2
  for (const auto& [part, aside] : {std::pair{0.99, 0.0},
                                    {1.01539, 0.21942},
                                    {1.06367, 0.42224},
                                    {1.15173, 0.59321},
                                    {2.54220, 0.75039}}) {
    std::ostringstream text;
    text.precision(17);
    text << R"({"nurbeam": 1, "gravity": [0, 0, 0],
      "beams": [{"name": "strut", "axis": {"polyline": [[0, 0, 0], [0, 0, 1]]}, "section": {"radius": 0.002},
                 "material": {"density": 7800, "youngs_modulus": 210e9}, "elements": {"count": 12}}],
      "supports": [{"beam": "strut", "at": "start", "type": "clamped"}],
      "loads": [{"beam": "strut", "at": "end", "force": [0, 0, )"
         << -part * critical << R"(]}], "analysis": {"type": "static"},
      "output": {"probes": [{"name": "tip", "beam": "strut", "at": "end"}]}})";
    const CaseRun run = run_file(directory.write("strut.json", text.str()));
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(std::hypot(run.last("tip.x [m]"), run.last("tip.y [m]")), aside, 3e-4) << part;
  }
}

// Drawn as its chord, with more length than that: pressed straight, from where it has many ways down.
TEST(SlackWire, FallsIntoItsCatenaryOnEveryMesh) {
  const TemporaryDirectory directory;
  for (const double radius : {0.0002, 0.005})
    for (const auto& [length, sag] : {std::pair{101.0, 6.14512}, {103.0, 10.71733}})
      for (const int elements : {30, 60, 100}) {
        std::ostringstream text;
        text << R"({"nurbeam": 1, "beams": [{"name": "w", "axis": {"polyline": [[0, 0, 0], [100, 0, 0]]},
          "unstressed_length": )"
             << length << R"(, "section": {"radius": )" << radius
             << R"(}, "material": "steel", "elements": {"count": )" << elements
             << R"(}}], "supports": [{"beam": "w", "at": "start", "type": "pinned"},
                                    {"beam": "w", "at": "end", "type": "pinned"}],
          "analysis": {"type": "static"}, "output": {"probes": [{"name": "m", "beam": "w", "at": {"fraction": 0.5}}]}})";
        const CaseRun run = run_file(directory.write("wire.json", text.str()));
        ASSERT_EQ(run.code, 0) << run.messages;
        EXPECT_NEAR(-run.last("m.z [m]"), sag, 4e-3 * sag) << radius << " " << elements;
      }
}

TEST(ZipLine, HangsAsWithoutItsTrolleyWhereASupportCarriesThat) {
  for (const char* at : {R"("start")", R"({"length": 1e-4})", R"("end")"}) {
    const CaseRun run = run_file(sample("zipline/zipline.json"),
                                 {std::string("sliding_joints[0].at=") + at, "analysis.end_time=0.02",
                                  "output.cad=null", "output.report=false"});
    EXPECT_EQ(run.code, 0) << at << run.messages;
  }
}

}  // namespace
}  // namespace nurbeam::test
