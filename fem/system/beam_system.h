#pragma once
#include <optional>
#include <vector>

#include "fem/constraints/held_angle.h"
#include "fem/mesh/mesh.h"
#include "solver/second_order_system.h"

namespace nurbeam {

/// Energies of the whole model [J].
struct SystemEnergy {
  double kinetic = 0, gravity = 0, axial = 0, bending = 0;
  double dissipation = 0;  ///< rate of energy lost to material damping [W]
  double mechanical() const { return kinetic + gravity + axial + bending; }
};

/// A beam model behind SecondOrderSystem: the only loop over elements.
///
/// Coordinates: per beam and node r (D), r_s (D; twice at a hinge, at a corner and where a joint's slope is
/// discontinuous), s (moving nodes), then position (D) and sigma of bodies carried as points or flying free.
/// Multipliers: supports in order (D for the position, D - 1 for a clamped direction), then per joint D for a
/// body on a point, 1 where s is prescribed or held, then per joint of two beams D for the position and 1 for
/// the angle of a rigid one, then 1 per rigid corner.
template <int D>
class BeamSystem final : public SecondOrderSystem {
 public:
  /// `held`: joints whose s is held at its value in the plan (for statics). The model must outlive the
  /// system.
  BeamSystem(const BeamModel& model, MeshPlan plan, std::vector<bool> held = {});

  const BeamModel& model() const { return *model_; }
  const Mesh<D>& mesh() const { return mesh_; }
  /// Scales gravity and all loads.
  void set_load_factor(double factor) { load_factor_ = factor; }

  int coordinate_count() const override { return mesh_.coordinate_count; }
  int constraint_count() const override { return constraint_count_; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override;
  Eigen::SparseMatrix<double> tangent_pattern() const override { return pattern_; }
  void tangent(const State& state, const TangentWeights& w, Eigen::SparseMatrix<double>& kkt) const override;
  Eigen::VectorXd constraint_rate(const State& state) const override;
  Eigen::VectorXd constraint_curvature(const State& state) const override;
  double step_limit(const State& state) const override;
  bool admissible(const State& state) const override;
  Eigen::VectorXd coordinate_scale() const override;

  SystemEnergy energy(const State& state) const;
  /// Linear momentum [N s] of beams and bodies.
  Eigen::Vector3d momentum(const State& state) const;
  /// Deformed length of a beam [m].
  double beam_length(const State& state, int beam) const;
  /// Force of the beam on the body of a joint, m (a - g) [N].
  Eigen::Vector3d joint_force(const State& state, int joint) const;
  /// Multiplier of a held or prescribed joint: the force along the beam [N] that keeps it there.
  double holding_force(const State& state, int joint) const;
  /// s of a joint's body [m], on a ring with the turns since the start; empty when it flies free.
  std::optional<double> place(const State& state, int joint) const;
  double place_rate(const State& state, int joint) const;

  /// The drawn shape; velocities, accelerations and multipliers zero.
  State drawn_state() const;
  /// Sets velocities: the material at rest, each joint's body moving along the beam with its initial speed.
  void start_joints(State& state) const;

 private:
  using Vector = Eigen::Matrix<double, D, 1>;
  // Row and column blocks of one contribution in the value array of the iteration matrix.
  struct Block {
    std::vector<int> dofs;
    std::vector<int> values;  // dofs.size()^2, column by column; -1 where a dof is -1
  };
  enum class ConstraintKind {
    position,
    direction,
    place,
    body_on_point,
    joint_position,
    joint_angle,
    corner_angle
  };
  // A material point of one element.
  struct Point {
    int element;  // -1 for place and corner_angle
    double s;     // of supports and joints of two beams [m]
    std::optional<ShapeFunctions<Jet>> fixed_shape;
  };
  struct Constraint {
    ConstraintKind kind;
    int row, rows;
    int index;  // support, sliding joint or joint of two beams; -1 for corner_angle
    Point point;
    std::optional<Point> other;  // on the second of two beams
    Block block;
    std::vector<int> gradient_values, transposed_values;  // rows x dofs, column by column
    std::optional<HeldAngle<D>> angle = {};               // of joint_angle and corner_angle
  };
  struct ConstraintTerms;

  Vector line_load(int beam, double t) const;
  Vector gravity() const { return load_factor_ * model_->gravity.head<D>(); }
  void build_constraints();
  void add_corner(const ReferenceCurve& curve, const MeshNode& node);
  Point point_at(int element, double s, const State& drawn) const;
  void build_pattern();
  ConstraintTerms constraint_terms(const Constraint& c, const State& state,
                                   const Eigen::VectorXd* multiplier) const;
  void add_joint_terms(const Constraint& c, const State& state, const Vector& y, bool with_hessian,
                       ConstraintTerms& terms) const;
  template <class Visit>
  void for_each_point_load(const State& state, Visit&& visit) const;

  const BeamModel* model_;
  Mesh<D> mesh_;
  std::vector<bool> held_;
  double load_factor_ = 1;
  std::vector<Block> element_blocks_;
  std::vector<Constraint> constraints_;
  std::vector<int> place_rows_;  // per joint: row of its place constraint or -1
  std::vector<std::array<int, 3>> body_values_;
  int constraint_count_ = 0;
  Eigen::SparseMatrix<double> pattern_;
};

extern template class BeamSystem<2>;
extern template class BeamSystem<3>;

}  // namespace nurbeam
