#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Unique_hash_map.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "pipelines/section/cgal_geometry.h"

namespace nurbeam {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>, FaceBase>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

/// Marks the faces from which an odd number of constrained edges leads outside.
void mark_domain(Triangulation& triangulation) {
  CGAL::Unique_hash_map<Triangulation::Face_handle, bool> seen(false);
  std::vector<std::pair<Triangulation::Face_handle, bool>> border = {{triangulation.infinite_face(), false}};
  while (!border.empty()) {
    const auto [face, inside] = border.back();
    border.pop_back();
    if (seen[face]) continue;
    seen[face] = true;
    face->set_in_domain(inside);
    for (int i = 0; i < 3; ++i)
      border.emplace_back(face->neighbor(i), inside != triangulation.is_constrained({face, i}));
  }
}

using Segments = std::vector<Kernel::Segment_3>;
using Tree = CGAL::AABB_tree<
    CGAL::AABB_traits<Kernel, CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>>>;

Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// A bound of the distance of a cubic from its chord: that of its control points.
double bulge(const RationalCubic& cubic) {
  const Eigen::Vector3d start = cubic.control_point(0), chord = cubic.control_point(3) - start;
  double largest = 0;
  for (int i = 1; i <= 2; ++i) {
    const Eigen::Vector3d offset = cubic.control_point(i) - start;
    const double along =
        chord.squaredNorm() > 0 ? std::clamp(offset.dot(chord) / chord.squaredNorm(), 0.0, 1.0) : 0;
    largest = std::max(largest, (offset - along * chord).norm());
  }
  return largest;
}

}  // namespace

bool has_cgal() { return true; }

std::optional<TriangleMesh> delaunay_mesh(const std::vector<std::vector<Eigen::Vector2d>>& polygons,
                                          std::size_t most_points) {
  Triangulation triangulation;
  TriangleMesh mesh;
  constexpr int unnumbered = -1;
  CGAL::Unique_hash_map<Triangulation::Vertex_handle, int> number(unnumbered);
  const auto add = [&](Triangulation::Vertex_handle vertex) {
    number[vertex] = static_cast<int>(mesh.points.size());
    mesh.points.emplace_back(vertex->point().x(), vertex->point().y());
    return vertex;
  };
  for (const std::vector<Eigen::Vector2d>& polygon : polygons) {
    std::vector<Triangulation::Vertex_handle> vertices;
    for (const Eigen::Vector2d& corner : polygon)
      vertices.push_back(add(triangulation.insert({corner.x(), corner.y()})));
    for (std::size_t i = 0; i < vertices.size(); ++i)
      triangulation.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
  }
  mark_domain(triangulation);

  constexpr double no_size = 0, smallest_angle = 0.125;  // squared sine of 20.7 degrees
  CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation, Criteria(smallest_angle, no_size));
  mesher.init(true);
  while (!mesher.is_refinement_done()) {
    if (triangulation.number_of_vertices() > most_points) return {};
    mesher.step_by_step_refine_mesh();
  }
  for (const auto vertex : triangulation.finite_vertex_handles())
    if (number[vertex] == unnumbered) add(vertex);
  for (const auto face : triangulation.finite_face_handles())
    if (face->is_in_domain())
      mesh.triangles.push_back({number[face->vertex(0)], number[face->vertex(1)], number[face->vertex(2)]});
  return mesh;
}

ClosestPoint closest_place(const BezierPath& path, const Eigen::Vector3d& point) {
  constexpr int cuts = 8;
  Segments chords;
  std::vector<std::pair<int, RationalCubic>> pieces;
  double largest_bulge = 0;
  for (std::size_t j = 0; j < path.segments.size(); ++j)
    for (int k = 0; k < cuts; ++k) {
      const RationalCubic piece = path.segments[j].piece(k / double(cuts), (k + 1) / double(cuts));
      chords.emplace_back(to_cgal(piece.control_point(0)), to_cgal(piece.control_point(3)));
      pieces.emplace_back(static_cast<int>(j), piece);
      largest_bulge = std::max(largest_bulge, bulge(piece));
    }
  const Tree tree(chords.begin(), chords.end());
  // The closest place is on a piece whose chord is at most twice the bulge farther than the nearest chord.
  const double nearest = std::sqrt(tree.squared_distance(to_cgal(point)));
  const Eigen::Vector3d reach =
      Eigen::Vector3d::Constant((nearest + 2 * largest_bulge) * (1 + 1e-9) + 1e-15 * point.norm());
  std::vector<Segments::const_iterator> found;
  tree.all_intersected_primitives(Kernel::Iso_cuboid_3(to_cgal(point - reach), to_cgal(point + reach)),
                                  std::back_inserter(found));
  std::vector<int> segments;
  for (const auto chord : found) segments.push_back(pieces[chord - chords.begin()].first);
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  BezierPath candidates;
  for (const int j : segments) candidates.segments.push_back(path.segments[j]);
  ClosestPoint closest = closest_point(candidates, point);
  closest.segment = segments[closest.segment];
  return closest;
}

}  // namespace nurbeam
