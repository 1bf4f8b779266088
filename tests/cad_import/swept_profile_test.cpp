// Solids of sections that turn along their beam, judged by OpenCASCADE's reader and checker.

#include <gtest/gtest.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <Eigen/Geometry>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <cmath>
#include <numbers>

#include "cad_import/export_curves.h"
#include "nurbs/bezier_path.h"
#include "nurbs/interpolated_cubic.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/support/profiles.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

constexpr int stations = 25;

/// The profile along an arc of `turn` [rad] and radius 1 (a straight line of length 1 for 0), turned by
/// `twist` [rad] in all.
SweptProfile swept(const std::vector<Outline>& outlines, double area, double turn, double twist) {
  SweptProfile profile{"bar", "", {}, area * (turn > 0 ? turn : 1)};
  const auto place = [&](double s, const Eigen::Vector2d& p) -> Eigen::Vector3d {
    const double phi = turn * s, angle = twist * s;
    const Eigen::Vector3d centre =
        turn > 0 ? Eigen::Vector3d(std::sin(phi), 1 - std::cos(phi), 0) : Eigen::Vector3d(s, 0, 0);
    const Eigen::Vector3d a(-std::sin(phi), std::cos(phi), 0), b(0, 0, 1);
    return centre + (p.x() * std::cos(angle) - p.y() * std::sin(angle)) * a +
           (p.x() * std::sin(angle) + p.y() * std::cos(angle)) * b;
  };
  for (const Outline& outline : outlines) {
    std::vector<SweptCubic>& loop = profile.loops.emplace_back();
    for (const NurbsCurve& side : outline) {
      const BezierPath path = BezierPath::from_nurbs(side, 1e-9);
      for (const RationalCubic& cubic : path.segments) {
        const auto rail = [&](int k) {
          std::vector<double> t;
          Eigen::Matrix3Xd points(3, stations);
          for (int i = 0; i < stations; ++i) {
            t.push_back(static_cast<double>(i) / (stations - 1));
            points.col(i) = place(t.back(), cubic.control_point(k).head<2>());
          }
          return interpolated_cubic(t, points);
        };
        loop.push_back({{rail(0), rail(1), rail(2), rail(3)},
                        {cubic.weight(0), cubic.weight(1), cubic.weight(2), cubic.weight(3)}});
      }
    }
  }
  return profile;
}

TopoDS_Shape read_back(const std::filesystem::path& file) {
  STEPControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) return {};
  reader.TransferRoots();
  return reader.OneShape();
}

TEST(SweptSections, AreValidSolidsOfTheAreaTimesTheLength) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "solid.step";
  const double hole = pi * 0.02 * 0.02;
  for (const double turn : {0.0, 1.3})
    for (const double twist : {0.0, 2.0}) {
      SCOPED_TRACE(::testing::Message() << turn << " " << twist);
      const std::vector<NamedSolid> solids = {
          swept({rectangle(0.06, 0.1), {ellipse(0.02, 0.02)[0].reversed()}}, 0.06 * 0.1 - hole, turn, twist)};
      const std::vector<Diagnostic> problems = export_solids(file, solids, LengthUnit::millimetre);
      ASSERT_TRUE(problems.empty()) << problems.front().message;
      const TopoDS_Shape shape = read_back(file);
      ASSERT_FALSE(shape.IsNull());
      EXPECT_EQ(shape.ShapeType(), TopAbs_SOLID);
      EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
      GProp_GProps properties;
      BRepGProp::VolumeProperties(shape, properties);
      const double expected = (0.06 * 0.1 - hole) * (turn > 0 ? turn : 1);
      EXPECT_NEAR(1e-9 * properties.Mass() / expected, 1, 1e-4);
    }
}

double volume_read_back(const std::filesystem::path& file) {
  const TopoDS_Shape shape = read_back(file);
  EXPECT_FALSE(shape.IsNull());
  if (shape.IsNull()) return 0;
  EXPECT_EQ(shape.ShapeType(), TopAbs_SOLID);
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return 1e-9 * properties.Mass();
}

TEST(SweptSections, CloseAsRings) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "ring.step";
  const double hole = pi * 0.02 * 0.02, area = 0.06 * 0.1 - hole;
  for (const double twist : {0.0, 2 * pi}) {
    const std::vector<NamedSolid> solids = {
        swept({rectangle(0.06, 0.1), {ellipse(0.02, 0.02)[0].reversed()}}, area, 2 * pi, twist)};
    const std::vector<Diagnostic> problems = export_solids(file, solids, LengthUnit::millimetre);
    ASSERT_TRUE(problems.empty()) << problems.front().message;
    EXPECT_NEAR(volume_read_back(file) / (area * 2 * pi), 1, 5e-4) << twist;
  }
}

// Along x and then along y, from mitre to mitre.
TEST(SweptSections, GoOnFromCornerToCorner) {
  const double b = 0.06, h = 0.1;
  SweptProfile profile{"frame", "", {{}}, 2 * b * h};
  for (const NurbsCurve& side : rectangle(b, h)) {
    const RationalCubic cubic = BezierPath::from_nurbs(side, 1e-9).segments.front();
    const auto rail = [&](int k) {
      const double x = cubic.control_point(k).x(), y = cubic.control_point(k).y();
      Eigen::Matrix3Xd poles(3, 7);
      for (int i = 0; i < 4; ++i) {
        poles.col(i) << i / 3.0 * (1 - x), x, y;
        poles.col(3 + i) << 1 - x, x + i / 3.0 * (1 - x), y;
      }
      return make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}), poles,
                              Eigen::VectorXd::Ones(7));
    };
    profile.loops[0].push_back({{rail(0), rail(1), rail(2), rail(3)}, Eigen::Vector4d::Ones()});
  }
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "frame.step";
  const std::vector<Diagnostic> problems =
      export_solids(file, std::vector<NamedSolid>{profile}, LengthUnit::millimetre);
  ASSERT_TRUE(problems.empty()) << problems.front().message;
  EXPECT_NEAR(volume_read_back(file), 2 * b * h, 1e-9);
}

TEST(SweptSections, StandBesidePipes) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "both.step";
  const std::vector<NamedSolid> solids = {swept({rectangle(0.06, 0.1)}, 0.006, 0, 1),
                                          NamedPipe{{"rod", line({0, 1, 0}, {1, 1, 0})}, 0.02}};
  ASSERT_TRUE(export_solids(file, solids, LengthUnit::millimetre).empty());
  int count = 0;
  for (TopExp_Explorer solid(read_back(file), TopAbs_SOLID); solid.More(); solid.Next()) ++count;
  EXPECT_EQ(count, 2);
}

TEST(SweptSections, OfAnotherVolumeAreNotWritten) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "solid.step";
  const std::vector<NamedSolid> solids = {swept({rectangle(0.06, 0.1)}, 0.0061, 0, 0)};
  EXPECT_FALSE(export_solids(file, solids, LengthUnit::millimetre).empty());
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(SweptSections, OfOneCubicRunAlongTheSameKnots) {
  SweptProfile profile = swept({rectangle(0.06, 0.1)}, 0.006, 0, 0);
  profile.loops[0][0].rails[1] = line({0, 0, 0}, {1, 0, 0});
  const ScratchDirectory scratch;
  EXPECT_THROW(static_cast<void>(export_solids(scratch.path() / "a.step", std::vector<NamedSolid>{profile},
                                               LengthUnit::millimetre)),
               std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
