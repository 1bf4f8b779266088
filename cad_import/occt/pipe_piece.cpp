#include "cad_import/occt/pipe_piece.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Eigenvalues>
#include <ElCLib.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <gce_MakeCirc.hxx>
#include <gp_Ax2.hxx>
#include <gp_Vec.hxx>
#include <numbers>

namespace nurbeam {
namespace {

using std::numbers::pi;
using Outline = std::vector<gp_Pnt>;

constexpr double one_axis_within = 1e-6, ends_together = 1e-4;  // of the radius

constexpr int samples_of_centre = 16;

gp_Pnt sample_of(const Wall& wall, int i) {
  return wall.centre->Value(wall.first + (wall.last - wall.first) * i / samples_of_centre);
}

/// The line from start to end, where the centre line is one.
Handle(Geom_Line) line_of(const Wall& wall, double within) {
  const gp_Pnt start = wall.start();
  const gp_Vec along(start, wall.end());
  if (along.Magnitude() <= within) return nullptr;
  for (int i = 1; i < samples_of_centre; ++i)
    if (gp_Vec(start, sample_of(wall, i)).CrossMagnitude(along) > within * along.Magnitude()) return nullptr;
  return new Geom_Line(start, gp_Dir(along));
}

/// The circle that begins at the start and goes to the end, where the centre line is an arc of one.
Handle(Geom_Circle) circle_of(const Wall& wall, double within) {
  const gp_Pnt start = wall.start(), middle = wall.middle();
  const gce_MakeCirc maker(start, middle, wall.end());
  if (!maker.IsDone()) return nullptr;
  const gp_Pnt centre = maker.Value().Location();
  const double radius = maker.Value().Radius();
  const gp_Vec normal = gp_Vec(centre, start).Crossed(gp_Vec(centre, middle));
  if (normal.Magnitude() <= within * radius) return nullptr;
  for (int i = 1; i < samples_of_centre; ++i) {
    const gp_Vec out(centre, sample_of(wall, i));
    if (std::abs(out.Magnitude() - radius) > within ||
        std::abs(out.Dot(normal)) > within * normal.Magnitude())
      return nullptr;
  }
  return new Geom_Circle(gp_Ax2(centre, gp_Dir(normal), gp_Dir(gp_Vec(centre, start))), radius);
}

/// A centre line that is straight or an arc as a line or a circle, which go on beyond its ends.
void simplify(Wall& wall) {
  if (wall.centre->IsKind(STANDARD_TYPE(Geom_Line)) || wall.centre->IsKind(STANDARD_TYPE(Geom_Circle)))
    return;
  const double within = one_axis_within * wall.radius + wall.deviation;
  const gp_Pnt end = wall.end();
  if (const Handle(Geom_Line) line = line_of(wall, within); !line.IsNull()) {
    wall.last = wall.start().Distance(end);
    wall.centre = line;
    wall.first = 0;
  } else if (const Handle(Geom_Circle) circle = circle_of(wall, within); !circle.IsNull()) {
    wall.centre = circle;
    wall.first = 0;
    wall.last = ElCLib::Parameter(circle->Circ(), end);
  }
}

Outline points_of(const TopoDS_Edge& edge) {
  constexpr int samples = 48;
  const BRepAdaptor_Curve curve(edge);
  const double first = curve.FirstParameter(), last = curve.LastParameter();
  Outline points;
  for (int i = 0; i <= samples; ++i) points.push_back(curve.Value(first + (last - first) * i / samples));
  return points;
}

/// Whether two edges lie on each other: the faces of IGES have no edges in common.
bool coincide(const Outline& a, const Outline& b, double together) {
  const auto near = [&](const gp_Pnt& p, const gp_Pnt& q) { return p.Distance(q) <= together; };
  const bool same_ends = (near(a.front(), b.front()) && near(a.back(), b.back())) ||
                         (near(a.front(), b.back()) && near(a.back(), b.front()));
  if (!same_ends) return false;
  const auto is_on_b = [&](const gp_Pnt& point) {
    double distance = point.Distance(b.front()), step = 0;
    for (std::size_t i = 1; i < b.size(); ++i) {
      distance = std::min(distance, point.Distance(b[i]));
      step = std::max(step, b[i].Distance(b[i - 1]));
    }
    return distance <= step + together;
  };
  return is_on_b(a[a.size() / 3]) && is_on_b(a[a.size() / 2]);
}

/// Those of a face, each as often as it has it.
std::vector<Outline> edges_of(const TopoDS_Face& face) {
  std::vector<Outline> edges;
  for (TopExp_Explorer next(face, TopAbs_EDGE); next.More(); next.Next())
    if (!BRep_Tool::Degenerated(TopoDS::Edge(next.Current())))
      edges.push_back(points_of(TopoDS::Edge(next.Current())));
  return edges;
}

/// The edges that only one of the faces has, once.
std::vector<Outline> boundary_of(const std::vector<TopoDS_Face>& faces, double together) {
  std::vector<Outline> edges;
  for (const TopoDS_Face& face : faces)
    for (Outline& edge : edges_of(face)) {
      const auto same = std::find_if(edges.begin(), edges.end(),
                                     [&](const Outline& other) { return coincide(edge, other, together); });
      if (same == edges.end())
        edges.push_back(std::move(edge));
      else
        edges.erase(same);
    }
  return edges;
}

/// The closed outlines that the edges make; what does not close is left out.
std::vector<Outline> outlines_of(std::vector<Outline> left, double together) {
  std::vector<Outline> closed;
  while (!left.empty()) {
    Outline outline = left.back();
    left.pop_back();
    bool grows = true;
    while (grows && outline.front().Distance(outline.back()) > together) {
      grows = false;
      for (auto next = left.begin(); next != left.end() && !grows; ++next) {
        if (outline.back().Distance(next->back()) <= together) std::reverse(next->begin(), next->end());
        if (outline.back().Distance(next->front()) > together) continue;
        outline.insert(outline.end(), next->begin() + 1, next->end());
        left.erase(next);
        grows = true;
        break;
      }
    }
    if (outline.front().Distance(outline.back()) <= together) closed.push_back(std::move(outline));
  }
  return closed;
}

/// Where a plane through the points cuts the centre line; nothing where they lie in none.
std::optional<double> plane_cut(const Outline& outline, const Wall& wall, double near) {
  constexpr double in_plane = 1e-4;  // of the radius
  Eigen::Matrix3Xd points(3, outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) << outline[i].X(), outline[i].Y(), outline[i].Z();
  const Eigen::Vector3d middle = points.rowwise().mean();
  points.colwise() -= middle;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(points * points.transpose());
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if ((normal.transpose() * points).cwiseAbs().maxCoeff() > in_plane * wall.radius) return std::nullopt;
  double parameter = near;
  constexpr int steps = 20;
  for (int i = 0; i < steps; ++i) {
    gp_Pnt place;
    gp_Vec tangent;
    wall.centre->D1(parameter, place, tangent);
    const Eigen::Vector3d out = Eigen::Vector3d(place.X(), place.Y(), place.Z()) - middle;
    const double slope = normal.dot(Eigen::Vector3d(tangent.X(), tangent.Y(), tangent.Z()));
    if (std::abs(slope) < 1e-3 * tangent.Magnitude()) return std::nullopt;
    parameter -= normal.dot(out) / slope;
  }
  return std::isfinite(parameter) ? std::optional(parameter) : std::nullopt;
}

/// How far an outline turns about the centre line [rad], and how it ends the pipe there.
struct Turned {
  double turn = 0;
  PipeEnd end;
};

Turned turned(const Outline& outline, const Wall& wall) {
  std::vector<double> places;
  for (const gp_Pnt& point : outline) places.push_back(parameter_on(wall, point));
  Turned result{0,
                {*std::min_element(places.begin(), places.end()),
                 *std::max_element(places.begin(), places.end()), 0, std::nullopt, outline}};
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    gp_Pnt centre;
    gp_Vec tangent;
    wall.centre->D1((places[i] + places[i + 1]) / 2, centre, tangent);
    const gp_Vec a(wall.centre->Value(places[i]), outline[i]),
        b(wall.centre->Value(places[i + 1]), outline[i + 1]);
    const double angle = std::atan2(a.Crossed(b).Dot(tangent.Normalized()), a.Dot(b));
    result.turn += angle;
    result.end.middle += (places[i] + places[i + 1]) / 2 * angle;
  }
  if (std::abs(result.turn) > pi) result.end.middle /= result.turn;
  return result;
}

void finish(PipeEnd& end, const Wall& wall) {
  constexpr double square_within = 1e-3;  // of the radius
  if ((end.high - end.low) * speed_of(wall) <= square_within * wall.radius)
    end.low = end.high = end.middle;
  else
    end.cut = plane_cut(end.outline, wall, end.middle);
}

/// The piece of one surface that the faces are; nothing where they do not turn all the way round.
std::optional<PipePiece> piece_of(const std::vector<Wall>& walls, const TopTools_IndexedMapOfShape& faces) {
  std::vector<TopoDS_Face> own;
  PipePiece piece{walls.front(), {}};
  for (const Wall& wall : walls) {
    own.push_back(TopoDS::Face(faces(wall.face)));
    piece.wall.deviation = std::max(piece.wall.deviation, wall.deviation);
  }
  std::vector<PipeEnd> ends;
  const double together = ends_together * piece.wall.radius;
  for (const Outline& outline : outlines_of(boundary_of(own, together), together))
    if (Turned around = turned(outline, piece.wall); std::abs(around.turn) > pi) {
      finish(around.end, piece.wall);
      ends.push_back(std::move(around.end));
    }
  if (ends.size() != 2) return std::nullopt;
  if (ends[0].middle > ends[1].middle) std::swap(ends[0], ends[1]);
  piece.ends = {std::move(ends[0]), std::move(ends[1])};
  return piece;
}

bool are_of_one_surface(const Wall& a, const Wall& b) {
  return a.is_bore == b.is_bore &&
         std::abs(a.radius - b.radius) <= one_axis_within * a.radius + a.deviation + b.deviation &&
         have_one_axis(a, b);
}

/// The walls, those that are neighbours on one surface together.
std::vector<std::vector<Wall>> neighbours(const std::vector<Wall>& walls,
                                          const TopTools_IndexedMapOfShape& faces) {
  std::vector<std::size_t> group(walls.size());
  std::vector<std::vector<Outline>> edges;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    group[i] = i;
    edges.push_back(edges_of(TopoDS::Face(faces(walls[i].face))));
  }
  const auto share_an_edge = [&](std::size_t i, std::size_t k) {
    for (const Outline& edge : edges[i])
      for (const Outline& other : edges[k])
        if (coincide(edge, other, ends_together * walls[i].radius)) return true;
    return false;
  };
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (group[i] != group[k] && are_of_one_surface(walls[i], walls[k]) && share_an_edge(i, k))
        std::replace(group.begin(), group.end(), group[i], group[k]);
  std::vector<std::vector<Wall>> together(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) together[group[i]].push_back(walls[i]);
  std::erase_if(together, [](const auto& same) { return same.empty(); });
  return together;
}

}  // namespace

double speed_of(const Wall& wall) {
  gp_Pnt place;
  gp_Vec tangent;
  wall.centre->D1((wall.first + wall.last) / 2, place, tangent);
  return tangent.Magnitude();
}

double parameter_on(const Wall& wall, const gp_Pnt& point) {
  if (const auto line = Handle(Geom_Line)::DownCast(wall.centre))
    return ElCLib::Parameter(line->Lin(), point);
  if (const auto circle = Handle(Geom_Circle)::DownCast(wall.centre)) {
    const double middle = (wall.first + wall.last) / 2;
    return middle + std::remainder(ElCLib::Parameter(circle->Circ(), point) - middle, 2 * pi);
  }
  const GeomAPI_ProjectPointOnCurve nearest(point, wall.centre, wall.first, wall.last);
  const double to_start = point.Distance(wall.start()), to_end = point.Distance(wall.end());
  if (nearest.NbPoints() > 0 && nearest.LowerDistance() <= std::min(to_start, to_end))
    return nearest.LowerDistanceParameter();
  return to_start < to_end ? wall.first : wall.last;
}

bool have_one_axis(const Wall& a, const Wall& b) {
  const double tolerance = one_axis_within * std::max(a.radius, b.radius) + a.deviation + b.deviation;
  for (const gp_Pnt& place : {b.start(), b.middle(), b.end()})
    if (a.centre->Value(parameter_on(a, place)).Distance(place) > tolerance) return false;
  return true;
}

PipePiece square_piece(const Wall& wall) {
  return {wall,
          {PipeEnd{wall.first, wall.first, wall.first, std::nullopt},
           PipeEnd{wall.last, wall.last, wall.last, std::nullopt}}};
}

std::vector<PipePiece> pipe_pieces(const std::vector<Wall>& walls, const TopTools_IndexedMapOfShape& faces) {
  std::vector<Wall> simple = walls;
  for (Wall& wall : simple) simplify(wall);
  std::vector<PipePiece> pieces;
  for (const std::vector<Wall>& same : neighbours(simple, faces))
    if (auto piece = piece_of(same, faces)) pieces.push_back(std::move(*piece));
  return pieces;
}

}  // namespace nurbeam
