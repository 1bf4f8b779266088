#include "cad_import/step/arc_pipe.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <Eigen/Geometry>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/millimetres.h"

namespace nurbeam {
namespace {

gp_Ax2 plane_at(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
  return {in_millimetres(place), gp_Dir(normal.x(), normal.y(), normal.z())};
}

/// Null where the run is not of lines and arcs.
TopoDS_Shape swept(const Run& run, bool closed, double radius, double bore) {
  const TopoDS_Wire along = wire_of_arcs(run, closed);
  if (along.IsNull()) return {};
  const gp_Ax2 square = plane_at(run.spans.front().point(0), run.start_direction());
  const auto rim = [&](double r) {
    const gp_Circ circle(square, r * millimetres_per_metre);
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire();
  };
  BRepBuilderAPI_MakeFace section(rim(radius));
  const bool hollow = bore > 0;
  if (hollow && !closed) section.Add(TopoDS::Wire(rim(bore).Reversed()));
  TopoDS_Shape solid = BRepOffsetAPI_MakePipe(along, section.Face()).Shape();
  if (hollow && closed) {  // without ends inner and outer faces are no one shell
    const TopoDS_Face core = BRepBuilderAPI_MakeFace(rim(bore)).Face();
    const TopExp_Explorer inside(BRepOffsetAPI_MakePipe(along, core).Shape(), TopAbs_SHELL);
    BRepBuilderAPI_MakeSolid with_core(TopoDS::Solid(solid));
    with_core.Add(TopoDS::Shell(inside.Current().Reversed()));
    solid = with_core.Solid();
  }
  return solid;
}

/// By how much a sweep must go on beyond a corner to reach through the mitre everywhere [m].
double overlap(const Eigen::Vector3d& in, const Eigen::Vector3d& out, double radius) {
  constexpr double more = 1.25;
  return more * radius * in.cross(out).norm() / (1 + in.dot(out));
}

/// The shape without what is beyond the mitre of a corner.
TopoDS_Shape cut_at(const Eigen::Vector3d& corner, const Eigen::Vector3d& in, const Eigen::Vector3d& out,
                    double radius, const TopoDS_Shape& shape) {
  const gp_Ax2 mitre = plane_at(corner, in + out);
  const double reach = 2 * millimetres_per_metre * (radius + overlap(in, out, radius));
  const gp_Vec aside = -reach * (gp_Vec(mitre.XDirection()) + gp_Vec(mitre.YDirection()));
  const TopoDS_Shape beyond =
      BRepPrimAPI_MakeBox(mitre.Translated(aside), 2 * reach, 2 * reach, reach).Shape();
  return BRepAlgoAPI_Cut(shape, beyond).Shape();
}

/// The sweep along a run that goes on straight beyond its corners, cut at their mitres.
TopoDS_Shape mitred(Run run, double radius, double bore) {
  const Eigen::Vector3d start = run.spans.front().point(0), end = run.spans.back().point(1);
  const Eigen::Vector3d back = -run.start_direction(), forth = run.end_direction();
  if (run.before)
    run.spans.insert(run.spans.begin(),
                     straight_span(start + overlap(back, -*run.before, radius) * back, start));
  if (run.after) run.spans.push_back(straight_span(end, end + overlap(forth, *run.after, radius) * forth));
  TopoDS_Shape shape = swept(run, false, radius, bore);
  if (run.before) shape = cut_at(start, back, -*run.before, radius, shape);
  if (run.after) shape = cut_at(end, forth, *run.after, radius, shape);
  return shape;
}

}  // namespace

TopoDS_Shape arc_pipe(const Spine& spine, double radius, double bore) {
  const auto is_of_arcs = [](const Run& run) { return !wire_of_arcs(run, false).IsNull(); };
  if (!std::all_of(spine.runs.begin(), spine.runs.end(), is_of_arcs)) return {};
  const Run& first = spine.runs.front();
  if (spine.runs.size() == 1 && !first.before) return swept(first, spine.closed, radius, bore);
  TopoDS_Shape all;
  for (const Run& run : spine.runs) {
    const TopoDS_Shape piece = mitred(run, radius, bore);
    all = all.IsNull() ? piece : BRepAlgoAPI_Fuse(all, piece).Shape();
  }
  const TopExp_Explorer solids(all, TopAbs_SOLID);
  return solids.More() ? solids.Current() : all;
}

}  // namespace nurbeam
