#pragma once
#include <Geom_Curve.hxx>
#include <gp_Pnt.hxx>
#include <optional>

class TopoDS_Face;

namespace nurbeam {

/// A piece of a pipe's wall: one face, [mm].
struct Wall {
  Handle(Geom_Curve) centre;
  double first = 0, last = 0;
  double radius = 0;
  double bore = 0;       // radius of its bore; 0 where it is solid
  double turn = 0;       // angle about the centre line [rad]
  double deviation = 0;  // of the wall from the pipe of this centre line and radius
  bool is_bore = false;
  bool in_solid = false;
  int face = 0;

  gp_Pnt start() const { return centre->Value(first); }
  gp_Pnt middle() const { return centre->Value((first + last) / 2); }
  gp_Pnt end() const { return centre->Value(last); }
};

/// A section is no circle, or none at right angles, when it differs by more than this part of the radius.
constexpr double worst_deviation = 1e-3;

/// The rectangle of the parameters of a face.
struct Bounds {
  double u0, u1, v0, v1;
};

Bounds bounds_of(const TopoDS_Face& face);

/// Whether the outline runs along lines of constant parameters only.
bool is_rectangular(const TopoDS_Face& face, const Bounds& bounds);

/// The wall that a face is; no radius where it is none.
std::optional<Wall> wall_of(const TopoDS_Face& face, bool in_a_solid, double tolerance);

}  // namespace nurbeam
