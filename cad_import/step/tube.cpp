#include "cad_import/step/tube.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <Convert_CircleToBSplineCurve.hxx>
#include <Eigen/Geometry>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Ax22d.hxx>
#include <gp_Circ.hxx>
#include <gp_Circ2d.hxx>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/millimetres.h"
#include "cad_import/step/tube_panels.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using tubes::Node;
using tubes::Panel;
using tubes::Panels;

/// A direction beyond a corner: its image in the mirror that is the mitre.
Eigen::Vector3d beyond_corner(const Eigen::Vector3d& across, const Node& before, const Node& after) {
  const Eigen::Vector3d normal = (before.tangent() + after.tangent()).normalized();
  return across - 2 * normal.dot(across) * normal;
}

/// The distances along the chords at the panels' starts, and at the end of all.
std::vector<double> chords_of(const std::vector<Panel>& panels) {
  std::vector<double> chords{0};
  for (const Panel& panel : panels) chords.push_back(chords.back() + tubes::chord(panel));
  return chords;
}

/// Sections that turn as little as they can; of a closed curve that close.
void add_sections(Panels& panels, const Spine& spine) {
  std::vector<Panel>& all = panels.all;
  const auto is_corner = [&](std::size_t i) {
    const auto run = std::find(panels.runs.begin(), panels.runs.end() - 1, i) - panels.runs.begin();
    return run + 1 < std::ssize(panels.runs) && spine.runs[run].before;
  };
  all.front().from.set_section(all.front().from.tangent().unitOrthogonal());
  for (std::size_t i = 0; i < all.size(); ++i) {
    Node &from = all[i].from, &to = all[i].to;
    if (i > 0)
      from.set_section(is_corner(i) ? beyond_corner(all[i - 1].to.across, all[i - 1].to, from)
                                    : all[i - 1].to.across);
    to.set_section(tubes::carried(from.across, from, to));
  }
  const Node &first = all.front().from, &last = all.back().to;
  const Eigen::Vector3d begun = first.across, axis = first.tangent();
  const Eigen::Vector3d ended = is_corner(0) ? beyond_corner(last.across, last, first) : last.across;
  const double turn = std::atan2(axis.dot(ended.cross(begun)), ended.dot(begun));
  const std::vector<double> chords = chords_of(all);
  const double rate = spine.closed ? turn / chords.back() : 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const bool end : {false, true}) {
      Node& node = end ? all[i].to : all[i].from;
      node.set_section(Eigen::AngleAxisd(rate * chords[i + (end ? 1 : 0)], node.tangent()) * node.across);
      node.twist = rate * node.rate.norm();
    }
  // Where two panels meet smoothly there is one section.
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t next = (i + 1) % all.size();
    if ((next == 0 && !spine.closed) || is_corner(next)) continue;
    all[i].to.across = all[next].from.across;
    all[i].to.along = all[next].from.along;
    all[i].to.forward = all[next].from.forward;
  }
}

/// From 1 at the corner to 0 at the distance `reach` from it, and the slope.
std::pair<double, double> fading(double distance, double reach) {
  const double q = std::min(distance / reach, 1.0);
  return {1 - q * q * q * (10 - 15 * q + 6 * q * q), -30 * q * q * (1 - q) * (1 - q) / reach};
}

/// The run's sections lean over into the mitres at its ends.
void lean_into_mitres(std::span<Panel> panels, const Run& run, double radius) {
  const std::vector<double> chords = chords_of({panels.begin(), panels.end()});
  const double length = chords.back();
  for (const bool at_end : {false, true}) {
    const auto& other = at_end ? run.after : run.before;
    if (!other) continue;
    const Node& corner = at_end ? panels.back().to : panels.front().from;
    const Eigen::Vector3d normal = corner.tangent() + *other;
    const Eigen::Vector2d lean =
        -Eigen::Vector2d(normal.dot(corner.across), normal.dot(corner.along)) / normal.dot(corner.tangent());
    const double reach = std::min(length, tubes::reach_of_lean(lean.norm(), radius));
    if (!(1.875 * radius * lean.norm() < 0.9 * reach))  // its steepest slope
      throw std::runtime_error("there is no room for a section of this radius to turn into its corner at " +
                               text_of(corner.centre));
    for (std::size_t i = 0; i < panels.size(); ++i)
      for (const bool end : {false, true}) {
        Node& node = end ? panels[i].to : panels[i].from;
        const double s = chords[i + (end ? 1 : 0)];
        const auto [part, slope] = fading(at_end ? length - s : s, reach);
        node.lean += part * lean;
        node.lean_rate += (at_end ? -slope : slope) * node.rate.norm() * lean;
      }
  }
}

/// Cubics along the curve; round it circles of degree 6 without inner knots, over which OpenCASCADE
/// integrates well.
Handle(Geom_BSplineSurface) surface_of(std::span<const Panel> panels, double radius) {
  const Convert_CircleToBSplineCurve circle(gp_Circ2d(gp_Ax22d(), radius), Convert_QuasiAngular);
  const int round = circle.NbPoles(), count = static_cast<int>(panels.size());
  TColgp_Array2OfPnt poles(1, round, 1, 3 * count + 1);
  TColStd_Array2OfReal weights(1, round, 1, 3 * count + 1);
  for (int k = 1; k <= round; ++k) {
    const gp_Pnt2d section = circle.Pole(k);
    const double x = section.X(), y = section.Y();
    for (int i = 0; i < count; ++i) {
      const std::array<Eigen::Vector3d, 4> own = panels[i].poles(x, y);
      for (int j = 0; j < 3; ++j) poles(k, 3 * i + j + 1) = in_millimetres(own[j]);
    }
    poles(k, 3 * count + 1) = in_millimetres(panels.back().to.place(x, y));
    for (int i = 1; i <= 3 * count + 1; ++i) weights(k, i) = circle.Weight(k);
  }
  TColStd_Array1OfReal angles(1, 2), knots(1, count + 1);
  TColStd_Array1OfInteger full(1, 2), multiplicities(1, count + 1);
  for (const int k : {1, 2}) {
    angles(k) = circle.Knot(k);
    full(k) = circle.Degree() + 1;
  }
  for (int i = 0; i <= count; ++i) {
    knots(i + 1) = i < count ? panels[i].from.parameter : panels.back().to.parameter;
    multiplicities(i + 1) = i == 0 || i == count ? 4 : 3;
  }
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, weights, angles, knots, full, multiplicities, circle.Degree(), 3);
  for (int i = 2; i <= count; ++i) surface->RemoveVKnot(i, 2, sewing_tolerance);
  // OpenCASCADE integrates along a face with as many points as its panels have poles: over few cubics too few
  // for the volume, which is of degree 8 in them.
  constexpr int few = 4, enough = 6;
  if (count < few) surface->IncreaseDegree(surface->UDegree(), enough);
  return surface;
}

/// The wall at this radius, one face for each span.
void add_wall(const Panels& panels, double radius, BRepBuilderAPI_Sewing& sewing) {
  for (std::size_t f = 0; f < panels.faces.size(); ++f) {
    const BRepBuilderAPI_MakeFace face(surface_of(panels.of_face(f), radius), sewing_tolerance);
    if (!face.IsDone()) throw std::runtime_error("OpenCASCADE makes no wall of a tube");
    sewing.Add(face.Face());
  }
}

/// The disk or annulus at an end.
TopoDS_Face end_face(const Node& end, double radius, double bore) {
  const auto direction = [](const Eigen::Vector3d& v) { return gp_Dir(v.x(), v.y(), v.z()); };
  const gp_Ax2 square(in_millimetres(end.centre), direction(end.across.cross(end.along)),
                      direction(end.across));
  const auto rim = [&](double r) {
    const gp_Circ circle(square, r * millimetres_per_metre);
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire();
  };
  BRepBuilderAPI_MakeFace face(rim(radius));
  if (bore > 0) face.Add(TopoDS::Wire(rim(bore).Reversed()));
  return face.Face();
}

TopoDS_Shell sewn(BRepBuilderAPI_Sewing& sewing) {
  sewing.Perform();
  const TopExp_Explorer shells(sewing.SewedShape(), TopAbs_SHELL);
  if (!shells.More()) throw std::runtime_error("OpenCASCADE makes no shell of the faces of a tube");
  return TopoDS::Shell(shells.Current());
}

}  // namespace

TopoDS_Shape tube(const Spine& spine, double radius, double bore) {
  Panels panels = tubes::panels_of(spine, radius);
  add_sections(panels, spine);
  for (std::size_t r = 0; r < spine.runs.size(); ++r)
    lean_into_mitres({panels.all.data() + panels.runs[r], panels.runs[r + 1] - panels.runs[r]}, spine.runs[r],
                     radius);
  BRepBuilderAPI_Sewing outside(sewing_tolerance), inside(sewing_tolerance);
  add_wall(panels, radius, outside);
  if (bore > 0) add_wall(panels, bore, spine.closed ? inside : outside);
  if (!spine.closed) {
    outside.Add(end_face(panels.all.front().from, radius, bore));
    outside.Add(end_face(panels.all.back().to, radius, bore));
  }
  BRepBuilderAPI_MakeSolid maker(sewn(outside));
  if (spine.closed && bore > 0) maker.Add(TopoDS::Shell(sewn(inside).Reversed()));
  TopoDS_Solid solid = maker.Solid();
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

}  // namespace nurbeam
