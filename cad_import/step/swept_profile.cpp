#include "cad_import/step/swept_profile.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Plane.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/millimetres.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

/// The cubic of the outline along u, the rails along v.
Handle(Geom_BSplineSurface) surface_of(const SweptCubic& cubic) {
  const KnotVector& along = cubic.rails[0].knots();
  const std::vector<double> breaks = along.breaks();
  const int count = along.control_point_count(), places = static_cast<int>(breaks.size());
  TColgp_Array2OfPnt poles(1, 4, 1, count);
  TColStd_Array2OfReal weights(1, 4, 1, count);
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < count; ++i) {
      poles(k + 1, i + 1) = in_millimetres(cubic.rails[k].control_points().col(i).head<3>());
      weights(k + 1, i + 1) = cubic.weights[k];
    }
  TColStd_Array1OfReal ends(1, 2), knots(1, places);
  TColStd_Array1OfInteger full(1, 2), multiplicities(1, places);
  ends(1) = 0;
  ends(2) = 1;
  full(1) = full(2) = 4;
  for (int i = 0; i < places; ++i) {
    knots(i + 1) = breaks[i];
    multiplicities(i + 1) = along.multiplicity(breaks[i]);
  }
  return new Geom_BSplineSurface(poles, weights, ends, knots, full, multiplicities, 3, along.degree());
}

bool is_ring(const SweptProfile& profile) {
  return std::ranges::all_of(
      profile.loops,
      [](const std::vector<SweptCubic>& loop) {
        return std::ranges::all_of(
            loop,
            [](const SweptCubic& cubic) {
              return std::ranges::all_of(
                  cubic.rails,
                  [](const NurbsCurve& rail) { return is_closed(rail, 1e-3 * sewing_tolerance); });
            });
      });
}

/// Where walls end: at the ends and corners of the rails; that of a ring is two at least.
std::vector<double> wall_ends(const KnotVector& along, bool ring) {
  const std::vector<double> breaks = along.breaks();
  std::vector<double> ends{breaks.front()};
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
    if (along.multiplicity(breaks[i]) >= along.degree()) ends.push_back(breaks[i]);
  if (ring && ends.size() == 1) ends.push_back(breaks[breaks.size() / 2]);
  ends.push_back(breaks.back());
  return ends;
}

/// The outline, or a hole, at an end.
TopoDS_Wire rim(const std::vector<SweptCubic>& loop, bool at_end) {
  BRepBuilderAPI_MakeWire wire;
  for (const SweptCubic& cubic : loop) {
    TColgp_Array1OfPnt poles(1, 4);
    TColStd_Array1OfReal weights(1, 4), knots(1, 2);
    TColStd_Array1OfInteger full(1, 2);
    knots(1) = 0;
    knots(2) = 1;
    full(1) = full(2) = 4;
    for (int k = 0; k < 4; ++k) {
      const Eigen::Matrix4Xd& points = cubic.rails[k].control_points();
      poles(k + 1) = in_millimetres(points.col(at_end ? points.cols() - 1 : 0).head<3>());
      weights(k + 1) = cubic.weights[k];
    }
    wire.Add(BRepBuilderAPI_MakeEdge(new Geom_BSplineCurve(poles, weights, knots, full, 3)).Edge());
  }
  if (!wire.IsDone()) throw std::runtime_error("OpenCASCADE makes no outline of a section");
  return wire.Wire();
}

TopoDS_Face end_face(const SweptProfile& profile, bool at_end) {
  BRepBuilderAPI_MakeFace face(rim(profile.loops.front(), at_end), /*OnlyPlane=*/true);
  if (!face.IsDone()) throw std::runtime_error("OpenCASCADE makes no end face of a section");
  for (std::size_t l = 1; l < profile.loops.size(); ++l) face.Add(rim(profile.loops[l], at_end));
  return face.Face();
}

/// The walls that a loop sweeps.
void add_walls(const std::vector<SweptCubic>& loop, bool ring, BRepBuilderAPI_Sewing& sewing) {
  for (const SweptCubic& cubic : loop) {
    const std::vector<double> ends = wall_ends(cubic.rails[0].knots(), ring);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const Handle(Geom_BSplineSurface) wall = surface_of(cubic);
      if (ends.size() > 2) wall->Segment(0, 1, ends[i], ends[i + 1]);
      const BRepBuilderAPI_MakeFace face(wall, sewing_tolerance);
      if (!face.IsDone()) throw std::runtime_error("OpenCASCADE makes no wall of a swept section");
      sewing.Add(face.Face());
    }
  }
}

/// The closed shell of sewn faces, outside out.
TopoDS_Shell shell_of(BRepBuilderAPI_Sewing& sewing) {
  sewing.Perform();
  const TopExp_Explorer shells(sewing.SewedShape(), TopAbs_SHELL);
  if (!shells.More()) throw std::runtime_error("OpenCASCADE makes no shell of the faces of a swept section");
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shells.Current())).Solid();
  BRepLib::OrientClosedSolid(solid);
  return TopoDS::Shell(TopExp_Explorer(solid, TopAbs_SHELL).Current());
}

/// Each loop sweeps a shell of its own.
TopoDS_Solid ring_of(const SweptProfile& profile) {
  BRepBuilderAPI_MakeSolid solid;
  for (const std::vector<SweptCubic>& loop : profile.loops) {
    BRepBuilderAPI_Sewing sewing(sewing_tolerance);
    add_walls(loop, true, sewing);
    const TopoDS_Shell shell = shell_of(sewing);
    solid.Add(&loop == profile.loops.data() ? shell : TopoDS::Shell(shell.Reversed()));
  }
  return solid.Solid();
}

TopoDS_Solid solid_of(const SweptProfile& profile) {
  if (is_ring(profile)) return ring_of(profile);
  BRepBuilderAPI_Sewing sewing(sewing_tolerance);
  for (const std::vector<SweptCubic>& loop : profile.loops) add_walls(loop, false, sewing);
  for (const bool at_end : {false, true}) sewing.Add(end_face(profile, at_end));
  return BRepBuilderAPI_MakeSolid(shell_of(sewing)).Solid();
}

}  // namespace

TopoDS_Shape swept_profile(const SweptProfile& profile) {
  constexpr double allowed = 1e-3;
  const TopoDS_Solid solid = solid_of(profile);
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties);
  const double expected = profile.volume * std::pow(millimetres_per_metre, 3);
  if (BRepCheck_Analyzer(solid).IsValid() && std::abs(properties.Mass() - expected) <= allowed * expected)
    return solid;
  throw std::runtime_error("OpenCASCADE makes no valid solid of the section of '" + profile.name +
                           "': its volume is " + text_of(properties.Mass() * 1e-9) +
                           " m^3, of its area times "
                           "its length " +
                           text_of(profile.volume) +
                           " m^3; it may run into itself, or turn too far within an element");
}

}  // namespace nurbeam
