#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "fem/mesh/mesh_plan.h"
#include "fem/structure/memory_places.h"

namespace nurbeam {

struct MeshNode {
  /// Reference arc length [m]; on a ring in [0, length); for a moving node its value when the mesh was made.
  double s;
  int home;   ///< index of the home node, -1 for a moving node
  int rider;  ///< index of the rider, -1 for a home node
  /// First of D position coordinates; a moving node shares those of its rider's body, unless the body stands
  /// apart.
  int r;
  int slope_left;   ///< first of D gradient coordinates r_s, towards the beam's start
  int slope_right;  ///< equals slope_left unless the node is a hinge or a corner
  int place;        ///< coordinate s of a moving node, else -1
  /// Angles of the section on a beam with torsion, as slope_left and slope_right.
  int angle_left = -1, angle_right = -1;
};

/// A span is the part of a beam between two nodes that follow one another, where an element is.
struct MeshSpan {
  int beam, node_a, node_b;  ///< node indices in the beam
  int place_a, place_b;      ///< coordinates s of moving ends, -1 of fixed ones
  int bubble;                ///< coordinate of the bubble of twist on a beam with torsion, else -1
  /// Places of fixed ends; for moving ends their values when the mesh was made [m]
  double s_a, s_b;
  double shift_a, shift_b;  ///< s less its coordinate at a moving end: full turns of a ring [m]

  /// Places of the span's ends for the coordinates q [m].
  double start(const Eigen::VectorXd& q) const { return place_a >= 0 ? q[place_a] + shift_a : s_a; }
  double end(const Eigen::VectorXd& q) const { return place_b >= 0 ? q[place_b] + shift_b : s_b; }
};

/// Coordinates of a rider in a mesh; Mesh::bodies has the position of its body.
struct MeshRider {
  int place;  ///< coordinate s or sigma; -1 when free
  int node;   ///< index among the nodes of its beam if carried as a node, else -1
};

/// The beams cut into spans, with global coordinate numbers: remade at every length-control event.
struct Mesh {
  int dimension = 3;
  MeshPlan plan;
  /// Per beam, in order; on a ring the first follows the last; a rigid guide has none.
  std::vector<std::vector<MeshNode>> nodes;
  std::vector<MeshSpan> spans;  ///< in order along the beams
  std::vector<int> first_span;  ///< per beam, plus the total count
  std::vector<MeshRider> riders;
  std::vector<int> bodies;  ///< first of D position coordinates of each body
  /// First of the 4 coordinates of the attitude of each body, -1 for a point mass.
  std::vector<int> attitudes;
  MemoryPlaces memory;  ///< indices in State::memory
  int coordinate_count = 0;

  const MeshNode& node_a(const MeshSpan& span) const { return nodes[span.beam][span.node_a]; }
  const MeshNode& node_b(const MeshSpan& span) const { return nodes[span.beam][span.node_b]; }
};

Mesh make_mesh(const Structure& structure, MeshPlan plan);

/// Index into mesh.spans of the span of a beam that holds s, for the coordinates q.
/// At a node the span after it counts; at the end of an open beam the last span. A rigid guide has no spans.
int find_span(const Structure& structure, const Mesh& mesh, const Eigen::VectorXd& q, int beam, double s);

/// The spans before and behind a node of a beam; where the elements of the beam end there, both are the last
/// one.
std::array<int, 2> spans_at(const Mesh& mesh, int beam, int node);

/// Whether a break of the drawing lies inside the span, or inside a span that shares a moving node with it:
/// the element is then a plain cubic in arc length.
bool is_arc_length_span(const Structure& structure, const Mesh& mesh, int span);

}  // namespace nurbeam
