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

TopoDS_Solid solid_of(const SweptProfile& profile) {
  BRepBuilderAPI_Sewing sewing(sewing_tolerance);
  for (const std::vector<SweptCubic>& loop : profile.loops)
    for (const SweptCubic& cubic : loop) {
      const BRepBuilderAPI_MakeFace face(surface_of(cubic), sewing_tolerance);
      if (!face.IsDone()) throw std::runtime_error("OpenCASCADE makes no wall of a swept section");
      sewing.Add(face.Face());
    }
  for (const bool at_end : {false, true}) sewing.Add(end_face(profile, at_end));
  sewing.Perform();
  const TopExp_Explorer shells(sewing.SewedShape(), TopAbs_SHELL);
  if (!shells.More()) throw std::runtime_error("OpenCASCADE makes no shell of the faces of a swept section");
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shells.Current())).Solid();
  BRepLib::OrientClosedSolid(solid);
  return solid;
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
