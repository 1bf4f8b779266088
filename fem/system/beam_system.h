#pragma once
#include <memory>
#include <vector>

#include "fem/mesh/mesh.h"
#include "fem/model/beam_model.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

template <int D>
class Assembly;

/// A beam model in one mesh, as a system that integrators can advance. The dimension ends here: points and
/// vectors of its observables (observables.h, material_points.h) have three components, the third 0 in the
/// plane.
///
/// Coordinates: per beam and node r (D), r_s (D; twice at a hinge, at a corner and where a rider's slope is
/// discontinuous), s (moving nodes), then position (D) and sigma of bodies carried as points or flying free.
/// The order of the multipliers is private: reaction and holding_force ask for them.
class BeamSystem final : public SecondOrderSystem {
 public:
  /// `held`: riders whose s is held at its value in the plan (for statics).
  BeamSystem(std::shared_ptr<const BeamModel> model, MeshPlan plan, const std::vector<bool>& held = {});
  /// A system on the same mesh as `like`, a system of a neighbouring model. Common parts are taken from it.
  BeamSystem(std::shared_ptr<const BeamModel> model, MeshPlan plan, const std::vector<bool>& held,
             const BeamSystem& like);
  /// A system with a copy of the model.
  BeamSystem(const BeamModel& model, MeshPlan plan, const std::vector<bool>& held = {});
  /// A system in its initial plan.
  explicit BeamSystem(const BeamModel& model);
  /// The system of the model in another plan. Common parts are reused, also those of `neighbour`, a system of
  /// a neighbouring model in that plan.
  std::unique_ptr<BeamSystem> replanned(MeshPlan plan, const std::vector<bool>& held = {},
                                        const BeamSystem* neighbour = nullptr) const;
  ~BeamSystem() override;
  BeamSystem(BeamSystem&&) noexcept;
  BeamSystem& operator=(BeamSystem&&) noexcept;

  const BeamModel& model() const;
  const std::shared_ptr<const BeamModel>& shared_model() const;
  const Mesh& mesh() const;
  /// The riders whose s is held at its value in the plan, as given to the constructor.
  const std::vector<bool>& held() const;
  int dimension() const { return model().dimension; }

  int coordinate_count() const override;
  int constraint_count() const override;
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override;
  void constraints(const State& state, Eigen::Ref<Eigen::VectorXd> constraints) const override;
  const SparsePattern& tangent_pattern() const override;
  void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const override;
  void tangents(const State& state, const std::array<TangentWeights, 2>& w,
                const std::array<Eigen::SparseMatrix<double>*, 2>& kkt) const override;
  void residual_near(const State& state, const std::vector<bool>& near, Eigen::Ref<Eigen::VectorXd> dynamics,
                     Eigen::Ref<Eigen::VectorXd> constraints) const override;
  void tangent_near(const State& state, const TangentWeights& w, const std::vector<bool>& near,
                    double* values) const override;
  const std::vector<int>& moving_unknowns() const override;
  void moving_tangent(const State& state, const TangentWeights& w, Eigen::MatrixXd& part) const override;
  bool has_constant_constraints() const override;
  void turning_speeds(const State& state, Eigen::Ref<Eigen::VectorXd> speeds) const override;
  Eigen::VectorXd constraint_rate(const State& state) const override;
  Eigen::VectorXd constraint_product(const State& state, const Eigen::VectorXd& x) const override;
  Eigen::VectorXd constraint_curvature(const State& state) const override;
  double step_limit(const State& state) const override;
  bool admissible(const State& state) const override;
  Eigen::VectorXd coordinate_scale() const override;
  Eigen::VectorXd committed(const State& state) const override;
  bool forces_depend_on_multipliers() const override;
  bool has_constant_inertia() const override;

  /// The assembly of the system's dimension; null for the other one.
  template <int D>
  const Assembly<D>* assembly() const;

 private:
  BeamSystem(std::unique_ptr<const Assembly<2>> planar, std::unique_ptr<const Assembly<3>> spatial);

  std::unique_ptr<const Assembly<2>> planar_;
  std::unique_ptr<const Assembly<3>> spatial_;
  const SecondOrderSystem* system_;
};

}  // namespace nurbeam
