#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "pipelines/section/profile_polygon.h"

namespace nurbeam {

/// Six-node triangles over the region between closed paths, with their boundary edges bent to the paths.
class TorsionMesh {
 public:
  /// Two corners by number, the smaller one first.
  using Edge = std::pair<int, int>;
  struct Neighbours {
    int left = -1, right = -1;           ///< triangles, as seen from the smaller corner on; -1: none
    std::optional<BoundaryPiece> piece;  ///< of a boundary edge
    bool along = true;                   ///< whether the piece runs from the smaller corner to the other
  };
  using Triangle = std::array<int, 3>;  ///< corners, anticlockwise

  /// A coarse mesh by CGAL. Nothing without CGAL, when it would take more than `most_points`, or when the
  /// paths cross.
  static std::optional<TorsionMesh> make(const std::vector<Loop>& loops, std::size_t most_points);

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::map<Edge, Neighbours>& edges() const { return edges_; }
  const std::vector<Loop>& loops() const { return loops_; }
  static Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  /// The node of an edge: halfway, or on the path over the middle of the chord [m].
  Eigen::Vector2d middle(const Edge& edge) const;
  /// Whether every triangle is bent little enough to have a Jacobian above zero.
  bool is_sound() const;
  /// Bisects the triangles, and others as far as the mesh needs it to stay conforming: always the longest
  /// edge of both triangles on it (Rivara 1984).
  void refine(const std::vector<int>& marked);

 private:
  explicit TorsionMesh(const std::vector<Loop>& loops) : loops_(loops) {}
  void add_boundary(const std::vector<ProfilePolygon>& polygons);
  Edge longest_edge(int triangle) const;
  int across(int triangle, const Edge& edge) const;
  void bisect(const Edge& edge);
  void bisect(int triangle, const Edge& edge, int middle);
  void replace(const Edge& edge, int before, int after);

  std::vector<Loop> loops_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Triangle> triangles_;
  std::map<Edge, Neighbours> edges_;
};

/// Corners and then edge nodes of a bent triangle: 2 x 6 [m]; node 3 + i lies between corners i and i + 1.
using BentTriangle = Eigen::Matrix<double, 2, 6>;
BentTriangle bent_triangle(const TorsionMesh& mesh, int triangle);

/// The quadratic shape functions at (xi, eta), 6, and their derivatives with respect to them, 6 x 2.
Eigen::Matrix<double, 6, 1> quadratic_shapes(double xi, double eta);
Eigen::Matrix<double, 6, 2> quadratic_slopes(double xi, double eta);

}  // namespace nurbeam
