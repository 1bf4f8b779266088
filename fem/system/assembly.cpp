// Long because it is the one walk over elements, forces and constraints, for each of what a system is asked.
#include "fem/system/assembly.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "fem/comparison/virtual_work.h"
#include "fem/element/element_batch.h"
#include "fem/mesh/drawn_coordinates.h"

namespace nurbeam {

namespace {

int value_index(const Eigen::SparseMatrix<double>& A, int row, int column) {
  const int* begin = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const int* end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, row) - A.innerIndexPtr());
}

template <class Matrix>
void scatter(const std::vector<int>& positions, std::size_t n, const Matrix& matrix, double* values) {
  for (std::size_t j = 0, k = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i, ++k)
      if (positions[k] >= 0)
        values[positions[k]] += matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

// The coordinates of a bound force in its own block, where it has one.
template <class Force>
std::vector<int> own_dofs(const Force& force) {
  if constexpr (requires { force.dofs(); })
    return force.dofs();
  else
    return {};
}

template <class Constraint>
constexpr bool is_linear() {
  return requires { requires Constraint::linear; };
}

void add_twist_force(const MeshElement<3>& e, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) {
  const TwistLayout::Coordinates f = e.twist->element.force(gather_twist(e, state));
  for (int k = 0; k < TwistLayout::size; ++k)
    if (e.twist->dofs[k] >= 0) dynamics[e.twist->dofs[k]] += f[k];
}

}  // namespace

// The elements of one beam: those whose forces are found side by side, with their indices in the order of the
// batches, and the indices of the others.
template <int D>
struct Assembly<D>::Walk {
  std::vector<ElementBatch<D>> batches;
  std::vector<int> batched, others;
};

// Takes the tangent matrices of one force.
template <int D>
struct Assembly<D>::Sink {
  const std::vector<Block>&element_blocks, &twist_blocks;
  const Block& own_block;
  double* values;

  void element(int index, const ElementMatrix<D>& K) const {
    scatter(element_blocks[index].values, element_size<D>, K, values);
  }
  /// In the coordinates of an element with its sections.
  void twist(int index, const TwistLayout::Matrix& K) const {
    scatter(twist_blocks[index].values, TwistLayout::size, K, values);
  }
  template <class Matrix>
  void own(const Matrix& K) const {
    scatter(own_block.values, own_block.dofs.size(), K, values);
  }
};

template <int D>
Assembly<D>::Assembly(std::shared_ptr<const BeamModel> model, MeshPlan plan, const std::vector<bool>& held)
    : model_(std::move(model)),
      mesh_(make_mesh(*model_, std::move(plan))),
      elements_(make_elements<D>(*model_, mesh_)) {
  batch_elements();
  bind_constraints(held);
  bind_forces();
  build_pattern();
  choose_moving_part();
}

template <int D>
Assembly<D>::~Assembly() = default;

template <int D>
void Assembly<D>::batch_elements() {
  walks_.resize(model_->beams.size());
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) {
    const MeshElement<D>& e = elements_[i];
    auto& [batches, batched, others] = walks_[e.beam];
    if (e.twist || !ElementBatch<D>::takes(e.element)) {
      others.push_back(i);
      continue;
    }
    if (batches.empty() || batches.back().is_full()) batches.emplace_back(e.element.properties());
    batches.back().add(e.element, e.dofs, e.slope_offset);
    batched.push_back(i);
  }
}

template <int D>
void Assembly<D>::bind_constraints(const std::vector<bool>& held) {
  const MeshedBeams<D> at = beams();
  const Eigen::VectorXd drawn = drawn_coordinates(*model_, mesh_);
  const auto add = [&](auto&& constraint) {
    const int rows = constraint.rows;
    constraint_blocks_.push_back({constraint_count_, rows, {constraint.dofs(), {}}, {}, {}});
    constraint_count_ += rows;
    constraints_.emplace_back(std::move(constraint));
  };
  for (const Constraint& constraint : model_->constraints) {
    const int first = constraint_count_;
    std::visit([&](const auto& description) { bind<D>(description, at, drawn, add); }, constraint);
    constraint_rows_.push_back({first, constraint_count_ - first});
  }
  place_rows_.resize(model_->joints.size());
  first_joint_constraint_ = static_cast<int>(constraints_.size());
  for (int j = 0; j < static_cast<int>(model_->joints.size()); ++j) {
    const bool is_held = j < static_cast<int>(held.size()) && held[j];
    body_rows_.push_back(constraint_count_);
    bind_joint<D>(j, is_held, at, drawn, [&](auto&& constraint) {
      if constexpr (std::is_same_v<std::decay_t<decltype(constraint)>, HeldPlace<D>>)
        place_rows_[j] = {constraint_count_, constraint.rows};
      add(std::move(constraint));
    });
  }
  last_joint_constraint_ = static_cast<int>(constraints_.size());
  for (int i = 0; i < static_cast<int>(model_->stops.size()); ++i) {
    const bool rests = mesh_.plan.is_closed(i) && is_in_place(mesh_, model_->stops[i]);
    contact_rows_.push_back(rests ? constraint_count_ : -1);
    if (rests) add(KeptContact<D>(at, model_->stops[i]));
  }
  bind_corners<D>(at, add);
  rod_rows_.resize(model_->connectors.size());
  for (std::size_t i = 0; i < model_->connectors.size(); ++i) {
    if (model_->connectors[i].type != ConnectorType::rod) continue;
    rod_rows_[i] = {constraint_count_, 1};
    add(KeptLength<D>(model_->connectors[i], at));
  }
}

template <int D>
void Assembly<D>::bind_forces() {
  const MeshedBeams<D> at = beams();
  const Eigen::VectorXd drawn = drawn_coordinates(*model_, mesh_);
  for (int body = 0; body < static_cast<int>(model_->bodies.size()); ++body) {
    forces_.emplace_back(PointMass<D>(at, body));
    if (model_->air.density * model_->bodies[body].drag_area > 0) forces_.emplace_back(BodyDrag<D>(at, body));
  }
  for (int j = 0; j < static_cast<int>(model_->joints.size()); ++j) {
    bind_roll(j, drawn);
    bind_friction(j, drawn);
  }
  for (int i = 0; i < static_cast<int>(model_->stops.size()); ++i)
    if (model_->stops[i].buffer && is_in_place(mesh_, model_->stops[i]))
      forces_.emplace_back(BufferForce<D>(at, i));
  for (int i = 0; i < static_cast<int>(model_->connectors.size()); ++i)
    if (model_->connectors[i].type != ConnectorType::rod) forces_.emplace_back(Spring<D>(i, at));
  for (const Force& force : model_->forces)
    forces_.push_back(std::visit(
        [&](const auto& description) -> BoundForce<D> { return bind_force<D>(description, at, drawn); },
        force));
}

// Of a body that is on its beam and not held there.
template <int D>
void Assembly<D>::bind_friction(int j, const Eigen::VectorXd& drawn) {
  const JointMode mode = mesh_.plan.modes[j];
  const bool slides = mode == JointMode::node || mode == JointMode::point;
  if (model_->joints[j].friction && slides && !mesh_.plan.holds(j))
    forces_.emplace_back(SlidingFriction<D>(beams(), drawn, j, body_rows_[j]));
}

// The inertia of the roll of a joint's body with its section.
template <int D>
void Assembly<D>::bind_roll(int j, const Eigen::VectorXd& drawn) {
  if constexpr (D == 3) {
    const SlidingJoint& joint = model_->joints[j];
    const double inertia = model_->body_of(joint).roll_inertia;
    if (!joint.follows_section || inertia == 0) return;
    if (mesh_.plan.modes[j] == JointMode::free)
      forces_.emplace_back(FreeRoll(inertia, mesh_.plan.spin(j)));
    else if (mesh_.plan.modes[j] == JointMode::node)
      forces_.emplace_back(RollInertia<FollowedNode>(beams(), drawn, j));
    else
      forces_.emplace_back(RollInertia<FollowedPoint>(beams(), drawn, j));
  }
}

template <int D>
void Assembly<D>::build_pattern() {
  const int n = mesh_.coordinate_count, size = n + constraint_count_;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_pairs = [&](const std::vector<int>& dofs) {
    for (int i : dofs)
      for (int j : dofs)
        if (i >= 0 && j >= 0) entries.emplace_back(i, j, 0.0);
  };
  for (const MeshElement<D>& e : elements_) {
    element_blocks_.push_back({{e.dofs.begin(), e.dofs.end()}, {}});
    add_pairs(element_blocks_.back().dofs);
    twist_blocks_.emplace_back();
    if (e.twist) twist_blocks_.back().dofs.assign(e.twist->dofs.begin(), e.twist->dofs.end());
    add_pairs(twist_blocks_.back().dofs);
  }
  for (const BoundForce<D>& force : forces_) {
    force_blocks_.push_back({std::visit([](const auto& f) { return own_dofs(f); }, force), {}});
    add_pairs(force_blocks_.back().dofs);
  }
  for (const auto& [row, rows, block, gradient_values, transposed_values] : constraint_blocks_) {
    add_pairs(block.dofs);
    for (int r = row; r < row + rows; ++r)
      for (int dof : block.dofs) {
        if (dof < 0) continue;
        entries.emplace_back(n + r, dof, 0.0);
        entries.emplace_back(dof, n + r, 0.0);
      }
  }
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 0.0);
  pattern_.resize(size, size);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();

  const auto index_of = [&](int i, int j) { return value_index(pattern_, i, j); };
  for (Block& block : element_blocks_) locate(block, index_of);
  for (Block& block : twist_blocks_) locate(block, index_of);
  for (Block& block : force_blocks_) locate(block, index_of);
  for (ConstraintBlock& block : constraint_blocks_) locate(block, index_of);
}

// Puts down where the values of a block are; `index_of` gives that of a row and a column.
template <int D>
template <class IndexOf>
void Assembly<D>::locate(Block& block, const IndexOf& index_of) const {
  block.values.clear();
  for (int j : block.dofs)
    for (int i : block.dofs) block.values.push_back(i >= 0 && j >= 0 ? index_of(i, j) : -1);
}

template <int D>
template <class IndexOf>
void Assembly<D>::locate(ConstraintBlock& block, const IndexOf& index_of) const {
  const int n = mesh_.coordinate_count;
  locate(block.block, index_of);
  block.gradient_values.clear();
  block.transposed_values.clear();
  for (int dof : block.block.dofs)
    for (int r = block.row; r < block.row + block.rows; ++r) {
      block.gradient_values.push_back(dof >= 0 ? index_of(n + r, dof) : -1);
      block.transposed_values.push_back(dof >= 0 ? index_of(dof, n + r) : -1);
    }
}

template <int D>
void Assembly<D>::choose_moving_part() {
  constexpr int smallest_share = 4;  // of all unknowns, for which a part is kept apart
  const auto add_unknowns = [&](const std::vector<int>& dofs) {
    for (const int dof : dofs)
      if (dof >= 0) moving_.unknowns.push_back(dof);
  };
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) {
    if (elements_[i].element.fixed()) continue;
    moving_.elements.push_back(i);
    moving_.element_blocks.push_back(element_blocks_[i]);
    moving_.twist_blocks.push_back(twist_blocks_[i]);
    add_unknowns(element_blocks_[i].dofs);
    add_unknowns(twist_blocks_[i].dofs);
  }
  for (int i = first_joint_constraint_; i < last_joint_constraint_; ++i) {
    if (std::visit([](const auto& c) { return is_linear<std::decay_t<decltype(c)>>(); }, constraints_[i]))
      continue;
    const ConstraintBlock& block = constraint_blocks_[i];
    moving_.constraints.push_back(i);
    moving_.constraint_blocks.push_back(block);
    add_unknowns(block.block.dofs);
    for (int r = block.row; r < block.row + block.rows; ++r)
      moving_.unknowns.push_back(mesh_.coordinate_count + r);
  }
  std::vector<int>& unknowns = moving_.unknowns;
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  if (smallest_share * static_cast<int>(unknowns.size()) > mesh_.coordinate_count + constraint_count_) {
    moving_ = {};
    return;
  }
  const auto place_of = [&](int unknown) {
    return static_cast<int>(std::lower_bound(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin());
  };
  const auto index_of = [&](int i, int j) {
    return place_of(i) + place_of(j) * static_cast<int>(unknowns.size());
  };
  for (Block& block : moving_.element_blocks) locate(block, index_of);
  for (Block& block : moving_.twist_blocks) locate(block, index_of);
  for (ConstraintBlock& block : moving_.constraint_blocks) locate(block, index_of);
}

template <int D>
typename Assembly<D>::Vector Assembly<D>::line_load(int beam, const State& state) const {
  const Vector gravity = state.load * model_->gravity.head<D>();
  Vector load = model_->beams[beam].properties.mass_per_length * gravity;
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.per_length(beam, state.t); })
            load += state.load * f.per_length(beam, state.t).template head<D>();
        },
        force);
  return load;
}

template <int D>
ElementVector<D> Assembly<D>::element_force(const MeshElement<D>& e, const State& state,
                                            const Vector& load) const {
  const ElementState<D> x = gather<D>(e, state);
  return is_form_p(e) ? virtual_work::force<D>(e.element, x, load) : e.element.force(x, load);
}

template <int D>
std::vector<ElementVector<D>> Assembly<D>::element_forces(const State& state) const {
  std::vector<ElementVector<D>> forces;
  for (int b = 0; b < static_cast<int>(model_->beams.size()); ++b) {
    const Vector load = line_load(b, state);
    for (int i = mesh_.first_span[b]; i < mesh_.first_span[b + 1]; ++i)
      forces.push_back(element_force(elements_[i], state, load));
  }
  return forces;
}

template <int D>
std::vector<PointAction> Assembly<D>::actions(const State& state) const {
  const MeshedBeams<D> at = beams();
  std::vector<PointAction> actions;
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.template add_actions<D>(at, state, actions); })
            f.template add_actions<D>(at, state, actions);
          else if constexpr (requires { f.add_actions(at, state, actions); })
            f.add_actions(at, state, actions);
        },
        force);
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit(
        [&](const auto& c) {
          const auto y = [&] { return state.lambda.segment<D>(constraint_blocks_[i].row); };
          if constexpr (requires { c.action(at, state, y()); }) actions.push_back(c.action(at, state, y()));
        },
        constraints_[i]);
  return actions;
}

template <int D>
std::pair<Eigen::Vector3d, Eigen::Vector3d> Assembly<D>::reaction(int i, const State& state,
                                                                  const Eigen::VectorXd& multipliers) const {
  const MeshedBeams<D> at = beams();
  const Rows rows = constraint_rows_[i];
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = force;
  for (std::size_t c = 0; c < constraints_.size(); ++c) {
    const int row = constraint_blocks_[c].row;
    if (row < rows.first || row >= rows.first + rows.count) continue;
    std::visit(
        [&](const auto& constraint) {
          const auto y = multipliers.segment(row, constraint.rows);
          if constexpr (requires { constraint.couple(at, state, y); })
            couple += constraint.couple(at, state, y);
          else if constexpr (requires { constraint.force(y); })
            force += constraint.force(y);
          else
            force.head(constraint.rows) -= y;
        },
        constraints_[c]);
  }
  return {force, couple};
}

template <int D>
typename Assembly<D>::Vector Assembly<D>::pull_on_body(int body, const State& state) const {
  Vector sum = Vector::Zero();
  for (const BoundForce<D>& force : forces_)
    if (const auto* spring = std::get_if<Spring<D>>(&force)) sum += spring->on_body(beams(), body, state);
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (const auto* rod = std::get_if<KeptLength<D>>(&constraints_[i]))
      sum += rod->on_body(body, state.lambda[constraint_blocks_[i].row], state);
  return sum;
}

template <int D>
std::pair<double, double> Assembly<D>::length_and_force(int i, const State& state) const {
  for (const BoundForce<D>& force : forces_)
    if (const auto* spring = std::get_if<Spring<D>>(&force); spring && spring->connector() == i)
      return spring->length_and_force(beams(), state);
  for (const BoundConstraint<D>& constraint : constraints_)
    if (const auto* rod = std::get_if<KeptLength<D>>(&constraint);
        rod && &rod->connector() == &model_->connectors[i])
      return {rod->length(state), state.lambda[rod_rows_[i].first]};
  return {};
}

template <int D>
void Assembly<D>::carry_bodies(State& state) const {
  const MeshedBeams<D> at = beams();
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit(
        [&](const auto& c) {
          if constexpr (requires { c.body(); }) {
            const ConstraintTerms<D> terms = c.terms(at, state, nullptr);
            Vector rate = Vector::Zero();
            for (std::size_t k = 0; k < c.dofs().size(); ++k)
              if (c.dofs()[k] >= 0) rate += terms.gradient.col(static_cast<long>(k)) * state.v[c.dofs()[k]];
            state.q.segment<D>(c.body()) += terms.value;
            state.v.segment<D>(c.body()) += rate;
          }
        },
        constraints_[i]);
}

template <int D>
void Assembly<D>::residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                           Eigen::Ref<Eigen::VectorXd> constraints) const {
  const MeshedBeams<D> at = beams();
  dynamics.setZero();
  for (int b = 0; b < static_cast<int>(model_->beams.size()); ++b) {
    const Vector load = line_load(b, state);
    for (const ElementBatch<D>& batch : walks_[b].batches)
      batch.add_forces(state, load, free_strain(elements_[mesh_.first_span[b]], state), dynamics.data());
    for (const int i : walks_[b].others) {
      const MeshElement<D>& e = elements_[i];
      const ElementVector<D> f = element_force(e, state, load);
      for (int k = 0; k < element_size<D>; ++k)
        if (e.dofs[k] >= 0) dynamics[e.dofs[k]] += f[k];
      if constexpr (D == 3)
        if (e.twist) add_twist_force(e, state, dynamics);
    }
  }
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.template add_force<D>(at, state, dynamics); })
            f.template add_force<D>(at, state, dynamics);
          else if constexpr (requires { f.add_force(at, state, dynamics); })
            f.add_force(at, state, dynamics);
        },
        force);
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const ConstraintBlock& block = constraint_blocks_[i];
    const ConstraintTerms<D> terms =
        std::visit([&](const auto& c) { return c.terms(at, state, nullptr); }, constraints_[i]);
    const auto rows = terms.value.size();
    constraints.segment(block.row, rows) = terms.value;
    for (std::size_t k = 0; k < block.block.dofs.size(); ++k)
      if (block.block.dofs[k] >= 0)
        dynamics[block.block.dofs[k]] +=
            terms.gradient.col(static_cast<Eigen::Index>(k)).dot(state.lambda.segment(block.row, rows));
  }
}

template <int D>
void Assembly<D>::add_element_tangent(int i, const State& state, const Vector& load, const TangentWeights& w,
                                      const Block& block, const Block& twist_block, double* values) const {
  const MeshElement<D>& e = elements_[i];
  const ElementState<D> x = gather<D>(e, state);
  scatter(block.values, element_size<D>,
          is_form_p(e) ? virtual_work::tangent<D>(e.element, x, load, w) : e.element.tangent(x, load, w),
          values);
  if constexpr (D == 3)
    if (e.twist)
      scatter(twist_block.values, TwistLayout::size, e.twist->element.tangent(gather_twist(e, state), w),
              values);
}

// Of all batches of a beam.
template <int D>
void Assembly<D>::add_batch_tangents(int beam, const State& state, const TangentWeights& w,
                                     double* values) const {
  constexpr int nodal = ElementLayout<D>::nodal;
  const auto& [batches, batched, others] = walks_[beam];
  if (batches.empty()) return;  // a guide has no elements
  const double strain = free_strain(elements_[mesh_.first_span[beam]], state);
  auto index = batched.begin();
  typename ElementBatch<D>::Tangents K;
  for (const ElementBatch<D>& batch : batches) {
    batch.tangents(state, strain, w, K);
    for (int lane = 0; lane < batch.count(); ++lane, ++index) {
      const int* position = element_blocks_[*index].values.data();
      for (int j = 0; j < nodal; ++j)
        for (int i = 0; i < nodal; ++i) values[position[j * element_size<D> + i]] += K[j][i].of[lane];
    }
  }
}

template <int D>
void Assembly<D>::add_constraint_tangent(int i, const State& state, const TangentWeights& w,
                                         const ConstraintBlock& block, double* values) const {
  const MeshedBeams<D> at = beams();
  std::visit(
      [&](const auto& c) {
        typename ConstraintTerms<D>::Multipliers y = ConstraintTerms<D>::Multipliers::Zero();
        y.head(c.rows) = state.lambda.segment(block.row, c.rows);
        const ConstraintTerms<D> terms = c.terms(at, state, &y);
        if constexpr (!is_linear<std::decay_t<decltype(c)>>())
          if (w.stiffness != 0)
            scatter(block.block.values, block.block.dofs.size(), w.stiffness * terms.hessian, values);
        for (std::size_t k = 0, v = 0; k < block.block.dofs.size(); ++k)
          for (int r = 0; r < c.rows; ++r, ++v)
            if (block.gradient_values[v] >= 0) {
              const double g = terms.gradient(r, static_cast<Eigen::Index>(k));
              values[block.gradient_values[v]] += g;
              values[block.transposed_values[v]] += g;
            }
      },
      constraints_[i]);
}

template <int D>
void Assembly<D>::tangent(const State& state, const TangentWeights& w,
                          Eigen::SparseMatrix<double>& kkt) const {
  const MeshedBeams<D> at = beams();
  double* values = kkt.valuePtr();
  std::fill(values, values + kkt.nonZeros(), 0.0);
  const bool constraints_only = w.mass == 0 && w.damping == 0 && w.stiffness == 0;
  for (int b = 0; b < static_cast<int>(model_->beams.size()) && !constraints_only; ++b) {
    const Vector load = line_load(b, state);
    const auto add_one = [&](int i) {
      add_element_tangent(i, state, load, w, element_blocks_[i], twist_blocks_[i], values);
    };
    if (model_->beams[b].properties.is_damped())
      std::for_each(walks_[b].batched.begin(), walks_[b].batched.end(), add_one);
    else
      add_batch_tangents(b, state, w, values);
    std::for_each(walks_[b].others.begin(), walks_[b].others.end(), add_one);
  }
  for (std::size_t i = 0; i < forces_.size() && !constraints_only; ++i) {
    const Sink sink{element_blocks_, twist_blocks_, force_blocks_[i], values};
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.template add_tangent<D>(at, state, w, sink); })
            f.template add_tangent<D>(at, state, w, sink);
          else if constexpr (requires { f.add_tangent(at, state, w, sink); })
            f.add_tangent(at, state, w, sink);
        },
        forces_[i]);
  }
  for (int i = 0; i < static_cast<int>(constraints_.size()); ++i)
    add_constraint_tangent(i, state, w, constraint_blocks_[i], values);
}

template <int D>
void Assembly<D>::moving_tangent(const State& state, const TangentWeights& w, Eigen::MatrixXd& part) const {
  const auto size = static_cast<Eigen::Index>(moving_.unknowns.size());
  part.setZero(size, size);
  for (std::size_t k = 0; k < moving_.elements.size(); ++k)
    add_element_tangent(moving_.elements[k], state, line_load(elements_[moving_.elements[k]].beam, state), w,
                        moving_.element_blocks[k], moving_.twist_blocks[k], part.data());
  for (std::size_t k = 0; k < moving_.constraints.size(); ++k)
    add_constraint_tangent(moving_.constraints[k], state, w, moving_.constraint_blocks[k], part.data());
}

template <int D>
Eigen::VectorXd Assembly<D>::constraint_rate(const State& state) const {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(constraint_count_);
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit(
        [&](const auto& c) {
          if constexpr (requires { c.rate(state.t); })
            rate.segment(constraint_blocks_[i].row, c.rows) = c.rate(state.t);
        },
        constraints_[i]);
  return rate;
}

template <int D>
Eigen::VectorXd Assembly<D>::constraint_curvature(const State& state) const {
  const MeshedBeams<D> at = beams();
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(constraint_count_);
  const auto add = [&](const ConstraintBlock& block, const auto& c) {
    if constexpr (!is_linear<std::decay_t<decltype(c)>>()) {
      Eigen::Matrix<double, ConstraintTerms<D>::size, 1> v =
          Eigen::Matrix<double, ConstraintTerms<D>::size, 1>::Zero();
      for (std::size_t k = 0; k < block.block.dofs.size(); ++k)
        if (block.block.dofs[k] >= 0) v[static_cast<Eigen::Index>(k)] = state.v[block.block.dofs[k]];
      for (int r = 0; r < c.rows; ++r) {
        const typename ConstraintTerms<D>::Multipliers unit = ConstraintTerms<D>::Multipliers::Unit(r);
        curvature[block.row + r] = v.dot(c.terms(at, state, &unit).hessian * v);
      }
    }
    if constexpr (requires { c.acceleration(state.t); })
      curvature.segment(block.row, c.rows) += c.acceleration(state.t);
  };
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit([&](const auto& c) { add(constraint_blocks_[i], c); }, constraints_[i]);
  return curvature;
}

template <int D>
double Assembly<D>::step_limit(const State& state) const {
  constexpr double largest_slide = 0.2;  // of the shorter neighbour
  double limit = std::numeric_limits<double>::infinity();
  const auto speed = [&](int place) { return place >= 0 ? std::abs(state.v[place]) : 0; };
  for (const MeshSpan& span : mesh_.spans) {
    const double closing = std::max(speed(span.place_a), speed(span.place_b));
    if (closing > 0)
      limit = std::min(limit, largest_slide * (span.end(state.q) - span.start(state.q)) / closing);
  }
  return limit;
}

template <int D>
bool Assembly<D>::admissible(const State& state) const {
  constexpr double shortest = 1e-3;  // of the element's length when the mesh was made
  if constexpr (D == 3)
    for (const MeshElement<D>& e : elements_)
      if (e.twist && !e.twist->element.admissible(gather_twist(e, state.q))) return false;
  return std::all_of(mesh_.spans.begin(), mesh_.spans.end(), [&](const MeshSpan& span) {
    return span.end(state.q) - span.start(state.q) > shortest * (span.s_b - span.s_a);
  });
}

template <int D>
Eigen::VectorXd Assembly<D>::coordinate_scale() const {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(mesh_.coordinate_count);
  double longest = 0;
  for (const Beam& beam : model_->beams) longest = std::max(longest, beam.curve.length());
  for (const int r : mesh_.bodies) scale.segment<D>(r).setConstant(longest > 0 ? longest : 1);
  for (std::size_t b = 0; b < mesh_.nodes.size(); ++b) {
    const double length = model_->beams[b].curve.length();
    for (const MeshNode& node : mesh_.nodes[b]) {
      scale.segment<D>(node.r).setConstant(length);
      if (node.place >= 0) scale[node.place] = length;
    }
  }
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j) {
    const double length = model_->beam_of(model_->joints[j]).curve.length();
    scale.segment<D>(mesh_.bodies[model_->joints[j].body]).setConstant(length);
    if (mesh_.joints[j].place >= 0) scale[mesh_.joints[j].place] = length;
  }
  return scale;
}

template <int D>
Eigen::VectorXd Assembly<D>::committed(const State& state) const {
  const MeshedBeams<D> at = beams();
  Eigen::VectorXd memory = state.memory;
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.commit(at, state, memory); }) f.commit(at, state, memory);
        },
        force);
  return memory;
}

template <int D>
bool Assembly<D>::forces_depend_on_multipliers() const {
  return std::any_of(
      forces_.begin(), forces_.end(),
      [](const BoundForce<D>& force) { return std::holds_alternative<SlidingFriction<D>>(force); });
}

template class Assembly<2>;
template class Assembly<3>;

}  // namespace nurbeam
