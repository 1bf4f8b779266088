#include "pipelines/section/torsion_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/section/cgal_geometry.h"

namespace nurbeam {

std::optional<TorsionMesh> TorsionMesh::make(const std::vector<Loop>& loops, std::size_t most_points) {
  const std::vector<ProfilePolygon> first = polygons_without_crossing(loops);
  if (first.empty()) return {};
  // A thin wall may need shorter edges than its outline: bent triangles must not fold.
  constexpr double coarsest = std::numbers::pi / 12, finest = coarsest / 128;
  for (double angle = coarsest; angle >= finest; angle /= 2) {
    const std::vector<ProfilePolygon> polygons = profile_polygons(loops, angle);
    if (crossing(polygons)) continue;
    std::vector<std::vector<Eigen::Vector2d>> corners;
    for (const ProfilePolygon& polygon : polygons) corners.push_back(polygon.corners);
    std::optional<TriangleMesh> made = delaunay_mesh(corners, most_points);
    if (!made) return {};
    TorsionMesh mesh(loops);
    mesh.points_ = std::move(made->points);
    mesh.triangles_.assign(made->triangles.begin(), made->triangles.end());
    for (int t = 0; t < static_cast<int>(mesh.triangles_.size()); ++t)
      for (int i = 0; i < 3; ++i) {
        const int a = mesh.triangles_[t][i], b = mesh.triangles_[t][(i + 1) % 3];
        (a < b ? mesh.edges_[edge(a, b)].left : mesh.edges_[edge(a, b)].right) = t;
      }
    mesh.add_boundary(polygons);
    if (mesh.is_sound()) return mesh;
  }
  return {};
}

/// Gives every boundary edge its piece of the paths, and moves corners that the mesh put on the polygons to
/// the paths.
void TorsionMesh::add_boundary(const std::vector<ProfilePolygon>& polygons) {
  std::map<int, int> next;  // along the boundary, the region on the left
  for (const auto& [edge, sides] : edges_)
    if (sides.left < 0 || sides.right < 0)
      next[sides.right < 0 ? edge.first : edge.second] = sides.right < 0 ? edge.second : edge.first;
  int corner = 0;
  for (const ProfilePolygon& polygon : polygons) {
    const int first = corner, count = static_cast<int>(polygon.corners.size());
    for (int i = 0; i < count; ++i, ++corner) {
      const int end = first + (i + 1) % count;
      const Eigen::Vector2d from = points_[corner], chord = points_[end] - from;
      BoundaryPiece piece = polygon.pieces[i];
      const RationalCubic& cubic = loops_[piece.loop][piece.segment];
      const double u0 = piece.u0, u1 = piece.u1;
      for (int at = corner; at != end; at = next.at(at)) {
        const int to = next.at(at);
        piece.u0 = at == corner ? u0 : piece.u1;
        piece.u1 = u1;
        if (to != end) {
          // Where the path has gone as far along the chord as this corner.
          const double part = (points_[to] - from).dot(chord) / chord.squaredNorm();
          double low = u0, high = u1;
          for (int k = 0; k < 60; ++k) {
            const double u = 0.5 * (low + high);
            ((cubic.point(u).head<2>() - from).dot(chord) < part * chord.squaredNorm() ? low : high) = u;
          }
          piece.u1 = 0.5 * (low + high);
          points_[to] = cubic.point(piece.u1).head<2>();
        }
        Neighbours& sides = edges_.at(edge(at, to));
        sides.piece = piece;
        sides.along = at < to;
      }
    }
  }
}

Eigen::Vector2d TorsionMesh::middle(const Edge& edge) const {
  const std::optional<BoundaryPiece>& piece = edges_.at(edge).piece;
  if (!piece) return 0.5 * (points_[edge.first] + points_[edge.second]);
  const Loop& loop = loops_[piece->loop];
  return loop[piece->segment].point(middle_of(loop, *piece)).head<2>();
}

bool TorsionMesh::is_sound() const {
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const BentTriangle nodes = bent_triangle(*this, t);
    for (const auto& [xi, eta] :
         {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}})
      if ((nodes * quadratic_slopes(xi, eta)).determinant() <= 0) return false;
  }
  return true;
}

TorsionMesh::Edge TorsionMesh::longest_edge(int triangle) const {
  const Triangle& t = triangles_[triangle];
  std::pair<double, Edge> longest{-1, {}};
  for (int i = 0; i < 3; ++i) {
    const int a = t[i], b = t[(i + 1) % 3];
    longest = std::max(longest, {(points_[b] - points_[a]).norm(), edge(a, b)});
  }
  return longest.second;
}

int TorsionMesh::across(int triangle, const Edge& edge) const {
  const Neighbours& sides = edges_.at(edge);
  return sides.left == triangle ? sides.right : sides.left;
}

void TorsionMesh::refine(const std::vector<int>& marked) {
  std::vector<Triangle> wanted;
  for (const int t : marked) wanted.push_back(triangles_[t]);
  for (std::size_t i = 0; i < marked.size(); ++i)
    while (triangles_[marked[i]] == wanted[i]) {
      // The path of longest edges from this triangle on ends in one that is longest on both its sides.
      int t = marked[i];
      Edge longest = longest_edge(t);
      for (int other = across(t, longest); other >= 0 && longest_edge(other) != longest;
           other = across(t, longest)) {
        t = other;
        longest = longest_edge(t);
      }
      bisect(longest);
    }
}

void TorsionMesh::bisect(const Edge& edge) {
  const Neighbours sides = edges_.at(edge);
  const int number = static_cast<int>(points_.size());
  points_.push_back(middle(edge));
  Neighbours first, second;  // of the halves at the smaller and at the other corner
  if (sides.piece) {
    const double u = middle_of(loops_[sides.piece->loop], *sides.piece);
    BoundaryPiece before = *sides.piece, after = *sides.piece;
    before.u1 = after.u0 = u;
    first.piece = sides.along ? before : after;
    second.piece = sides.along ? after : before;
    first.along = sides.along;
    second.along = !sides.along;  // the new corner has the greater number
  }
  edges_.erase(edge);
  edges_[{edge.first, number}] = first;
  edges_[{edge.second, number}] = second;
  for (const int t : {sides.left, sides.right})
    if (t >= 0) bisect(t, edge, number);
}

void TorsionMesh::bisect(int triangle, const Edge& edge, int middle) {
  const Triangle before = triangles_[triangle];
  int i = 0;
  while (TorsionMesh::edge(before[i], before[(i + 1) % 3]) != edge) ++i;
  const int a = before[i], b = before[(i + 1) % 3], c = before[(i + 2) % 3];
  const int added = static_cast<int>(triangles_.size());
  triangles_[triangle] = {a, middle, c};
  triangles_.push_back({middle, b, c});
  replace(TorsionMesh::edge(b, c), triangle, added);
  // The new corner has the greatest number.
  edges_[{a, middle}].left = triangle;
  edges_[{b, middle}].right = added;
  edges_[{c, middle}].left = added;
  edges_[{c, middle}].right = triangle;
}

void TorsionMesh::replace(const Edge& edge, int before, int after) {
  Neighbours& sides = edges_.at(edge);
  (sides.left == before ? sides.left : sides.right) = after;
}

BentTriangle bent_triangle(const TorsionMesh& mesh, int triangle) {
  const TorsionMesh::Triangle& corners = mesh.triangles()[triangle];
  BentTriangle nodes;
  for (int i = 0; i < 3; ++i) {
    nodes.col(i) = mesh.points()[corners[i]];
    nodes.col(3 + i) = mesh.middle(TorsionMesh::edge(corners[i], corners[(i + 1) % 3]));
  }
  return nodes;
}

Eigen::Matrix<double, 6, 1> quadratic_shapes(double xi, double eta) {
  const double zeta = 1 - xi - eta;
  return {zeta * (2 * zeta - 1), xi * (2 * xi - 1), eta * (2 * eta - 1),
          4 * zeta * xi,         4 * xi * eta,      4 * eta * zeta};
}

Eigen::Matrix<double, 6, 2> quadratic_slopes(double xi, double eta) {
  const double zeta = 1 - xi - eta;
  Eigen::Matrix<double, 6, 2> slopes;
  slopes << 1 - 4 * zeta, 1 - 4 * zeta,  //
      4 * xi - 1, 0,                     //
      0, 4 * eta - 1,                    //
      4 * (zeta - xi), -4 * xi,          //
      4 * eta, 4 * xi,                   //
      -4 * eta, 4 * (zeta - eta);
  return slopes;
}

}  // namespace nurbeam
