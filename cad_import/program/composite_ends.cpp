#include "cad_import/program/composite_ends.h"

#include <IGESGeom_CompositeCurve.hxx>
#include <StepGeom_CompositeCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_TShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <string>

#include "cad_import/program/entity_origins.h"
#include "cad_import/program/repairs.h"
#include "cad_import/report/leniency.h"
#include "nurbs/arc_length.h"

namespace nurbeam {
namespace {

constexpr double largest_move = 0.01;  // of the length

/// The edges of a composite curve, in order.
std::vector<const TopoDS_TShape*> edges_of_composite(const TopoDS_Shape& shape) {
  std::vector<const TopoDS_TShape*> edges;
  for (TopExp_Explorer next(shape, TopAbs_EDGE); next.More(); next.Next())
    edges.push_back(next.Current().TShape().get());
  return edges;
}

Eigen::Vector3d end_of_curve(const NurbsCurve& curve, bool last) {
  return curve.point(last ? curve.knots().end() : curve.knots().start());
}

/// Moves one end, what is between less and less, the other end not at all; of a polyline that vertex alone.
NurbsCurve with_end_moved(const NurbsCurve& curve, bool last, const Eigen::Vector3d& move) {
  Eigen::Matrix4Xd points = curve.control_points();
  const Eigen::Index count = points.cols();
  for (Eigen::Index i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) / static_cast<double>(count - 1), part = last ? at : 1 - at;
    const double share = curve.degree() == 1 ? (part == 1 ? 1 : 0) : part;
    points.col(i).head<3>() += points(3, i) * share * move;
  }
  return {curve.knots(), points};
}

/// The two ends of two curves that are nearest to each other.
struct Gap {
  bool first_last, second_last;  // of each curve, whether it is its end
  double size;
};

Gap gap_between(const NurbsCurve& first, const NurbsCurve& second) {
  Gap least{true, false, (end_of_curve(first, true) - end_of_curve(second, false)).norm()};
  for (const bool a : {true, false})
    for (const bool b : {true, false})
      if (const double size = (end_of_curve(first, a) - end_of_curve(second, b)).norm(); size < least.size)
        least = {a, b, size};
  return least;
}

/// Closes the gap between two curves; returns its size where it is told.
double join_ends(NurbsCurve& first, NurbsCurve& second, const Leniency& leniency) {
  constexpr double round_off = 1e-10;
  const Gap gap = gap_between(first, second);
  const double size = std::min(length(first), length(second));
  if (gap.size <= round_off * size || !leniency.repairs(gap.size, size)) return 0;
  const Eigen::Vector3d a = end_of_curve(first, gap.first_last), b = end_of_curve(second, gap.second_last);
  first = with_end_moved(first, gap.first_last, (b - a) / 2);
  second = with_end_moved(second, gap.second_last, (a - b) / 2);
  return Leniency::is_told(gap.size, size) ? gap.size : 0;
}

bool is_composite(const Handle(Standard_Transient) & entity) {
  return entity->IsKind(STANDARD_TYPE(IGESGeom_CompositeCurve)) ||
         entity->IsKind(STANDARD_TYPE(StepGeom_CompositeCurve));
}

}  // namespace

void join_composites(const XSControl_Reader& reader, const CurvesOfEdges& curves, ImportReport& report) {
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  const Leniency leniency{report.resolution};
  Repairs repairs;
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const Handle(Standard_Transient) entity = process->Mapped(i);
    if (entity.IsNull() || !is_composite(entity)) continue;  // what a reference lacks is mapped, too
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (shape.IsNull()) continue;
    const std::vector<const TopoDS_TShape*> edges = edges_of_composite(shape);
    double largest = 0;
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      const auto first = curves.find(edges[k]), second = curves.find(edges[k + 1]);
      if (first == curves.end() || second == curves.end() || first == second) continue;
      for (std::size_t p = 0; p < std::min(first->second.size(), second->second.size()); ++p)
        largest = std::max(largest, join_ends(report.curves[first->second[p]].curve,
                                              report.curves[second->second[p]].curve, leniency));
    }
    if (largest > 0)
      repairs.add(entity_label(*reader.Model(), entity),
                  "the ends of parts of a composite curve that nearly meet are moved to the point midway",
                  largest);
  }
  repairs.tell(report);
}

bool is_same_but_for_ends(const NurbsCurve& a, const NurbsCurve& b) {
  constexpr double round_off = 1e-9;  // of the length
  if (a.knots() != b.knots() || a.control_points().row(3) != b.control_points().row(3)) return false;
  const double size = length(a);
  NurbsCurve moved = a;
  for (const bool last : {false, true}) {
    const Eigen::Vector3d move = end_of_curve(b, last) - end_of_curve(a, last);
    if (move.norm() > largest_move * size) return false;
    moved = with_end_moved(moved, last, move);
  }
  const Eigen::Matrix3Xd apart =
      moved.control_points().colwise().hnormalized() - b.control_points().colwise().hnormalized();
  return apart.colwise().norm().maxCoeff() <= round_off * size;
}

}  // namespace nurbeam
