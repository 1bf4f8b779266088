// Long because it is the one walk over elements, forces and constraints, for every question to a system.
#include "fem/system/assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fem/comparison/virtual_work.h"
#include "fem/mesh/drawn_coordinates.h"

namespace nurbeam {

namespace {

void add_twist_force(const MeshElement<3>& e, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) {
  const TwistLayout::Coordinates f = e.twist->element.force(gather_twist(e, state));
  for (int k = 0; k < TwistLayout::size; ++k)
    if (e.twist->dofs[k] >= 0) dynamics[e.twist->dofs[k]] += f[k];
}

template <int D>
std::optional<MeshedBeams<D>> elements_of(const Assembly<D>* assembly) {
  if (!assembly) return {};
  return assembly->beams();
}

}  // namespace

template <int D>
Assembly<D>::Assembly(std::shared_ptr<const BeamModel> model, MeshPlan plan, const std::vector<bool>& held,
                      const Assembly* like, const Assembly* neighbour)
    : model_(std::move(model)),
      mesh_(make_mesh(*model_, std::move(plan))),
      held_(held),
      elements_(make_elements<D>(*model_, mesh_, elements_of(like))) {
  for (int i = 0; i < static_cast<int>(mesh_.spans.size()); ++i)
    if (mesh_.spans[i].place_a >= 0 || mesh_.spans[i].place_b >= 0) moving_spans_.push_back(i);
  const Eigen::VectorXd drawn = planned_places(mesh_);
  batch_elements();
  Binding<D> binding{beams(), drawn, held};
  bind_constraints(binding);
  bind_forces(binding);
  find_parts();
  list_blocks();
  for (const Assembly* other : {neighbour, like})
    if (other && couples_as(*other)) {
      take_pattern(*other);
      return;
    }
  if (!like || !shift_pattern(*like)) build_pattern();
  choose_moving_part();
}

template <int D>
void Assembly<D>::batch_elements() {
  walks_.resize(model_->beams.size());
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) {
    const MeshElement<D>& e = elements_[i];
    auto& [batches, batched, others, reaches] = walks_[e.span->beam];
    const bool in_batch = !e.twist && ElementBatch<D>::takes(e.element) &&
                          &e.element.properties() == &model_->beams[e.span->beam].properties;
    (in_batch ? batched : others).push_back(i);
  }
  constexpr int lanes = ElementBatch<D>::lanes;
  for (int b = 0; b < static_cast<int>(walks_.size()); ++b) {
    auto& [batches, batched, others, reaches] = walks_[b];
    const int count = static_cast<int>(batched.size());
    batches.reserve(static_cast<std::size_t>((count + lanes - 1) / lanes));
    reaches.reserve(batches.capacity());
    for (int first = 0; first < count; first += lanes) {
      batches.emplace_back(model_->beams[b].properties);
      auto& [lowest, highest] = reaches.emplace_back(std::array{mesh_.coordinate_count, -1});
      for (int i = first; i < std::min(first + lanes, count); ++i) {
        const MeshElement<D>& e = elements_[batched[i]];
        batches.back().add(e.element, e.dofs, e.slope_offset, e.index);
        for (int k = 0; k < ElementLayout<D>::nodal; ++k) {
          lowest = std::min(lowest, e.dofs[k]);
          highest = std::max(highest, e.dofs[k]);
        }
      }
    }
  }
}

template <int D>
void Assembly<D>::bind_constraints(Binding<D>& binding) {
  const auto add = [&](auto&& constraint) {
    const int rows = constraint.rows;
    constraint_blocks_.push_back({binding.rows, rows, {constraint.dofs(), {}}, {}, {}});
    binding.rows += rows;
    constraints_.emplace_back(std::move(constraint));
  };
  for (const Constraint& constraint : model_->constraints) {
    const int first = binding.rows;
    std::visit([&](const auto& description) { bind<D>(description, binding.at, binding.drawn, add); },
               constraint);
    constraint_rows_.push_back({first, binding.rows - first});
  }
  ConstraintSources<D>::for_each([&]<class Source>() {
    const int first = static_cast<int>(constraints_.size());
    Source::bind(binding, add);
    if constexpr (requires { Source::moves; })
      for (int i = first; i < static_cast<int>(constraints_.size()); ++i) over_mesh_.push_back(i);
  });
  constraint_count_ = binding.rows;
  for (int i = 0; i < static_cast<int>(constraints_.size()); ++i)
    if (!std::visit(
            [](const auto& c) {
              constexpr ConstraintOffers offers = offers_of<decltype(c)>;
              if constexpr (offers.constant) return c.is_constant();
              return offers.linear;
            },
            constraints_[i]))
      turning_.push_back(i);
}

template <int D>
void Assembly<D>::bind_forces(const Binding<D>& binding) {
  const auto add = [&](auto&& force) { forces_.emplace_back(std::move(force)); };
  ForceSources<D>::for_each([&]<class Source>() { Source::bind(binding, add); });
  for (const Force& force : model_->forces)
    forces_.push_back(
        std::visit([&](const auto& description) { return bind_force<D>(description, binding); }, force));
}

template <int D>
void Assembly<D>::find_parts() {
  parts_.friction.assign(model_->riders.size(), -1);
  parts_.held_places = parts_.friction;
  parts_.springs.assign(model_->connectors.size(), -1);
  parts_.rods = parts_.springs;
  parts_.contacts.assign(model_->stops.size(), -1);
  for (int i = 0; i < static_cast<int>(forces_.size()); ++i)
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.friction) parts_.friction[f.rider()] = i;
          if constexpr (offers_of<decltype(f)>.connector) parts_.springs[f.connector()] = i;
        },
        forces_[i]);
  for (int i = 0; i < static_cast<int>(constraints_.size()); ++i)
    std::visit(
        [&](const auto& c) {
          if constexpr (offers_of<decltype(c)>.connector) parts_.rods[c.connector()] = i;
          if constexpr (offers_of<decltype(c)>.stop) parts_.contacts[c.closed_stop()] = i;
          if constexpr (offers_of<decltype(c)>.place)
            for (std::size_t j = 0; j < mesh_.riders.size(); ++j)
              if (mesh_.riders[j].place == c.place()) parts_.held_places[j] = i;
        },
        constraints_[i]);
}

template <int D>
typename Assembly<D>::Vector Assembly<D>::line_load(int beam, const State& state) const {
  const Vector gravity = state.load * model_->gravity.head<D>();
  Vector load = model_->beams[beam].properties.mass_per_length * gravity;
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.per_length)
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
ElementEnergy Assembly<D>::axis_energy(const State& state, const std::vector<bool>* of) const {
  ElementEnergy sum;
  const auto counts = [&](int i) { return !of || (*of)[static_cast<std::size_t>(i)]; };
  for (int b = 0; b < static_cast<int>(model_->beams.size()); ++b) {
    const auto& [batches, batched, others, reaches] = walks_[b];
    const Vector weight = model_->beams[b].properties.mass_per_length * model_->gravity.head<D>();
    for (auto begin = batched.begin(); const ElementBatch<D>& batch : batches) {
      const auto end = begin + batch.count();
      if (std::any_of(begin, end, counts)) {
        const auto energies = batch.energies(state, weight, free_strain_of(b, state));
        for (auto i = begin; i < end; ++i)
          if (counts(*i)) sum += energies[static_cast<std::size_t>(i - begin)];
      }
      begin = end;
    }
    for (const int i : others)
      if (counts(i)) sum += elements_[i].element.energy(gather<D>(elements_[i], state), weight);
  }
  return sum;
}

template <int D>
double Assembly<D>::length(int beam, const State& state) const {
  const Beam& of = model_->beams[beam];
  double sum = of.rigid ? of.curve.length() : 0;
  for (const ElementBatch<D>& batch : walks_[beam].batches) {
    const auto lengths = batch.lengths(state);
    sum = std::accumulate(lengths.begin(), lengths.begin() + batch.count(), sum);
  }
  for (const int i : walks_[beam].others)
    sum += elements_[i].element.length(gather<D>(elements_[i], state.q));
  return sum;
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
          else if constexpr (offers_of<decltype(f)>.actions)
            f.add_actions(at, state, actions);
        },
        force);
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit(
        [&](const auto& c) {
          const auto y = [&] { return state.lambda.segment<D>(constraint_blocks_[i].row); };
          if constexpr (offers_of<decltype(c)>.action)
            if (const std::optional<PointAction> action = c.action(at, state, y()))
              actions.push_back(*action);
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
          if constexpr (offers_of<decltype(constraint)>.couple)
            couple += constraint.couple(at, state, y);
          else if constexpr (requires { constraint.force(state, y); })
            force += constraint.force(state, y);
          else if constexpr (offers_of<decltype(constraint)>.force)
            force += constraint.force(y);
          else
            force.head(constraint.rows) -= y;
        },
        constraints_[c]);
  }
  return {force, couple};
}

template <int D>
double Assembly<D>::drive_moment(int i, const State& state) const {
  const MeshedBeams<D> at = beams();
  const Rows rows = constraint_rows_[i];
  double moment = 0;
  for (std::size_t c = 0; c < constraints_.size(); ++c) {
    const int row = constraint_blocks_[c].row;
    if (row < rows.first || row >= rows.first + rows.count) continue;
    std::visit(
        [&](const auto& constraint) {
          if constexpr (offers_of<decltype(constraint)>.drive)
            moment += constraint.drive(at, state, state.lambda.segment(row, constraint.rows));
        },
        constraints_[c]);
  }
  return moment;
}

template <int D>
typename Assembly<D>::Vector Assembly<D>::force_on_body(int body, const State& state) const {
  const MeshedBeams<D> at = beams();
  Vector sum = Vector::Zero();
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.on_body) sum += f.on_body(at, body, state);
        },
        force);
  for_each_constraint([&](const auto& c, const Rows& rows) {
    const auto y = [&] { return state.lambda.segment(rows.first, rows.count); };
    if constexpr (offers_of<decltype(c)>.on_body) sum += c.on_body(body, state, y());
  });
  return sum;
}

template <int D>
void Assembly<D>::carry_bodies(State& state) const {
  const MeshedBeams<D> at = beams();
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit(
        [&](const auto& c) {
          if constexpr (offers_of<decltype(c)>.body) {
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
int Assembly<D>::part_count(int beam) const {
  return static_cast<int>(walks_[beam].batches.size() + walks_[beam].others.size());
}

// Adds the forces of one part of a beam: the batches come first, then the other elements.
template <int D>
void Assembly<D>::add_part(int beam, int part, const State& state, const Vector& load,
                           Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const auto& [batches, batched, others, reaches] = walks_[beam];
  const int batch_count = static_cast<int>(batches.size());
  if (part < batch_count)
    return batches[part].add_forces(state, load, free_strain_of(beam, state), dynamics.data());
  add_element(elements_[others[part - batch_count]], state, load, dynamics);
}

template <int D>
void Assembly<D>::add_element(const MeshElement<D>& e, const State& state, const Vector& load,
                              Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const ElementVector<D> f = element_force(e, state, load);
  for (int k = 0; k < element_size<D>; ++k)
    if (e.dofs[k] >= 0) dynamics[e.dofs[k]] += f[k];
  if constexpr (D == 3)
    if (e.twist) add_twist_force(e, state, dynamics);
}

template <int D>
void Assembly<D>::add_forces_and_constraints(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                                             Eigen::Ref<Eigen::VectorXd> constraints) const {
  const MeshedBeams<D> at = beams();
  for (const BoundForce<D>& force : forces_)
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.template add_force<D>(at, state, dynamics); })
            f.template add_force<D>(at, state, dynamics);
          else if constexpr (offers_of<decltype(f)>.force)
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
void Assembly<D>::constraints(const State& state, Eigen::Ref<Eigen::VectorXd> constraints) const {
  const MeshedBeams<D> at = beams();
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit(
        [&](const auto& c) {
          constraints.segment(constraint_blocks_[i].row, c.rows) = c.terms(at, state, nullptr).value;
        },
        constraints_[i]);
}

template <int D>
void Assembly<D>::residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                           Eigen::Ref<Eigen::VectorXd> constraints) const {
  dynamics.setZero();
  for (int b = 0; b < static_cast<int>(model_->beams.size()); ++b) {
    const Vector load = line_load(b, state);
    const int batch_count = static_cast<int>(walks_[b].batches.size());
    for_each_batch(walks_[b], [&](int part) { add_part(b, part, state, load, dynamics); });
    for (int part = batch_count; part < part_count(b); ++part) add_part(b, part, state, load, dynamics);
  }
  add_forces_and_constraints(state, dynamics, constraints);
}

template <int D>
void Assembly<D>::add_residual_of(const std::vector<int>& elements, const State& state,
                                  Eigen::Ref<Eigen::VectorXd> dynamics,
                                  Eigen::Ref<Eigen::VectorXd> constraints) const {
  for (const int i : elements)
    add_element(elements_[i], state, line_load(elements_[i].span->beam, state), dynamics);
  add_forces_and_constraints(state, dynamics, constraints);
}

template <int D>
bool Assembly<D>::has_constant_constraints() const {
  return turning_.empty();
}

template <int D>
void Assembly<D>::turning_speeds(const State& state, Eigen::Ref<Eigen::VectorXd> speeds) const {
  const MeshedBeams<D> at = beams();
  speeds.setZero();
  for (const int i : turning_) {
    add_constraint_product(i, state, state.v, speeds);
    std::visit(
        [&](const auto& c) {
          if constexpr (offers_of<decltype(c)>.rates)
            speeds.segment(constraint_blocks_[i].row, c.rows) += rate_of<D>(c, at, state);
        },
        constraints_[i]);
  }
}

template <int D>
Eigen::VectorXd Assembly<D>::constraint_rate(const State& state) const {
  const MeshedBeams<D> at = beams();
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(constraint_count_);
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit(
        [&](const auto& c) {
          if constexpr (offers_of<decltype(c)>.rates)
            rate.segment(constraint_blocks_[i].row, c.rows) = rate_of<D>(c, at, state);
        },
        constraints_[i]);
  return rate;
}

template <int D>
Eigen::VectorXd Assembly<D>::constraint_product(const State& state, const Eigen::VectorXd& x) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(constraint_count_);
  for (int i = 0; i < static_cast<int>(constraints_.size()); ++i)
    add_constraint_product(i, state, x, product);
  return product;
}

template <int D>
void Assembly<D>::add_constraint_product(int i, const State& state, const Eigen::VectorXd& x,
                                         Eigen::Ref<Eigen::VectorXd> product) const {
  const MeshedBeams<D> at = beams();
  const ConstraintBlock& block = constraint_blocks_[i];
  const ConstraintTerms<D> terms =
      std::visit([&](const auto& c) { return c.terms(at, state, nullptr); }, constraints_[i]);
  for (std::size_t k = 0; k < block.block.dofs.size(); ++k)
    if (const int dof = block.block.dofs[k]; dof >= 0)
      product.segment(block.row, block.rows) += x[dof] * terms.gradient.col(static_cast<Eigen::Index>(k));
}

template <int D>
Eigen::VectorXd Assembly<D>::constraint_curvature(const State& state) const {
  const MeshedBeams<D> at = beams();
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(constraint_count_);
  const auto add = [&](const ConstraintBlock& block, const auto& c) {
    if constexpr (!offers_of<decltype(c)>.linear) {
      Eigen::Matrix<double, ConstraintTerms<D>::size, 1> v =
          Eigen::Matrix<double, ConstraintTerms<D>::size, 1>::Zero();
      for (std::size_t k = 0; k < block.block.dofs.size(); ++k)
        if (block.block.dofs[k] >= 0) v[static_cast<Eigen::Index>(k)] = state.v[block.block.dofs[k]];
      if constexpr (offers_of<decltype(c)>.curvature)
        curvature.segment(block.row, c.rows) = c.curvature(at, state, v);
      else
        for (int r = 0; r < c.rows; ++r) {
          const typename ConstraintTerms<D>::Multipliers unit = ConstraintTerms<D>::Multipliers::Unit(r);
          curvature[block.row + r] = v.dot(c.terms(at, state, &unit).hessian * v);
        }
    }
    if constexpr (offers_of<decltype(c)>.rates)
      curvature.segment(block.row, c.rows) += acceleration_of<D>(c, at, state);
  };
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    std::visit([&](const auto& c) { add(constraint_blocks_[i], c); }, constraints_[i]);
  return curvature;
}

template <int D>
double Assembly<D>::step_limit(const State& state) const {
  constexpr double largest_slide = 0.2;  // part of the shorter neighbour's length
  double limit = std::numeric_limits<double>::infinity();
  const auto speed = [&](int place) { return place >= 0 ? std::abs(state.v[place]) : 0; };
  for (const int moving : moving_spans_) {
    const MeshSpan& span = mesh_.spans[moving];
    const double closing = std::max(speed(span.place_a), speed(span.place_b));
    if (closing > 0)
      limit = std::min(limit, largest_slide * (span.end(state.q) - span.start(state.q)) / closing);
  }
  constexpr double largest_turn = 0.6;  // of a support or a rigid body in a step [rad]
  for (const Constraint& constraint : model_->constraints)
    if (const AxisTurn* turn = turn_of(constraint))
      if (const double rate = std::abs(turn->angle.at(state.t).rate); rate > 0)
        limit = std::min(limit, largest_turn / rate);
  for (const int p : mesh_.attitudes)
    if (p >= 0)  // its spin is 2 |dp/dt|
      if (const double rate = 2 * state.v.segment<4>(p).norm(); rate > 0)
        limit = std::min(limit, largest_turn / rate);
  return limit;
}

template <int D>
bool Assembly<D>::admissible(const State& state) const {
  constexpr double shortest = 1e-3;  // part of the element's length when the mesh was made
  constexpr double near = 0.1;       // of 1, for the length of an attitude
  for (const int p : mesh_.attitudes)
    if (p >= 0 && std::abs(state.q.segment<4>(p).squaredNorm() - 1) > near) return false;
  if constexpr (D == 3)
    for (const MeshElement<D>& e : elements_)
      if (e.twist && !e.twist->element.admissible(gather_twist(e, state.q))) return false;
  const auto is_possible = [&](const auto& f) {
    if constexpr (offers_of<decltype(f)>.rotational) return f.admissible(state);
    return true;
  };
  for (const BoundForce<D>& force : forces_)
    if (!std::visit(is_possible, force)) return false;
  return std::all_of(moving_spans_.begin(), moving_spans_.end(), [&](int moving) {
    const MeshSpan& span = mesh_.spans[moving];
    return span.end(state.q) - span.start(state.q) > shortest * (span.s_b - span.s_a);
  });
}

template <int D>
Eigen::VectorXd Assembly<D>::coordinate_scale() const {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(mesh_.coordinate_count);
  double longest = 0;
  for (const Beam& beam : model_->beams) longest = std::max(longest, beam.curve.length());
  for (const int r : mesh_.bodies) scale.segment<D>(r).setConstant(longest > 0 ? longest : 1);
  for (const int p : mesh_.attitudes)
    if (p >= 0) scale.segment<4>(p).setConstant(0.5);
  for (std::size_t b = 0; b < mesh_.nodes.size(); ++b) {
    const double length = model_->beams[b].curve.length();
    for (const MeshNode& node : mesh_.nodes[b]) {
      scale.segment<D>(node.r).setConstant(length);
      if (node.place >= 0) scale[node.place] = length;
    }
  }
  for (std::size_t j = 0; j < mesh_.riders.size(); ++j) {
    const double length = model_->beam_of(model_->riders[j]).curve.length();
    scale.segment<D>(mesh_.bodies[model_->riders[j].body]).setConstant(length);
    if (mesh_.riders[j].place >= 0) scale[mesh_.riders[j].place] = length;
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
          if constexpr (offers_of<decltype(f)>.memory) f.commit(at, state, memory);
        },
        force);
  return memory;
}

template <int D>
bool Assembly<D>::forces_depend_on_multipliers() const {
  return std::any_of(
      forces_.begin(), forces_.end(),
      [](const BoundForce<D>& force) {
        return std::visit([](const auto& f) { return offers_of<decltype(f)>.depends_on_multipliers; }, force);
      });
}

template class Assembly<2>;
template class Assembly<3>;

}  // namespace nurbeam
