#pragma once
#include <array>
#include <vector>

#include "fem/element/beam_element.h"
#include "fem/model/beam_model.h"

namespace nurbeam {

/// How a sliding joint is carried at present.
enum class JointMode {
  node,     ///< a moving node of the beam: the elements on both sides change length
  point,    ///< a point sigma of the mesh, r_body = r(sigma): near an end of the beam or a late home node
  stopped,  ///< as point, held at the end
  free      ///< the body has left the beam
};

/// Which nodes are there, between two length-control events.
struct MeshPlan {
  std::vector<std::vector<bool>> present;  ///< per beam and home node
  std::vector<JointMode> modes;            ///< per sliding joint
  std::vector<double> places;              ///< s of each sliding joint when the plan is made [m]
  /// Constant weights by beam and (s_a, s_b), for elements whose weights a merge or split has set.
  struct Weights {
    int beam;
    double s_a, s_b;
    std::array<double, 4> w;
  };
  std::vector<Weights> weights;
};

struct MeshNode {
  double s;         ///< reference arc length, on a ring in [0, length); of a moving node: when the mesh was
                    ///< made [m]
  int home;         ///< index of the home node, -1 for a moving node
  int joint;        ///< index of the sliding joint, -1 for a home node
  int r;            ///< first of D position coordinates
  int slope_left;   ///< first of D gradient coordinates r_s, towards the beam's start
  int slope_right;  ///< the same as slope_left unless the node is a hinge or a corner
  int place;        ///< coordinate s of a moving node, else -1
};

template <int D>
struct MeshElement {
  int beam, node_a, node_b;  ///< node indices in the beam
  double s_a, s_b;           ///< of fixed ends; of moving ends when the mesh was made [m]
  double shift_a, shift_b;   ///< of s from its coordinate at a moving end: full turns of a ring [m]
  std::array<int, element_size<D>> dofs;  ///< global coordinates; -1 where a fixed end has none
  /// Of the slope at the right end from the node's, which is the one of the element after it: the small angle
  /// of the drawing there, kept so that the drawn shape is exact. Fixed in space, so only to first order of
  /// the angle under rotation.
  Eigen::Matrix<double, D, 1> slope_offset;
  BeamElement<D> element;

  /// s as the element counts it: on a ring without the turns by which it is away.
  double local(const ElementVector<D>& q_element, double s) const {
    return element.curve().unrolled(s, (q_element[4 * D] + q_element[4 * D + 1]) / 2);
  }
};

/// Coordinates of a sliding joint's body.
struct MeshJoint {
  int r;      ///< first of D position coordinates of the body
  int place;  ///< coordinate s or sigma; -1 when free
  int node;   ///< index in its beam's nodes in mode node, else -1
};

/// The beams cut into elements, with global coordinate numbers: remade at every length-control event.
template <int D>
struct Mesh {
  MeshPlan plan;
  std::vector<std::vector<MeshNode>> nodes;  ///< per beam, in order; on a ring the first follows the last
  std::vector<MeshElement<D>> elements;      ///< in order along the beams
  std::vector<int> first_element;            ///< per beam, plus the end
  std::vector<MeshJoint> joints;
  int coordinate_count = 0;
};

/// The drawn mesh with every sliding joint at its start: the home node nearest to it gives way to the moving
/// node; near an end or a late node the joint is a point.
MeshPlan initial_plan(const BeamModel& model);

template <int D>
Mesh<D> make_mesh(const BeamModel& model, MeshPlan plan);

/// Where an element starts and ends for the coordinates q [m].
template <int D>
double start_of(const MeshElement<D>& e, const Eigen::VectorXd& q) {
  const int dof = e.dofs[4 * D];
  return dof >= 0 ? q[dof] + e.shift_a : e.s_a;
}
template <int D>
double end_of(const MeshElement<D>& e, const Eigen::VectorXd& q) {
  const int dof = e.dofs[4 * D + 1];
  return dof >= 0 ? q[dof] + e.shift_b : e.s_b;
}

/// Index into mesh.elements of the element of a beam that holds s for the coordinates q; at a node the one
/// after it (the last one at the end of a beam that is no ring).
template <int D>
int find_element(const BeamModel& model, const Mesh<D>& mesh, const Eigen::VectorXd& q, int beam, double s);

/// Coordinates and rates of one element.
template <int D>
ElementState<D> gather(const MeshElement<D>& e, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::VectorXd& a) {
  ElementState<D> x;
  for (int i = 0; i < element_size<D>; ++i) {
    const int dof = e.dofs[i];
    x.q[i] = dof >= 0 ? q[dof] : (i == 4 * D ? e.s_a : e.s_b);
    if (dof >= 0 && i >= 4 * D) x.q[i] += i == 4 * D ? e.shift_a : e.shift_b;
    x.v[i] = dof >= 0 ? v[dof] : 0;
    x.a[i] = dof >= 0 ? a[dof] : 0;
  }
  x.q.template segment<D>(3 * D) += e.slope_offset;
  return x;
}

/// Position and material velocity fields at one material point; on a ring s may be any full turns away.
template <int D>
struct MaterialPoint {
  Eigen::Matrix<double, D, 1> r, rs, rss;            ///< [m], [-], [1/m]
  Eigen::Matrix<double, D, 1> velocity, velocity_s;  ///< material velocity and its s-derivative [m/s], [1/s]
  double kappa0;                                     ///< curvature of the drawing [1/m]
};
template <int D>
MaterialPoint<D> material_point(const MeshElement<D>& e, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                double s);

/// Nearness to a beam end, in home element lengths, at which a joint is carried as a point; it becomes a node
/// again at twice this distance.
inline constexpr double end_zone = 0.2;
/// Distance of two joints on a beam, in home element lengths, at which they count as having met.
inline constexpr double meeting_distance = 0.05;
/// Nearness to a late home node at which a joint becomes a point (or that node is removed, see
/// passes_as_point) and, larger, a node again, in home element lengths.
inline constexpr double late_zone = 0.04, late_zone_left = 0.05;
/// Whether a joint passes home node h of its beam as a point: late nodes, but no hinge or corner; a joint
/// with a discontinuous slope, which a point cannot carry, only supports. Breaks give way to such a one.
bool passes_as_point(const BeamModel& model, const SlidingJoint& joint, int h);
/// Whether a node that the joint passes as a point is within `reach` home element lengths of s.
bool near_as_point(const BeamModel& model, const SlidingJoint& joint, double s, double reach);

}  // namespace nurbeam
