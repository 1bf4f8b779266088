#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Unique_hash_map.h>

#include <cstddef>
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

}  // namespace nurbeam
