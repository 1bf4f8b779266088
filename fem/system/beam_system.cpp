#include "fem/system/beam_system.h"

#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

template <int D>
std::unique_ptr<const Assembly<D>> make_assembly(std::shared_ptr<const BeamModel> model, MeshPlan plan,
                                                 const std::vector<bool>& held, const Assembly<D>* like,
                                                 const Assembly<D>* neighbour = nullptr) {
  if (model->dimension != D) return nullptr;
  return std::make_unique<const Assembly<D>>(std::move(model), std::move(plan), held, like, neighbour);
}

}  // namespace

BeamSystem::BeamSystem(std::unique_ptr<const Assembly<2>> planar, std::unique_ptr<const Assembly<3>> spatial)
    : planar_(std::move(planar)), spatial_(std::move(spatial)) {
  if (planar_)
    system_ = planar_.get();
  else
    system_ = spatial_.get();
}

BeamSystem::BeamSystem(std::shared_ptr<const BeamModel> model, MeshPlan plan, const std::vector<bool>& held)
    : BeamSystem(make_assembly<2>(model, plan, held, nullptr), make_assembly<3>(model, plan, held, nullptr)) {
}

BeamSystem::BeamSystem(std::shared_ptr<const BeamModel> model, MeshPlan plan, const std::vector<bool>& held,
                       const BeamSystem& like)
    : BeamSystem(make_assembly<2>(model, plan, held, like.planar_.get()),
                 make_assembly<3>(model, plan, held, like.spatial_.get())) {}

BeamSystem::BeamSystem(const BeamModel& model, MeshPlan plan, const std::vector<bool>& held)
    : BeamSystem(std::make_shared<const BeamModel>(model), std::move(plan), held) {}

BeamSystem::BeamSystem(const BeamModel& model) : BeamSystem(model, initial_plan(model)) {}

BeamSystem::~BeamSystem() = default;
BeamSystem::BeamSystem(BeamSystem&&) noexcept = default;
BeamSystem& BeamSystem::operator=(BeamSystem&&) noexcept = default;

template <>
const Assembly<2>* BeamSystem::assembly<2>() const {
  return planar_.get();
}
template <>
const Assembly<3>* BeamSystem::assembly<3>() const {
  return spatial_.get();
}

std::unique_ptr<BeamSystem> BeamSystem::replanned(MeshPlan plan, const std::vector<bool>& held,
                                                  const BeamSystem* neighbour) const {
  const auto in_plan = [&]<int D>(const std::unique_ptr<const Assembly<D>>& own) {
    return make_assembly<D>(shared_model(), plan, held, own.get(),
                            neighbour ? neighbour->assembly<D>() : nullptr);
  };
  return std::unique_ptr<BeamSystem>(new BeamSystem(in_plan(planar_), in_plan(spatial_)));
}

const std::shared_ptr<const BeamModel>& BeamSystem::shared_model() const {
  return planar_ ? planar_->model() : spatial_->model();
}
const BeamModel& BeamSystem::model() const { return *shared_model(); }
const Mesh& BeamSystem::mesh() const { return planar_ ? planar_->mesh() : spatial_->mesh(); }
const std::vector<bool>& BeamSystem::held() const { return planar_ ? planar_->held() : spatial_->held(); }

int BeamSystem::coordinate_count() const { return system_->coordinate_count(); }
int BeamSystem::constraint_count() const { return system_->constraint_count(); }
void BeamSystem::residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                          Eigen::Ref<Eigen::VectorXd> constraints) const {
  system_->residual(state, dynamics, constraints);
}
void BeamSystem::constraints(const State& state, Eigen::Ref<Eigen::VectorXd> constraints) const {
  system_->constraints(state, constraints);
}
const SparsePattern& BeamSystem::tangent_pattern() const { return system_->tangent_pattern(); }
void BeamSystem::tangent(const State& state, const TangentWeights& w, SparseValues kkt) const {
  system_->tangent(state, w, kkt);
}
void BeamSystem::tangents(const State& state, const std::array<TangentWeights, 2>& w,
                          const std::array<Eigen::SparseMatrix<double>*, 2>& kkt) const {
  system_->tangents(state, w, kkt);
}
void BeamSystem::residual_near(const State& state, const std::vector<bool>& near,
                               Eigen::Ref<Eigen::VectorXd> dynamics,
                               Eigen::Ref<Eigen::VectorXd> constraints) const {
  system_->residual_near(state, near, dynamics, constraints);
}
void BeamSystem::tangent_near(const State& state, const TangentWeights& w, const std::vector<bool>& near,
                              double* values) const {
  system_->tangent_near(state, w, near, values);
}
const std::vector<int>& BeamSystem::moving_unknowns() const { return system_->moving_unknowns(); }
void BeamSystem::moving_tangent(const State& state, const TangentWeights& w, Eigen::MatrixXd& part) const {
  system_->moving_tangent(state, w, part);
}
bool BeamSystem::has_constant_constraints() const { return system_->has_constant_constraints(); }
void BeamSystem::turning_speeds(const State& state, Eigen::Ref<Eigen::VectorXd> speeds) const {
  system_->turning_speeds(state, speeds);
}
Eigen::VectorXd BeamSystem::constraint_rate(const State& state) const {
  return system_->constraint_rate(state);
}
Eigen::VectorXd BeamSystem::constraint_product(const State& state, const Eigen::VectorXd& x) const {
  return system_->constraint_product(state, x);
}
Eigen::VectorXd BeamSystem::constraint_curvature(const State& state) const {
  return system_->constraint_curvature(state);
}
double BeamSystem::step_limit(const State& state) const { return system_->step_limit(state); }
bool BeamSystem::admissible(const State& state) const { return system_->admissible(state); }
Eigen::VectorXd BeamSystem::coordinate_scale() const { return system_->coordinate_scale(); }
Eigen::VectorXd BeamSystem::committed(const State& state) const { return system_->committed(state); }
bool BeamSystem::forces_depend_on_multipliers() const { return system_->forces_depend_on_multipliers(); }
bool BeamSystem::has_constant_inertia() const { return system_->has_constant_inertia(); }

}  // namespace nurbeam
