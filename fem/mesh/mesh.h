#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/mesh/mesh_plan.h"
#include "fem/structure/memory_places.h"

namespace nurbeam {

struct MeshNode {
  double s;         ///< reference arc length, on a ring in [0, length); of a moving node: when the mesh was
                    ///< made [m]
  int home;         ///< index of the home node, -1 for a moving node
  int rider;        ///< index of the rider, -1 for a home node
  int r;            ///< first of D position coordinates; of a moving node those of the rider's body, where
                    ///< that does not stand apart
  int slope_left;   ///< first of D gradient coordinates r_s, towards the beam's start
  int slope_right;  ///< the same as slope_left unless the node is a hinge or a corner
  int place;        ///< coordinate s of a moving node, else -1
  int angle_left = -1, angle_right = -1;  ///< of the section, of a beam with torsion: as slope_left, _right
};

/// The part of a beam between two nodes that follow one another: where an element is.
struct MeshSpan {
  int beam, node_a, node_b;  ///< node indices in the beam
  int place_a, place_b;      ///< coordinates s of moving ends, -1 of fixed ones
  int bubble;                ///< coordinate of a beam with torsion, else -1: of the twist between the ends
  double s_a, s_b;           ///< of fixed ends; of moving ends when the mesh was made [m]
  double shift_a, shift_b;   ///< of s from its coordinate at a moving end: full turns of a ring [m]

  /// Where it starts and ends for the coordinates q [m].
  double start(const Eigen::VectorXd& q) const { return place_a >= 0 ? q[place_a] + shift_a : s_a; }
  double end(const Eigen::VectorXd& q) const { return place_b >= 0 ? q[place_b] + shift_b : s_b; }
};

/// What a rider is in a mesh; the body's position is Mesh::bodies.
struct MeshRider {
  int place;  ///< coordinate s or sigma; -1 when free
  int node;   ///< index in its beam's nodes in mode node, else -1
};

/// The beams cut into spans, with global coordinate numbers: remade at every length-control event.
struct Mesh {
  int dimension = 3;
  MeshPlan plan;
  std::vector<std::vector<MeshNode>> nodes;  ///< per beam, in order; on a ring the first follows the last;
                                             ///< of a rigid guide none
  std::vector<MeshSpan> spans;               ///< in order along the beams
  std::vector<int> first_span;               ///< per beam, plus the end
  std::vector<MeshRider> riders;
  std::vector<int> bodies;  ///< first of D position coordinates of each body
  MemoryPlaces memory;      ///< in State::memory
  int coordinate_count = 0;

  const MeshNode& node_a(const MeshSpan& span) const { return nodes[span.beam][span.node_a]; }
  const MeshNode& node_b(const MeshSpan& span) const { return nodes[span.beam][span.node_b]; }
};

Mesh make_mesh(const Structure& structure, MeshPlan plan);

/// Index into mesh.spans of the span of a beam that holds s for the coordinates q; at a node the one after it
/// (the last one at the end of a beam that is no ring). A rigid guide has no spans to find.
int find_span(const Structure& structure, const Mesh& mesh, const Eigen::VectorXd& q, int beam, double s);

/// Whether a break of the drawing lies inside the span, or inside one that shares a moving node with it: then
/// its element is a plain cubic in arc length.
bool is_arc_length_span(const Structure& structure, const Mesh& mesh, int span);

}  // namespace nurbeam
