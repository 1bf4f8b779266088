#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fem/element/reference_curve.h"
#include "fem/material/section.h"
#include "fem/material/section_stresses.h"
#include "fem/structure/home_nodes.h"

namespace nurbeam {

enum class WeightRule {
  material,  ///< ALE-RANCF, weights follow the material: one chart and one W per CAD segment
  constant,  ///< ALE-RANCF of the paper: an element keeps its four weights
  ones       ///< ALE-ANCF: plain cubics in reference arc length
};
/// Velocities after a merge: the mass-weighted L2 projection with `standard`; otherwise the remaining nodes
/// keep theirs.
enum class MergeRule {
  standard,  ///< material weights leave no choice; constant weights follow the paper's rule
  paper,     ///< Eqs. 31-38 of Ding & Ouyang, for comparison
  ones       ///< all ones, for comparison
};
/// The rule by which forces on moving elements follow from the fields (theory.md: forms V and P).
enum class Form {
  variational,  ///< Euler-Lagrange expressions of T - U with moving limits: conserves energy
  virtual_work  ///< form P, the papers', for comparison: fem/comparison/virtual_work.h
};

/// An initial velocity of the material of a beam: a rigid motion, and a motion along the axis.
struct BeamVelocity {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< [rad/s]
  Eigen::Vector3d about = Eigen::Vector3d::Zero();        ///< a point of the axis of the rotation [m]
  double along = 0;                                       ///< towards the beam's end [m/s]
};

/// A bend of a pipe, one segment of the axis, whose section ovalises: it bends more easily than the straight
/// pipe, under a greater stress.
struct PipeBend {
  int segment;
  BeamProperties properties;
  double stress_factor = 1;  ///< on the stress of bending
};

struct Beam {
  std::string name;
  ReferenceCurve curve;
  BeamProperties properties;
  Section section = {};    ///< the section that `properties` were derived from, if any
  Material material = {};  ///< the material that `properties` were derived from, if any
  /// Stress recovery for a beam with torsion whose outline is known.
  std::optional<SectionStresses> stresses = {};
  WeightRule weights = WeightRule::material;
  MergeRule merge = MergeRule::standard;
  Form form = Form::variational;
  std::optional<BeamVelocity> velocity = {};  ///< velocity at t = 0; without one the beam is at rest
  /// A steady run along itself, without change of shape, of a motion that starts in equilibrium: reference
  /// length per time towards its end [m/s].
  double flow = 0;
  std::vector<PipeBend> bends = {};  ///< in order of their segments
  /// A guide: the axis stays as drawn, without elements, mass or strain. Its home nodes are the breaks.
  bool rigid = false;
  /// A rope or a wire: where its elements are parts of a string (is_string), their moments are those of their
  /// own bending.
  bool rope = false;
  /// s increasing, from 0 to the length; on a ring the last one is the first again.
  std::vector<HomeNode> home;

  /// The bend that holds s; null where none does.
  const PipeBend* bend_at(double s) const;
  /// The properties of an element whose middle is at s.
  const BeamProperties& properties_at(double s) const;
  bool has_torsion() const { return properties.sections.has_value(); }
  /// A ring is a closed curve without ends.
  bool is_ring() const { return curve.closed(); }
  int home_intervals() const { return static_cast<int>(home.size()) - 1; }
  /// Number in `home` of home node h; on a ring h goes on over the seam, both ways.
  int home_index(int h) const;
  /// Reference arc length s of home node h; on a ring it lies beyond [0, length) for h over the seam [m].
  double home_place(int h) const;
  /// Home node h; on a ring h goes on over the seam.
  const HomeNode& home_node(int h) const { return home[home_index(h)]; }
  /// The home interval [h, h + 1] that holds s; on a ring h goes on over the seam.
  int home_interval(double s) const;
  /// Length of the home interval that holds s [m].
  double home_spacing(double s) const;
  /// The home node at s, within 1e-9 of the length; -1 where there is none.
  int home_at(double s) const;
};

}  // namespace nurbeam
