// What goes in as one smooth edge comes out as one: every smooth curve of the corpus, and every smooth run of
// its free curves, as a beam, undeformed and moved, through STEP and IGES, as OpenCASCADE reads them left
// alone. Other drawings are walked over, too, where NURBEAM_DRAWINGS names their folder.

#include <gtest/gtest.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <Geom_Curve.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_Edge.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"
#include "nurbs/curve_chain.h"
#include "nurbs/regular_segments.h"
#include "nurbs/smooth/smooth_corners.h"
#include "pipelines/results/export_results.h"
#include "tests/convergence/run_model.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/models.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

/// A smooth axis and what it was drawn with.
struct Drawn {
  std::string name;
  std::vector<RationalCubic> segments;
  int poles = 0;
  bool exact = true;        // its degree is at most 3
  double weight_range = 1;  // the largest of a curve to its smallest
};

double weight_range(const NurbsCurve& curve) {
  return curve.control_points().row(3).maxCoeff() / curve.control_points().row(3).minCoeff();
}

/// The axis as a case makes it of the curves; without segments where it has corners.
Drawn drawn_axis(const std::vector<ImportedCurve>& curves, const Chain& chain, double gap) {
  std::vector<NurbsCurve> shapes;
  for (const ImportedCurve& curve : curves) shapes.push_back(curve.curve);
  Drawn drawn{curves[chain.curves.front()].name, {}};
  double size = 0;
  for (const int i : chain.curves) {
    drawn.poles += static_cast<int>(shapes[i].control_points().cols()) - (size > 0 ? 1 : 0);
    drawn.exact &= shapes[i].degree() <= 3;
    drawn.weight_range = std::max(drawn.weight_range, weight_range(shapes[i]));
    size += length(shapes[i]);
  }
  const double tolerance = 1e-6 * size;
  const RegularSegments regular =
      regular_segments(join(shapes, chain, std::max(gap, tolerance)).segments, 1e-7 * size, tolerance);
  drawn.exact &= regular.dropped + regular.replaced == 0;
  constexpr double digits = 1e-6;  // [rad]
  std::vector<RationalCubic> segments = smooth_corners(regular.segments, digits).segments;
  if (corners_of(segments, digits).empty()) drawn.segments = std::move(segments);
  return drawn;
}

/// Every smooth curve of the file, and every smooth run of those that no face uses.
std::vector<Drawn> smooth_axes(const ImportReport& report) {
  std::vector<Drawn> axes;
  std::vector<ImportedCurve> free;
  for (const ImportedCurve& curve : report.curves) {
    axes.push_back(drawn_axis({curve}, {.curves = {0}, .reversed = {false}}, 0));
    if (curve.free) free.push_back(curve);
  }
  std::vector<NurbsCurve> shapes;
  for (const ImportedCurve& curve : free) shapes.push_back(curve.curve);
  const double gap = std::max(report.resolution, 1e-9);
  for (const Chain& chain : find_chains(shapes, gap))
    if (chain.curves.size() > 1) axes.push_back(drawn_axis(free, chain, gap));
  std::erase_if(axes, [](const Drawn& axis) { return axis.segments.empty(); });
  return axes;
}

/// The elements of a beam of this axis, three for each segment, before anything moves it.
std::vector<ElementRecord> elements_of(const Drawn& axis) {
  const int count = 3 * static_cast<int>(axis.segments.size());
  BeamModel model = testing::one_beam(axis.segments, 3, testing::round_bar(1e-3, 7800, 200e9), count, {});
  model.gravity.setZero();
  return testing::run_model(model, {0}, 1e-6).frames.at(0).beams.at(0).elements;
}

/// The elements, each node carried and turned with its tangent as in a motion.
std::vector<ElementRecord> moved(std::vector<ElementRecord> elements) {
  Eigen::AlignedBox3d box;
  for (const ElementRecord& element : elements) box.extend(element.control_points.col(0).hnormalized());
  const double size = std::max(box.diagonal().norm(), 1e-9);
  const bool closed = (elements.front().control_points.col(0).hnormalized() -
                       elements.back().control_points.col(3).hnormalized())
                          .norm() < 1e-9 * size;
  for (ElementRecord& element : elements)
    for (const int end : {0, 3}) {
      const bool seam = closed && end == 3 && &element == &elements.back();
      const Eigen::Vector3d about = seam ? elements.front().control_points.col(0).hnormalized().eval()
                                         : element.control_points.col(end).hnormalized().eval();
      const Eigen::Vector3d place = (about - box.center()) / size;
      const Eigen::Isometry3d motion =
          Eigen::Translation3d(about + 0.05 * size * place.cwiseProduct(place)) *
          Eigen::AngleAxisd(0.3 * place.x() * place.y(), Eigen::Vector3d(1, 2, 2).normalized()) *
          Eigen::Translation3d(-about);
      const auto columns = element.control_points.middleCols(end == 0 ? 0 : 2, 2).eval();
      element.control_points.middleCols(end == 0 ? 0 : 2, 2) = motion.matrix() * columns;
    }
  return elements;
}

/// The largest of what was found in a file.
struct Extremes {
  int curves = 0;
  double poles = 0, moved_poles = 0;  // against those allowed
  double weights = 0;                 // against the drawing's own range, or 20
  int fourth = 0;                     // moved curves of degree 4, for want of a cubic
};

NurbsCurve undeformed(const Drawn& axis, const std::vector<ElementRecord>& elements, Extremes& extremes) {
  const NurbsCurve curve = deformed_curve(elements, CurveParameter::free, WholeConics::smooth);
  const double allowed = axis.exact ? 1.5 * axis.poles : 2.0 * double(elements.size()) + 2;
  const double poles = double(curve.control_points().cols()) / allowed;
  extremes.poles = std::max(extremes.poles, poles);
  EXPECT_LE(poles, 1) << axis.name << ": " << curve.control_points().cols() << " poles, drawn with "
                      << axis.poles;
  const double weights = weight_range(curve) / std::max(20.0, axis.weight_range);
  extremes.weights = std::max(extremes.weights, weights);
  EXPECT_LE(weights, 1) << axis.name;
  return curve;
}

/// Whether some changes w_i -> c^i w_i of the elements, and intervals to go with them, make one C1 curve of
/// degree 3 of them, whose weights differ by no more than a factor of 20: those of one element give the next,
/// 1/c' = w_1'/w_0' - a_0'/a_1 (c - w_2/w_3) with the weighted legs a_0 and a_1 at the ends. A cubic of
/// higher degree has no other parameters in which it is one, and no interior knot may be fuller than double.
bool some_mild_cubic(const std::vector<ElementRecord>& elements) {
  const auto range_from = [&](double c) {
    double low = 1, high = 1, weight = 1;
    for (std::size_t j = 0; j < elements.size(); ++j) {
      const Eigen::Matrix4d& x = elements[j].control_points;
      double factor = weight / x(3, 0);
      for (int i = 0; i < 4; ++i, factor *= c) {
        weight = factor * x(3, i);
        low = std::min(low, weight);
        high = std::max(high, weight);
      }
      if (j + 1 == elements.size()) break;
      const Eigen::Matrix4d& y = elements[j + 1].control_points;
      const double beta = x(3, 2) / x(3, 3), alpha = y(3, 1) / y(3, 0);
      const double end = beta * (x.col(3).hnormalized() - x.col(2).hnormalized()).norm();
      const double start = alpha * (y.col(1).hnormalized() - y.col(0).hnormalized()).norm();
      c = 1 / (alpha - start / end * (c - beta));
      if (!(c > 0)) return std::numeric_limits<double>::infinity();
    }
    return high / low;
  };
  constexpr double reach = 5, step = 1e-3;
  for (double log_c = -reach; log_c <= reach; log_c += step)
    if (range_from(std::exp(log_c)) <= 20) return true;
  return false;
}

NurbsCurve deformed(const Drawn& axis, const std::vector<ElementRecord>& elements, Extremes& extremes) {
  const std::vector<ElementRecord> there = moved(elements);
  const NurbsCurve curve = deformed_curve(there);
  // A degree more, and so a knot more at each joint, only where no cubic is mild.
  const bool fourth = curve.degree() == 4 && !some_mild_cubic(there);
  const double allowed = (fourth ? 3.0 : 2.0) * double(elements.size()) + 2;
  extremes.fourth += fourth;
  const double poles = double(curve.control_points().cols()) / allowed;
  extremes.moved_poles = std::max(extremes.moved_poles, poles);
  EXPECT_LE(poles, 1) << axis.name << ": " << curve.control_points().cols() << " poles of " << elements.size()
                      << " moved elements";
  EXPECT_LE(weight_range(curve), std::max(20.0, axis.weight_range)) << axis.name;
  return curve;
}

/// The shape that OpenCASCADE makes of a file in its default settings.
TopoDS_Shape second_reading(const fs::path& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  if (file.extension() == ".step") {
    STEPControl_Reader reader;
    EXPECT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
    reader.TransferRoots();
    return reader.OneShape();
  }
  IGESControl_Reader reader;
  Interface_Static::SetIVal("read.iges.bspline.continuity", 1);
  EXPECT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
  reader.TransferRoots();
  return reader.OneShape();
}

void expect_one_c1_edge_each(const TopoDS_Shape& shape, const std::vector<NamedCurve>& curves) {
  ASSERT_FALSE(shape.IsNull());
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  ASSERT_EQ(edges.Extent(), int(curves.size()));
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges(i));
    ShapeAnalysis_Edge check;
    EXPECT_FALSE(check.CheckVerticesWithCurve3d(edge)) << curves[i - 1].name;
    EXPECT_LE(BRep_Tool::Tolerance(edge), 1e-7) << curves[i - 1].name;
    double first = 0, last = 0;
    EXPECT_GE(BRep_Tool::Curve(edge, first, last)->Continuity(), GeomAbs_C1) << curves[i - 1].name;
  }
}

void expect_names(const ImportReport& back, const std::vector<NamedCurve>& curves, const std::string& unit) {
  EXPECT_EQ(back.unit, unit);
  ASSERT_EQ(back.curves.size(), curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    EXPECT_EQ(back.curves[i].name, curves[i].name);
    if (unit != "mm") continue;  // IGES has no parts
    EXPECT_TRUE(back.curves[i].part.ends_with(curves[i].part)) << back.curves[i].part;
  }
}

Extremes walk(const fs::path& drawing) {
  SCOPED_TRACE(drawing);
  Extremes extremes;
  std::vector<NamedCurve> curves;
  for (const Drawn& axis : smooth_axes(import_curves(drawing))) {
    const std::string part = "beam " + std::to_string(++extremes.curves);
    const std::vector<ElementRecord> elements = elements_of(axis);
    curves.push_back({axis.name.empty() ? part : axis.name, undeformed(axis, elements, extremes), part});
    curves.push_back({part + " moved", deformed(axis, elements, extremes), part + " moved"});
  }
  if (curves.empty()) return extremes;
  const test::TemporaryDirectory directory;
  for (const auto& [name, unit, unit_name] :
       {std::tuple{"back.step", LengthUnit::millimetre, "mm"}, {"back.igs", LengthUnit::inch, "inch"}}) {
    SCOPED_TRACE(name);
    const fs::path file = directory.path() / name;
    EXPECT_TRUE(export_curves(file, curves, unit).empty());
    expect_one_c1_edge_each(second_reading(file), curves);
    expect_names(import_curves(file), curves, unit_name);
  }
  return extremes;
}

TEST(SmoothEdges, OfTheCorpusComeBackAsSmoothEdges) {
  int curves = 0;
  for (const auto& entry : fs::directory_iterator(test::source_directory() / "tests/corpus"))
    if (entry.is_regular_file() && entry.path().extension() != ".md" &&
        entry.path().filename() != ".gitattributes")
      curves += walk(entry.path()).curves;
  EXPECT_GT(curves, 200);
}

TEST(SmoothEdges, OfOtherDrawingsComeBackAsSmoothEdges) {
  const char* folder = std::getenv("NURBEAM_DRAWINGS");
  if (folder == nullptr) GTEST_SKIP() << "NURBEAM_DRAWINGS names no folder";
  int curves = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
    const Extremes found = walk(entry.path());
    curves += found.curves;
    std::cout << entry.path().filename() << ": " << found.curves << " smooth axes, poles " << found.poles
              << " and moved " << found.moved_poles << " of those allowed, weights " << found.weights
              << ", moved of degree 4: " << found.fourth << '\n';
  }
  std::cout << curves << " smooth axes\n";
}

}  // namespace
}  // namespace nurbeam
