#include "fem/system/beam_system.h"

#include <algorithm>
#include <cmath>

#include "fem/element/inertia.h"
#include "fem/forces/point_load.h"

namespace nurbeam {

namespace {

template <int D>
Eigen::Vector3d widened(const Eigen::Matrix<double, D, 1>& x) {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  y.head<D>() = x;
  return y;
}

// D - 1 unit vectors across a direction.
template <int D>
Eigen::Matrix<double, D - 1, D> directions_across(const Eigen::Vector3d& t) {
  Eigen::Matrix<double, D - 1, D> n;
  if constexpr (D == 2) {
    n << -t.y(), t.x();
  } else {
    int smallest;
    t.cwiseAbs().minCoeff(&smallest);
    const Eigen::Vector3d first = t.cross(Eigen::Vector3d::Unit(smallest)).normalized();
    n.row(0) = first;
    n.row(1) = t.cross(first);
  }
  return n;
}

// Between the tangent of one drawing at a place and that of another.
template <int D>
HeldAngle<D> drawn_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.head<D>().normalized(), b.head<D>().normalized()};
}

std::vector<int> without_absent(const std::vector<int>& dofs) {
  std::vector<int> present;
  std::copy_if(dofs.begin(), dofs.end(), std::back_inserter(present), [](int d) { return d >= 0; });
  return present;
}

template <int D>
ShapeFunctions<Jet> shape_at(const MeshElement<D>& e, const ElementVector<D>& q, double s) {
  return e.element.shape_series(q, e.local(q, s));
}

int value_index(const Eigen::SparseMatrix<double>& A, int row, int column) {
  const int* begin = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const int* end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, row) - A.innerIndexPtr());
}

}  // namespace

// Value, gradient and contracted Hessian of one constraint in its local coordinates: the element's, then the
// body's position, then sigma; of a joint of two beams those of both elements.
template <int D>
struct BeamSystem<D>::ConstraintTerms {
  static constexpr int size = 2 * element_size<D>;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, D, 1> value;
  Eigen::Matrix<double, Eigen::Dynamic, size, 0, D, size> gradient;
  Eigen::Matrix<double, size, size> hessian;
};

template <int D>
BeamSystem<D>::BeamSystem(const BeamModel& model, MeshPlan plan, std::vector<bool> held)
    : model_(&model), mesh_(make_mesh<D>(model, std::move(plan))), held_(std::move(held)) {
  held_.resize(model.joints.size(), false);
  build_constraints();
  build_pattern();
}

template <int D>
void BeamSystem<D>::build_constraints() {
  const State drawn = drawn_state();
  const auto add = [&](ConstraintKind kind, int rows, int index, int element, double s) {
    Constraint c{kind, constraint_count_, rows, index, {element, s, {}}, {}, {}, {}, {}};
    if (element >= 0) {
      if (kind != ConstraintKind::body_on_point) c.point = point_at(element, s, drawn);
      const auto& dofs = mesh_.elements[element].dofs;
      c.block.dofs.assign(dofs.begin(), dofs.end());
    }
    if (kind == ConstraintKind::body_on_point)
      for (int d = 0; d < D; ++d) c.block.dofs.push_back(mesh_.joints[index].r + d);
    if (kind == ConstraintKind::body_on_point || kind == ConstraintKind::place)
      c.block.dofs.push_back(mesh_.joints[index].place);
    constraint_count_ += rows;
    constraints_.push_back(std::move(c));
  };
  for (int i = 0; i < static_cast<int>(model_->supports.size()); ++i) {
    const Support& support = model_->supports[i];
    const int element = find_element<D>(*model_, mesh_, drawn.q, support.beam, support.s);
    add(ConstraintKind::position, D, i, element, support.s);
    if (support.clamped) add(ConstraintKind::direction, D - 1, i, element, support.s);
  }
  place_rows_.assign(model_->joints.size(), -1);
  for (int j = 0; j < static_cast<int>(model_->joints.size()); ++j) {
    const JointMode mode = mesh_.plan.modes[j];
    if (mode == JointMode::free) continue;
    const SlidingJoint& joint = model_->joints[j];
    const double s = mesh_.plan.places[j];
    if (mode != JointMode::node)
      add(ConstraintKind::body_on_point, D, j, find_element<D>(*model_, mesh_, drawn.q, joint.beam, s), s);
    if (mode == JointMode::stopped || held_[j] || joint.motion) {
      place_rows_[j] = constraint_count_;
      add(ConstraintKind::place, 1, j, -1, s);
    }
  }
  const auto add_joint = [&](ConstraintKind kind, int rows, int index) {
    const BeamJoint& joint = model_->beam_joints[index];
    const int a = find_element<D>(*model_, mesh_, drawn.q, joint.beam_a, joint.s_a);
    const int b = find_element<D>(*model_, mesh_, drawn.q, joint.beam_b, joint.s_b);
    Constraint c{kind,
                 constraint_count_,
                 rows,
                 index,
                 point_at(a, joint.s_a, drawn),
                 point_at(b, joint.s_b, drawn),
                 {},
                 {},
                 {}};
    for (int element : {a, b}) {
      const auto& dofs = mesh_.elements[element].dofs;
      c.block.dofs.insert(c.block.dofs.end(), dofs.begin(), dofs.end());
    }
    if (kind == ConstraintKind::joint_angle)
      c.angle = drawn_angle<D>(model_->beams[joint.beam_a].curve.tangent(joint.s_a),
                               model_->beams[joint.beam_b].curve.tangent(joint.s_b));
    constraint_count_ += rows;
    constraints_.push_back(std::move(c));
  };
  for (int i = 0; i < static_cast<int>(model_->beam_joints.size()); ++i) {
    add_joint(ConstraintKind::joint_position, D, i);
    if (model_->beam_joints[i].rigid) add_joint(ConstraintKind::joint_angle, 1, i);
  }
  for (int b = 0; b < static_cast<int>(mesh_.nodes.size()); ++b)
    for (const MeshNode& node : mesh_.nodes[b])
      if (node.home >= 0 && model_->beams[b].home[node.home].kind == NodeKind::rigid)
        add_corner(model_->beams[b].curve, node);
}

template <int D>
void BeamSystem<D>::add_corner(const ReferenceCurve& curve, const MeshNode& node) {
  Constraint c{ConstraintKind::corner_angle, constraint_count_, 1, -1, {-1, 0, {}}, {}, {}, {}, {}};
  c.angle = drawn_angle<D>(curve.tangent(node.s, true), curve.tangent(node.s));
  for (const int slope : {node.slope_left, node.slope_right})
    for (int d = 0; d < D; ++d) c.block.dofs.push_back(slope + d);
  constraint_count_ += c.rows;
  constraints_.push_back(std::move(c));
}

template <int D>
typename BeamSystem<D>::Point BeamSystem<D>::point_at(int element, double s, const State& drawn) const {
  const MeshElement<D>& e = mesh_.elements[element];
  Point point{element, s, {}};
  if (e.element.fixed()) point.fixed_shape = shape_at(e, gather<D>(e, drawn.q, drawn.v, drawn.a).q, s);
  return point;
}

template <int D>
void BeamSystem<D>::build_pattern() {
  const int n = mesh_.coordinate_count, size = n + constraint_count_;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_pairs = [&](const std::vector<int>& dofs) {
    for (int i : dofs)
      for (int j : dofs)
        if (i >= 0 && j >= 0) entries.emplace_back(i, j, 0.0);
  };
  for (const MeshElement<D>& e : mesh_.elements) {
    element_blocks_.push_back({{e.dofs.begin(), e.dofs.end()}, {}});
    add_pairs(element_blocks_.back().dofs);
  }
  for (const Constraint& c : constraints_) {
    add_pairs(c.block.dofs);
    for (int r = 0; r < c.rows; ++r)
      for (int dof : without_absent(c.block.dofs)) {
        entries.emplace_back(n + c.row + r, dof, 0.0);
        entries.emplace_back(dof, n + c.row + r, 0.0);
      }
  }
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 0.0);
  pattern_.resize(size, size);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();

  const auto locate_block = [&](Block& block) {
    for (int j : block.dofs)
      for (int i : block.dofs) block.values.push_back(i >= 0 && j >= 0 ? value_index(pattern_, i, j) : -1);
  };
  for (Block& block : element_blocks_) locate_block(block);
  for (Constraint& c : constraints_) {
    locate_block(c.block);
    for (int dof : c.block.dofs)
      for (int r = 0; r < c.rows; ++r) {
        c.gradient_values.push_back(dof >= 0 ? value_index(pattern_, n + c.row + r, dof) : -1);
        c.transposed_values.push_back(dof >= 0 ? value_index(pattern_, dof, n + c.row + r) : -1);
      }
  }
  for (const MeshJoint& joint : mesh_.joints) {
    std::array<int, 3> values{};
    for (int d = 0; d < D; ++d) values[d] = value_index(pattern_, joint.r + d, joint.r + d);
    body_values_.push_back(values);
  }
}

template <int D>
typename BeamSystem<D>::Vector BeamSystem<D>::line_load(int beam, double t) const {
  Vector load = model_->beams[beam].properties.mass_per_length * gravity();
  for (const LineLoad& line : model_->line_loads)
    if (line.beam == beam)
      load += load_factor_ * value_and_slope(line.time, t).first * line.value.template head<D>();
  return load;
}

// Calls visit(element index, shape series at the load's place, PointField of the loaded quantity, load,
// d(load)/d(r_s)).
template <int D>
template <class Visit>
void BeamSystem<D>::for_each_point_load(const State& state, Visit&& visit) const {
  for (const PointLoad& load : model_->point_loads) {
    const Beam& beam = model_->beams[load.beam];
    const double s = load.s + load.speed * state.t;
    if (!beam.is_ring() && (s < 0 || s > beam.curve.length())) continue;
    const int index = find_element<D>(*model_, mesh_, state.q, load.beam, s);
    const MeshElement<D>& e = mesh_.elements[index];
    const ElementState<D> x = gather<D>(e, state.q, state.v, state.a);
    const Eigen::Matrix<double, D, 4> nodes = Eigen::Map<const Eigen::Matrix<double, D, 4>>(x.q.data());
    const ShapeFunctions<Jet> shape = shape_at(e, x.q, s);
    const PointField<D> rs(shape.d1, nodes);
    const Eigen::Vector3d slope = widened<D>(rs.value);
    TurnedVector p = load_vector(load, beam.curve.tangent(s), slope);
    const bool is_moment = load.kind == PointLoad::Kind::moment;
    if (is_moment) p = moment_on_slope(p, slope);
    const double factor = load_factor_ * value_and_slope(load.time, state.t).first;
    const Vector value = factor * p.value.template head<D>();
    const Eigen::Matrix<double, D, D> gradient = factor * p.gradient.template topLeftCorner<D, D>();
    visit(index, nodes, is_moment ? rs : PointField<D>(shape.value, nodes), rs, value, gradient);
  }
}

template <int D>
typename BeamSystem<D>::ConstraintTerms BeamSystem<D>::constraint_terms(
    const Constraint& c, const State& state, const Eigen::VectorXd* multiplier) const {
  constexpr int n = element_size<D>;
  ConstraintTerms terms;
  terms.value.setZero(c.rows);
  terms.gradient.setZero(c.rows, ConstraintTerms::size);
  if (multiplier) terms.hessian.setZero();
  Vector y = Vector::Zero();
  if (multiplier) y.head(c.rows) = multiplier->segment(c.row, c.rows);

  if (c.kind == ConstraintKind::place) {
    const SlidingJoint& joint = model_->joints[c.index];
    const bool held = held_[c.index] || mesh_.plan.modes[c.index] == JointMode::stopped;
    const double target = held ? mesh_.plan.places[c.index] : value_and_slope(*joint.motion, state.t).first;
    terms.value[0] = state.q[c.block.dofs[0]] - target;
    terms.gradient(0, 0) = 1;
    return terms;
  }

  if (c.kind == ConstraintKind::corner_angle) {
    const auto slope = [&](int first) -> Vector { return state.q.segment<D>(c.block.dofs[first]); };
    const typename HeldAngle<D>::Terms held = c.angle->terms(slope(0), slope(D));
    terms.value[0] = held.value;
    terms.gradient.template leftCols<2 * D>() = held.gradient.transpose();
    if (multiplier) terms.hessian.template topLeftCorner<2 * D, 2 * D>() = y[0] * held.hessian;
    return terms;
  }

  if (c.other) {
    add_joint_terms(c, state, y, multiplier != nullptr, terms);
    return terms;
  }

  const MeshElement<D>& e = mesh_.elements[c.point.element];
  const ElementState<D> x = gather<D>(e, state.q, state.v, state.a);
  const Eigen::Matrix<double, D, 4> nodes = Eigen::Map<const Eigen::Matrix<double, D, 4>>(x.q.data());
  const bool on_point = c.kind == ConstraintKind::body_on_point;
  const double s = on_point ? state.q[c.block.dofs[n + D]] : c.point.s;
  const ShapeFunctions<Jet> shape = c.point.fixed_shape ? *c.point.fixed_shape : shape_at(e, x.q, s);
  const ReferenceCurve& curve = model_->beams[e.beam].curve;

  if (c.kind == ConstraintKind::direction) {
    const PointField<D> rs(shape.d1, nodes);
    const Eigen::Matrix<double, D - 1, D> across = directions_across<D>(curve.tangent(c.point.s));
    terms.value = across * rs.value;
    terms.gradient.template leftCols<n>() = across * rs.gradient;
    if (multiplier) rs.add_hessian(across.transpose() * y.template head<D - 1>(), 1, nodes, terms.hessian);
    return terms;
  }

  const PointField<D> r(shape.value, nodes);
  if (c.kind == ConstraintKind::position) {
    terms.value = r.value - curve.position(c.point.s).template head<D>();
    terms.gradient.template leftCols<n>() = r.gradient;
    if (multiplier) r.add_hessian(y, 1, nodes, terms.hessian);
    return terms;
  }

  const PointField<D> rs(shape.d1, nodes), rss(shape.d2, nodes);
  terms.value = r.value;
  for (int d = 0; d < D; ++d) terms.value[d] -= state.q[c.block.dofs[n + d]];
  terms.gradient.template leftCols<n>() = r.gradient;
  terms.gradient.template middleCols<D>(n).diagonal().setConstant(-1);
  terms.gradient.col(n + D) = rs.value;
  if (multiplier) {
    r.add_hessian(y, 1, nodes, terms.hessian);
    const Eigen::Matrix<double, n, 1> mixed = rs.gradient.transpose() * y;
    terms.hessian.template block<n, 1>(0, n + D) += mixed;
    terms.hessian.template block<1, n>(n + D, 0) += mixed.transpose();
    terms.hessian(n + D, n + D) += y.dot(rss.value);
  }
  return terms;
}

// Terms of r_a - r_b less their distance in the drawing, or of the held angle between the slopes. `terms` are
// zero before; y: multipliers.
template <int D>
void BeamSystem<D>::add_joint_terms(const Constraint& c, const State& state, const Vector& y,
                                    bool with_hessian, ConstraintTerms& terms) const {
  constexpr int n = element_size<D>;
  const bool is_position = c.kind == ConstraintKind::joint_position;
  const auto field_at = [&](const Point& point) {
    const MeshElement<D>& e = mesh_.elements[point.element];
    const ElementVector<D> q = gather<D>(e, state.q, state.v, state.a).q;
    const Eigen::Matrix<double, D, 4> nodes = Eigen::Map<const Eigen::Matrix<double, D, 4>>(q.data());
    const ShapeFunctions<Jet> shape = point.fixed_shape ? *point.fixed_shape : shape_at(e, q, point.s);
    return std::pair(PointField<D>(is_position ? shape.value : shape.d1, nodes), nodes);
  };
  const auto [a, nodes_a] = field_at(c.point);
  const auto [b, nodes_b] = field_at(*c.other);
  auto hessian_b = terms.hessian.template bottomRightCorner<n, n>();
  if (is_position) {
    const BeamJoint& joint = model_->beam_joints[c.index];
    const Eigen::Vector3d drawn = model_->beams[joint.beam_a].curve.position(joint.s_a) -
                                  model_->beams[joint.beam_b].curve.position(joint.s_b);
    terms.value = a.value - b.value - drawn.head<D>();
    terms.gradient.template leftCols<n>() = a.gradient;
    terms.gradient.template rightCols<n>() = -b.gradient;
    if (!with_hessian) return;
    a.add_hessian(y, 1, nodes_a, terms.hessian);
    b.add_hessian(y, -1, nodes_b, hessian_b);
    return;
  }
  const typename HeldAngle<D>::Terms held = c.angle->terms(a.value, b.value);
  Eigen::Matrix<double, 2 * D, 2 * n> slopes = Eigen::Matrix<double, 2 * D, 2 * n>::Zero();
  slopes.template topLeftCorner<D, n>() = a.gradient;
  slopes.template bottomRightCorner<D, n>() = b.gradient;
  terms.value[0] = held.value;
  terms.gradient = held.gradient.transpose() * slopes;
  if (!with_hessian) return;
  terms.hessian = y[0] * slopes.transpose() * held.hessian * slopes;
  a.add_hessian(held.gradient.template head<D>(), y[0], nodes_a, terms.hessian);
  b.add_hessian(held.gradient.template tail<D>(), y[0], nodes_b, hessian_b);
}

template <int D>
void BeamSystem<D>::residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                             Eigen::Ref<Eigen::VectorXd> constraints) const {
  dynamics.setZero();
  ElementResponse<D> response;
  for (int b = 0; b < static_cast<int>(model_->beams.size()); ++b) {
    const Vector load = line_load(b, state.t);
    for (int i = mesh_.first_element[b]; i < mesh_.first_element[b + 1]; ++i) {
      const MeshElement<D>& e = mesh_.elements[i];
      e.element.respond(gather<D>(e, state.q, state.v, state.a), load, nullptr, response);
      for (int k = 0; k < element_size<D>; ++k)
        if (e.dofs[k] >= 0) dynamics[e.dofs[k]] += response.force[k];
    }
  }
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j) {
    const double mass = model_->bodies[model_->joints[j].body].mass;
    const int r = mesh_.joints[j].r;
    dynamics.segment<D>(r) += mass * (state.a.segment<D>(r) - gravity());
  }
  for_each_point_load(state, [&](int index, const auto&, const PointField<D>& loaded, const auto&,
                                 const Vector& f, const auto&) {
    const auto& dofs = mesh_.elements[index].dofs;
    for (int k = 0; k < element_size<D>; ++k)
      if (dofs[k] >= 0) dynamics[dofs[k]] -= loaded.gradient.col(k).dot(f);
  });
  for (const Constraint& c : constraints_) {
    const ConstraintTerms terms = constraint_terms(c, state, nullptr);
    constraints.segment(c.row, c.rows) = terms.value;
    for (std::size_t k = 0; k < c.block.dofs.size(); ++k)
      if (c.block.dofs[k] >= 0)
        dynamics[c.block.dofs[k]] += terms.gradient.col(k).dot(state.lambda.segment(c.row, c.rows));
  }
}

template <int D>
void BeamSystem<D>::tangent(const State& state, const TangentWeights& w,
                            Eigen::SparseMatrix<double>& kkt) const {
  double* values = kkt.valuePtr();
  std::fill(values, values + kkt.nonZeros(), 0.0);
  const auto scatter = [values](const Block& block, const auto& matrix) {
    const std::size_t n = block.dofs.size();
    for (std::size_t j = 0, k = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i, ++k)
        if (block.values[k] >= 0) values[block.values[k]] += matrix(i, j);
  };
  ElementResponse<D> response;
  const bool constraints_only = w.mass == 0 && w.damping == 0 && w.stiffness == 0;
  for (int b = 0; b < static_cast<int>(model_->beams.size()) && !constraints_only; ++b) {
    const Vector load = line_load(b, state.t);
    for (int i = mesh_.first_element[b]; i < mesh_.first_element[b + 1]; ++i) {
      const MeshElement<D>& e = mesh_.elements[i];
      e.element.respond(gather<D>(e, state.q, state.v, state.a), load, &w, response);
      scatter(element_blocks_[i], response.tangent);
    }
  }
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j)
    for (int d = 0; d < D; ++d)
      values[body_values_[j][d]] += w.mass * model_->bodies[model_->joints[j].body].mass;
  if (w.stiffness != 0)
    for_each_point_load(
        state, [&](int index, const auto& nodes, const PointField<D>& loaded, const PointField<D>& rs,
                   const Vector& f, const Eigen::Matrix<double, D, D>& gradient) {
          ElementMatrix<D> K = -w.stiffness * loaded.gradient.transpose() * gradient * rs.gradient;
          loaded.add_hessian(f, -w.stiffness, nodes, K);
          scatter(element_blocks_[index], K);
        });
  for (const Constraint& c : constraints_) {
    const ConstraintTerms terms = constraint_terms(c, state, &state.lambda);
    if (w.stiffness != 0 && c.kind != ConstraintKind::place) scatter(c.block, w.stiffness * terms.hessian);
    for (std::size_t k = 0, v = 0; k < c.block.dofs.size(); ++k)
      for (int r = 0; r < c.rows; ++r, ++v)
        if (c.gradient_values[v] >= 0) {
          values[c.gradient_values[v]] += terms.gradient(r, k);
          values[c.transposed_values[v]] += terms.gradient(r, k);
        }
  }
}

template <int D>
Eigen::VectorXd BeamSystem<D>::constraint_rate(const State& state) const {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(constraint_count_);
  for (std::size_t j = 0; j < model_->joints.size(); ++j) {
    const bool prescribed =
        model_->joints[j].motion && !held_[j] && mesh_.plan.modes[j] != JointMode::stopped;
    if (place_rows_[j] >= 0 && prescribed)
      rate[place_rows_[j]] = -value_and_slope(*model_->joints[j].motion, state.t).second;
  }
  return rate;
}

template <int D>
Eigen::VectorXd BeamSystem<D>::constraint_curvature(const State& state) const {
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(constraint_count_);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(constraint_count_);
  for (const Constraint& c : constraints_) {
    if (c.kind == ConstraintKind::place) continue;
    Eigen::Matrix<double, ConstraintTerms::size, 1> v =
        Eigen::Matrix<double, ConstraintTerms::size, 1>::Zero();
    for (std::size_t k = 0; k < c.block.dofs.size(); ++k)
      if (c.block.dofs[k] >= 0) v[k] = state.v[c.block.dofs[k]];
    for (int r = 0; r < c.rows; ++r) {
      unit[c.row + r] = 1;
      curvature[c.row + r] = v.dot(constraint_terms(c, state, &unit).hessian * v);
      unit[c.row + r] = 0;
    }
  }
  return curvature;
}

template <int D>
double BeamSystem<D>::step_limit(const State& state) const {
  constexpr double largest_slide = 0.2;  // of the shorter neighbour
  double limit = std::numeric_limits<double>::infinity();
  for (const MeshElement<D>& e : mesh_.elements) {
    const ElementState<D> x = gather<D>(e, state.q, state.v, state.a);
    const double closing = std::max(std::abs(x.v[4 * D]), std::abs(x.v[4 * D + 1]));
    if (closing > 0) limit = std::min(limit, largest_slide * (x.q[4 * D + 1] - x.q[4 * D]) / closing);
  }
  return limit;
}

template <int D>
bool BeamSystem<D>::admissible(const State& state) const {
  constexpr double shortest = 1e-3;  // of the element's length when the mesh was made
  for (const MeshElement<D>& e : mesh_.elements) {
    const double length = end_of<D>(e, state.q) - start_of<D>(e, state.q);
    if (!(length > shortest * (e.s_b - e.s_a))) return false;
  }
  return true;
}

template <int D>
Eigen::VectorXd BeamSystem<D>::coordinate_scale() const {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(mesh_.coordinate_count);
  for (std::size_t b = 0; b < mesh_.nodes.size(); ++b) {
    const double length = model_->beams[b].curve.length();
    for (const MeshNode& node : mesh_.nodes[b]) {
      scale.segment<D>(node.r).setConstant(length);
      if (node.place >= 0) scale[node.place] = length;
    }
  }
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j) {
    const double length = model_->beams[model_->joints[j].beam].curve.length();
    scale.segment<D>(mesh_.joints[j].r).setConstant(length);
    if (mesh_.joints[j].place >= 0) scale[mesh_.joints[j].place] = length;
  }
  return scale;
}

template <int D>
SystemEnergy BeamSystem<D>::energy(const State& state) const {
  SystemEnergy sum;
  const Vector g = model_->gravity.head<D>();
  for (const MeshElement<D>& e : mesh_.elements) {
    const Vector weight = model_->beams[e.beam].properties.mass_per_length * g;
    const ElementEnergy part = e.element.energy(gather<D>(e, state.q, state.v, state.a), weight);
    sum.kinetic += part.kinetic;
    sum.axial += part.axial;
    sum.bending += part.bending;
    sum.gravity += part.external;
    sum.dissipation += part.dissipation;
  }
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j) {
    const double mass = model_->bodies[model_->joints[j].body].mass;
    sum.kinetic += mass * state.v.segment<D>(mesh_.joints[j].r).squaredNorm() / 2;
    sum.gravity -= mass * g.dot(state.q.segment<D>(mesh_.joints[j].r));
  }
  return sum;
}

template <int D>
Eigen::Vector3d BeamSystem<D>::momentum(const State& state) const {
  Vector sum = Vector::Zero();
  for (const MeshElement<D>& e : mesh_.elements) {
    ElementState<D> x = gather<D>(e, state.q, state.v, state.a);
    const double s_a = x.q[4 * D], s_b = x.q[4 * D + 1];
    double lo = s_a;
    const auto add_part = [&](double from, double to) {
      for (int g = 0; g < GaussRule::size; ++g) {
        const double s = from + (to - from) * GaussRule::points[g];
        sum += model_->beams[e.beam].properties.mass_per_length * (to - from) * GaussRule::weights[g] *
               material_point<D>(e, state.q, state.v, s).velocity;
      }
    };
    const ReferenceCurve& curve = model_->beams[e.beam].curve;
    for (double s = curve.next_break(s_a); s < s_b; s = curve.next_break(s)) {
      add_part(lo, s);
      lo = s;
    }
    add_part(lo, s_b);
  }
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j)
    sum += model_->bodies[model_->joints[j].body].mass * state.v.segment<D>(mesh_.joints[j].r);
  return widened<D>(sum);
}

template <int D>
double BeamSystem<D>::beam_length(const State& state, int beam) const {
  double sum = 0;
  for (int i = mesh_.first_element[beam]; i < mesh_.first_element[beam + 1]; ++i) {
    const MeshElement<D>& e = mesh_.elements[i];
    sum += e.element.energy(gather<D>(e, state.q, state.v, state.a), Vector::Zero()).length;
  }
  return sum;
}

template <int D>
Eigen::Vector3d BeamSystem<D>::joint_force(const State& state, int joint) const {
  if (mesh_.plan.modes[joint] == JointMode::free) return Eigen::Vector3d::Zero();
  const double mass = model_->bodies[model_->joints[joint].body].mass;
  return mass * (widened<D>(state.a.segment<D>(mesh_.joints[joint].r)) - model_->gravity);
}

template <int D>
double BeamSystem<D>::holding_force(const State& state, int joint) const {
  return place_rows_[joint] >= 0 ? -state.lambda[place_rows_[joint]] : 0;
}

template <int D>
std::optional<double> BeamSystem<D>::place(const State& state, int joint) const {
  const int dof = mesh_.joints[joint].place;
  return dof >= 0 ? std::optional<double>(state.q[dof]) : std::nullopt;
}

template <int D>
double BeamSystem<D>::place_rate(const State& state, int joint) const {
  const int dof = mesh_.joints[joint].place;
  return dof >= 0 ? state.v[dof] : 0;
}

template <int D>
State BeamSystem<D>::drawn_state() const {
  const int n = mesh_.coordinate_count;
  State state;
  state.q = state.v = state.a = Eigen::VectorXd::Zero(n);
  state.lambda = Eigen::VectorXd::Zero(constraint_count_);
  for (std::size_t b = 0; b < mesh_.nodes.size(); ++b)
    for (const MeshNode& node : mesh_.nodes[b]) {
      const ReferenceCurve& curve = model_->beams[b].curve;
      state.q.segment<D>(node.r) = curve.position(node.s).head<D>();
      state.q.segment<D>(node.slope_left) = curve.tangent(node.s, true).head<D>();
      state.q.segment<D>(node.slope_right) = curve.tangent(node.s).head<D>();
      if (node.place >= 0) state.q[node.place] = node.s;
    }
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j) {
    const SlidingJoint& joint = model_->joints[j];
    const MeshJoint& at = mesh_.joints[j];
    if (mesh_.plan.modes[j] == JointMode::free) continue;
    const ReferenceCurve& curve = model_->beams[joint.beam].curve;
    const double s = mesh_.plan.places[j];
    state.q.segment<D>(at.r) = curve.position(s).head<D>();
    state.q[at.place] = s;
  }
  return state;
}

template <int D>
void BeamSystem<D>::start_joints(State& state) const {
  state.v.setZero();
  for (std::size_t j = 0; j < mesh_.joints.size(); ++j) {
    const MeshJoint& at = mesh_.joints[j];
    if (mesh_.plan.modes[j] == JointMode::free) continue;
    const SlidingJoint& joint = model_->joints[j];
    const double speed = joint.motion ? value_and_slope(*joint.motion, state.t).second : joint.speed;
    const double s = state.q[at.place];
    const int first = mesh_.first_element[joint.beam], end = mesh_.first_element[joint.beam + 1];
    const int index =
        at.node >= 0 ? first + at.node : find_element<D>(*model_, mesh_, state.q, joint.beam, s);
    const MaterialPoint<D> right = material_point<D>(mesh_.elements[index], state.q, state.v, s);
    state.v.segment<D>(at.r) = speed * right.rs;
    state.v[at.place] = speed;
    if (at.node < 0) continue;
    // The material is at rest, so the slopes at the moving node change by what the node meets.
    const auto& before = mesh_.elements[(index > first ? index : end) - 1];
    const MaterialPoint<D> left = material_point<D>(before, state.q, state.v, s);
    const MeshNode& node = mesh_.nodes[joint.beam][at.node];
    const bool shared = node.slope_left == node.slope_right;
    state.v.segment<D>(node.slope_left) = speed * (shared ? Vector((left.rss + right.rss) / 2) : left.rss);
    if (!shared) state.v.segment<D>(node.slope_right) = speed * right.rss;
  }
}

template class BeamSystem<2>;
template class BeamSystem<3>;

}  // namespace nurbeam
