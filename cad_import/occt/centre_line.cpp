#include "cad_import/occt/centre_line.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "cad_import/occt/bar_joints.h"
#include "cad_import/occt/edge_curve.h"
#include "cad_import/occt/pipe_joints.h"
#include "cad_import/occt/pipe_piece.h"
#include "cad_import/occt/pipe_wall.h"
#include "cad_import/report/length_unit.h"
#include "nurbs/curve_chain.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

// Two radii, and two centre lines, are the same within this part of the radius (or the deviation of either).
constexpr double same_within = 1e-6;

bool near(const gp_Pnt& a, const gp_Pnt& b, double tolerance) { return a.Distance(b) <= tolerance; }

double tolerance_of(const Wall& a, const Wall& b) {
  return same_within * std::max(a.radius, b.radius) + 2 * std::max(a.deviation, b.deviation);
}

bool have_one_centre_line(const Wall& a, const Wall& b) {
  const double tolerance = tolerance_of(a, b);
  const bool same_ends = (near(a.start(), b.start(), tolerance) && near(a.end(), b.end(), tolerance)) ||
                         (near(a.start(), b.end(), tolerance) && near(a.end(), b.start(), tolerance));
  return same_ends && near(a.middle(), b.middle(), std::max(tolerance, 1e-3 * a.radius));
}

bool are_of_one_pipe(const Wall& a, const Wall& b) {
  return a.is_bore == b.is_bore && std::abs(a.radius - b.radius) <= tolerance_of(a, b) &&
         have_one_centre_line(a, b);
}

// The faces' walls put together that are of one pipe.
std::vector<Wall> whole_walls(const std::vector<Wall>& walls) {
  std::vector<Wall> joined;
  for (const Wall& wall : walls) {
    const auto same = std::find_if(joined.begin(), joined.end(),
                                   [&](const Wall& other) { return are_of_one_pipe(wall, other); });
    if (same == joined.end()) {
      joined.push_back(wall);
    } else {
      same->turn += wall.turn;
      same->deviation = std::max(same->deviation, wall.deviation);
    }
  }
  return joined;
}

bool turns_all_round(const Wall& wall) {
  constexpr double missing = 1e-3;  // [rad]
  return wall.turn >= 2 * pi - missing;
}

// Faces of no solid, as IGES has them, do not say on which side the material is: of those around one centre
// line every second one, from the outside, is a bore.
void find_bores_of_shells(std::vector<Wall>& walls) {
  const auto encloses = [](const Wall& a, const Wall& b) {
    return !a.in_solid && a.radius - b.radius > tolerance_of(a, b) && have_one_centre_line(a, b);
  };
  for (Wall& wall : walls)
    if (!wall.in_solid)
      wall.is_bore = std::count_if(walls.begin(), walls.end(),
                                   [&](const Wall& other) { return encloses(other, wall); }) %
                         2 ==
                     1;
}

CentreLine centre_line(const Wall& wall, double tolerance) {
  BRepBuilderAPI_MakeEdge edge(wall.centre, wall.first, wall.last);
  if (!edge.IsDone()) throw std::runtime_error("its centre line is no valid curve");
  ImportedCurve curve = imported_curve(edge.Edge(), tolerance);
  constexpr double round_off = 1e-9;  // of the radius
  curve.entity = "centre line";
  curve.free = false;
  curve.exact = wall.deviation <= round_off * wall.radius;
  curve.deviation = curve.exact ? 0 : wall.deviation / millimetres_per_metre;
  curve.pipe_radius = wall.radius / millimetres_per_metre;
  curve.bore_radius = wall.bore / millimetres_per_metre;
  return {std::move(curve), wall.face};
}

CentreLine centre_line(const BarLine& line) {
  const Eigen::Vector3d start = line.start * metres_per_millimetre, end = line.end * metres_per_millimetre;
  const double length = (end - start).norm();
  Eigen::Matrix3Xd points(3, 2);
  points << start, end;
  return {{.entity = "centre line",
           .free = false,
           .bar = line.section,
           .curve = make_nurbs_curve(KnotVector(1, {0, 0, length, length}), points, Eigen::Vector2d::Ones())},
          line.face};
}

// Those that meet end to end one after another, each running on from the one before it.
std::vector<CentreLine> in_running_order(const std::vector<CentreLine>& lines) {
  std::vector<NurbsCurve> curves;
  double largest = 0;
  for (const CentreLine& line : lines) {
    curves.push_back(line.curve.curve);
    largest = std::max({largest, line.curve.pipe_radius, line.curve.bar.width / 2});
  }
  std::vector<CentreLine> ordered;
  for (const Chain& chain : find_chains(curves, worst_deviation * largest))
    for (std::size_t i = 0; i < chain.curves.size(); ++i) {
      ordered.push_back(lines[chain.curves[i]]);
      if (chain.reversed[i]) ordered.back().curve.curve = ordered.back().curve.curve.reversed();
    }
  return ordered;
}

std::string refusal(const Wall& wall) {
  return "face " + std::to_string(wall.face) + " has a circular section of radius " + text_of(wall.radius) +
         " mm but its outline does not end a pipe: it gives no centre line; name an edge or a free curve as "
         "the axis";
}

// The walls of all faces: those of whole pipes that are cut at right angles, and others.
struct Walls {
  std::vector<Wall> square, other;
};

Walls walls_of(const TopTools_IndexedDataMapOfShapeListOfShape& solids_of_faces, double tolerance) {
  std::vector<Wall> rectangular;
  Walls walls;
  for (int i = 1; i <= solids_of_faces.Extent(); ++i) {
    try {
      OCC_CATCH_SIGNALS
      const TopoDS_Face& face = TopoDS::Face(solids_of_faces.FindKey(i));
      std::optional<Wall> wall =
          wall_of(face, !solids_of_faces(i).IsEmpty(), tolerance * millimetres_per_metre);
      if (!wall) continue;
      wall->face = i;
      (is_rectangular(face, bounds_of(face)) ? rectangular : walls.other).push_back(*wall);
    } catch (const Standard_Failure&) {
      continue;  // a face that OpenCASCADE cannot evaluate has no section; its edges are reported
    }
  }
  walls.square = whole_walls(rectangular);
  for (const Wall& wall : rectangular)
    if (std::none_of(walls.square.begin(), walls.square.end(), [&](const Wall& whole) {
          return turns_all_round(whole) && are_of_one_pipe(wall, whole);
        }))
      walls.other.push_back(wall);
  std::erase_if(walls.square, [](const Wall& wall) { return !turns_all_round(wall); });
  return walls;
}

// Whether a good part of the first is along the second.
bool runs_along(const PipePiece& piece, const PipePiece& other) {
  if (!have_one_axis(other.wall, piece.wall)) return false;
  const double start = parameter_on(other.wall, piece.wall.centre->Value(piece.ends[0].middle));
  const double end = parameter_on(other.wall, piece.wall.centre->Value(piece.ends[1].middle));
  const double overlap = std::min(std::max(start, end), other.ends[1].middle) -
                         std::max(std::min(start, end), other.ends[0].middle);
  return 2 * overlap > std::abs(end - start);
}

// As of whole walls of shells, for pieces however they are cut.
void find_bores_of_shells(std::vector<PipePiece>& pieces) {
  for (PipePiece& piece : pieces)
    if (!piece.wall.in_solid)
      piece.wall.is_bore =
          std::count_if(
              pieces.begin(), pieces.end(),
              [&](const PipePiece& other) {
                return other.wall.radius > piece.wall.radius * (1 + same_within) && runs_along(piece, other);
              }) %
              2 ==
          1;
}

// The outer walls of all pipes, each with the radius of its bore.
std::vector<PipePiece> outer_pieces(const std::vector<Wall>& square, const std::vector<PipePiece>& other) {
  std::vector<PipePiece> pieces;
  const auto add = [&](PipePiece piece, const auto& has_bore) {
    if (piece.wall.is_bore) return;
    const auto take = [&](const PipePiece& bore) {
      if (bore.wall.is_bore && bore.wall.radius < piece.wall.radius && has_bore(piece, bore))
        piece.wall.bore = std::max(piece.wall.bore, bore.wall.radius);
    };
    for (const Wall& wall : square) take(square_piece(wall));
    for (const PipePiece& bore : other) take(bore);
    pieces.push_back(std::move(piece));
  };
  for (const Wall& wall : square)
    add(square_piece(wall), [](const PipePiece& piece, const PipePiece& bore) {
      const bool both_square = bore.ends[0].is_square() && bore.ends[1].is_square();
      return both_square ? have_one_centre_line(piece.wall, bore.wall) : runs_along(piece, bore);
    });
  for (const PipePiece& piece : other) add(piece, runs_along);
  return pieces;
}

bool is_piece_of(const Wall& wall, const std::vector<PipePiece>& pieces) {
  return std::any_of(
      pieces.begin(), pieces.end(),
      [&](const PipePiece& piece) {
        return std::abs(piece.wall.radius - wall.radius) <= tolerance_of(piece.wall, wall) &&
               have_one_axis(piece.wall, wall);
      });
}

}  // namespace

CentreLines centre_lines(const TopoDS_Shape& shape, double tolerance) {
  TopTools_IndexedDataMapOfShapeListOfShape solids_of_faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_FACE, TopAbs_SOLID, solids_of_faces);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  CentreLines found;
  Walls walls = walls_of(solids_of_faces, tolerance);
  find_bores_of_shells(walls.square);
  std::vector<PipePiece> pieces = pipe_pieces(walls.other, faces);
  find_bores_of_shells(pieces);
  for (const Wall& wall : walls.other)
    if (!wall.is_bore && turns_all_round(wall) && !is_piece_of(wall, pieces))
      found.remarks.push_back(refusal(wall));
  const JoinedWalls joined = joined_walls(outer_pieces(walls.square, pieces));
  found.remarks.insert(found.remarks.end(), joined.remarks.begin(), joined.remarks.end());
  for (const Wall& wall : joined.walls) {
    try {
      OCC_CATCH_SIGNALS
      found.lines.push_back(centre_line(wall, tolerance));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      found.remarks.push_back("face " + std::to_string(wall.face) + ": " + e.what());
    }
  }
  JoinedBars bars = joined_bars(hollow_bars(shape, faces));
  for (const BarLine& line : bars.lines) found.lines.push_back(centre_line(line));
  for (std::string& remark : bars.remarks) found.remarks.push_back(std::move(remark));
  found.lines = in_running_order(found.lines);
  return found;
}

}  // namespace nurbeam
