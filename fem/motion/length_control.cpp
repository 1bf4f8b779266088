#include "fem/motion/length_control.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <set>

#include "fem/element/inertia.h"
#include "solver/consistent.h"

namespace nurbeam {

namespace {

double position_of(const MeshNode& node, const Eigen::VectorXd& q) {
  return node.place >= 0 ? q[node.place] : node.s;
}

// The rules of length control for one joint, seen from its two neighbours. Home nodes and places of a ring go
// on over the seam (Beam::home_place), as seen from the joint.
template <int D>
class JointRules {
 public:
  JointRules(const BeamSystem<D>& system, const State& state, const LengthControl& control, int joint,
             NextPlan& next)
      : model_(system.model()),
        mesh_(system.mesh()),
        control_(control),
        joint_(joint),
        index_(model_.joints[joint].beam),
        beam_(model_.beams[index_]),
        next_(next),
        rate_(system.place_rate(state, joint)) {
    const auto s = system.place(state, joint);
    if (s) s_ = *s;
    if (mesh_.plan.modes[joint_] == JointMode::node) look_around(state.q);
  }

  bool apply() {
    if (mesh_.plan.modes[joint_] == JointMode::point) return leave_point();
    if (mesh_.plan.modes[joint_] != JointMode::node) return false;
    if (near_end() || near_as_point(model_, model_.joints[joint_], s_, late_zone)) return become_point();
    return move_late_nodes() || exchange_nodes();
  }

 private:
  // The nodes of the beam where they are now, those of a ring three times around.
  void look_around(const Eigen::VectorXd& q) {
    const std::vector<MeshNode>& nodes = mesh_.nodes[index_];
    const int count = static_cast<int>(nodes.size()), own = mesh_.joints[joint_].node;
    const int first = mesh_.first_element[index_], around = beam_.is_ring() ? 1 : 0;
    const double L = beam_.curve.length();
    const auto now = [&](int i) {
      return i + 1 < count || beam_.is_ring() ? start_of<D>(mesh_.elements[first + i], q)
                                              : end_of<D>(mesh_.elements[first + i - 1], q);
    };
    const int turns = beam_.is_ring() ? static_cast<int>(std::round((s_ - now(own)) / L)) : 0;
    for (int turn = turns - around; turn <= turns + around; ++turn)
      for (int i = 0; i < count; ++i) {
        nodes_.push_back(nodes[i]);
        nodes_.back().s = now(i) + turn * L;
        if (nodes[i].home >= 0) nodes_.back().home += turn * beam_.home_intervals();
      }
    left_ = &nodes_[around * count + own - 1];
    right_ = &nodes_[around * count + own + 1];
  }

  double at(int h) const { return beam_.home_place(h); }
  const HomeNode& home(int h) const { return beam_.home[beam_.home_index(h)]; }
  int last() const { return beam_.home_intervals(); }
  bool is_end(int h) const { return !beam_.is_ring() && (h == 0 || h == last()); }
  // The home nodes that can come and go: all but the ends, or those of one turn around the joint.
  int lowest() const { return beam_.is_ring() ? beam_.home_interval(s_) - last() / 2 + 1 : 1; }
  int highest() const { return beam_.is_ring() ? lowest() + last() - 1 : last() - 1; }
  bool present(int h) const { return next_.plan.present[index_][beam_.home_index(h)]; }
  // Length of the home interval that holds s.
  double spacing(double s) const {
    const int h = beam_.home_interval(s);
    return at(h + 1) - at(h);
  }
  bool change(MeshChange kind) {
    next_.change = kind;
    next_.joint = joint_;
    return true;
  }
  void insert(int h) { next_.plan.present[index_][beam_.home_index(h)] = true; }
  void remove(int h) { next_.plan.present[index_][beam_.home_index(h)] = false; }

  bool leave_point() {
    const double from_end = std::min(s_, at(last()) - s_);
    if (!beam_.is_ring() && from_end < 2 * end_zone * spacing(s_)) return false;
    if (near_as_point(model_, model_.joints[joint_], s_, late_zone_left)) return false;
    next_.plan.modes[joint_] = JointMode::node;
    return change(MeshChange::becomes_node);
  }

  bool near_end() const {
    const auto near = [&](const MeshNode& node) {
      const bool approaching = (&node == right_) == (rate_ > 0);
      return node.joint < 0 && is_end(node.home) && approaching &&
             std::abs(node.s - s_) <= end_zone * spacing(s_);
    };
    return near(*left_) || near(*right_);
  }

  // All hidden nodes around it return, but for those that another joint hides.
  bool become_point() {
    next_.plan.modes[joint_] = JointMode::point;
    for (int h = lowest(); h <= highest(); ++h)
      if (hidden(h) && !another_joint_near(h, late_zone_left)) insert(h);
    return change(MeshChange::becomes_point);
  }

  bool hidden(int h) const { return !present(h) && at(h) > left_->s && at(h) < right_->s; }

  // Whether a neighbour that is itself a moving node is within some home intervals of a home node.
  bool another_joint_near(int h, double reach) const {
    for (const MeshNode* node : {left_, right_}) {
      if (node->joint < 0) continue;
      const double gap = at(h) < node->s ? at(h + 1) - at(h) : at(h) - at(h - 1);
      if (std::abs(at(h) - node->s) <= reach * gap) return true;
    }
    return false;
  }

  // A break before a joint with a discontinuous slope.
  bool gives_way(int h) const {
    return home(h).late && home(h).kind == NodeKind::smooth &&
           !passes_as_point(model_, model_.joints[joint_], h);
  }

  bool move_late_nodes() {
    for (int h = lowest(); h <= highest(); ++h) {
      if (!gives_way(h)) continue;
      const double distance = std::abs(at(h) - s_);
      const double gap = at(h) < s_ ? at(h + 1) - at(h) : at(h) - at(h - 1);
      if (hidden(h) && distance > late_zone_left * gap && !another_joint_near(h, late_zone_left)) {
        insert(h);
        return change(MeshChange::merge);  // charts change too: velocities are projected
      }
      const auto is_here = [&](const MeshNode* node) { return node->joint < 0 && node->home == h; };
      const bool approaching = (at(h) > s_) == (rate_ > 0);
      if ((is_here(left_) || is_here(right_)) && approaching && distance < late_zone * gap) {
        remove(h);
        return change(MeshChange::merge);
      }
    }
    return false;
  }

  // Returns whether a hidden home node comes back in the element towards `far`.
  bool insert_towards(const MeshNode& far) {
    if (far.joint >= 0) return insert_between_joints(far);
    for (int h = lowest(); h <= highest(); ++h) {
      if (!hidden(h) || home(h).late || (at(h) > s_) != (far.s > s_)) continue;
      if (std::abs(far.s - s_) <= control_.max * std::abs(far.s - at(h))) continue;
      insert(h);
      return true;
    }
    return false;
  }

  // The far end is another moving node: a hidden node returns when it is half a standard length from both.
  bool insert_between_joints(const MeshNode& far) {
    for (int h = lowest(); h <= highest(); ++h) {
      if (!hidden(h) || home(h).late || (at(h) > s_) != (far.s > s_)) continue;
      const double margin = (control_.max - 1) * spacing(at(h));
      if (std::abs(at(h) - s_) <= margin || std::abs(at(h) - far.s) <= margin) continue;
      insert(h);
      return true;
    }
    return false;
  }

  bool remove_at(const MeshNode& near) {
    const int h = near.home;
    if (near.joint >= 0 || is_end(h) || home(h).late) return false;
    // The next node may be another moving one: then a home node beyond it is hidden by that one.
    const MeshNode& beyond = near.s < s_ ? *(&near - 1) : *(&near + 1);
    if (beyond.joint < 0 && !present(near.s < s_ ? h - 1 : h + 1)) return false;
    const double distance = std::abs(near.s - s_);
    const double here = std::abs(at(near.s < s_ ? h + 1 : h - 1) - at(h)),
                 behind = std::abs(at(near.s < s_ ? h - 1 : h + 1) - at(h));
    if (distance >= control_.min * here || distance > (control_.max - 1) * behind) return false;
    // Another hidden node comes back first, unless it is too near to a second joint and this one too near
    // here.
    constexpr double last_moment = 0.1;
    for (int k = lowest(); k <= highest() && distance > last_moment * here; ++k)
      if (hidden(k) && !home(k).late) return false;
    remove(h);
    return true;
  }

  bool exchange_nodes() {
    const bool inserted = insert_towards(*left_) || insert_towards(*right_);
    const bool removed = remove_at(*left_) || remove_at(*right_);
    if (removed) return change(MeshChange::merge);
    return inserted && change(MeshChange::split);
  }

  const BeamModel& model_;
  const Mesh<D>& mesh_;
  const LengthControl& control_;
  int joint_, index_;
  const Beam& beam_;
  NextPlan& next_;
  double s_ = 0, rate_;
  std::vector<MeshNode> nodes_;
  const MeshNode *left_ = nullptr, *right_ = nullptr;
};

// The present plan but for constant weights, which still belong to the places of the old one.
template <int D>
MeshPlan plan_at(const BeamSystem<D>& system, const State& state) {
  MeshPlan plan = system.mesh().plan;
  for (std::size_t j = 0; j < plan.places.size(); ++j)
    if (const auto s = system.place(state, static_cast<int>(j))) plan.places[j] = *s;
  return plan;
}

// Weights that stay with their elements: kept, split (Eq. 21) or merged (Eqs. 31-38).
template <int D>
void carry_weights(const BeamSystem<D>& system, const State& state, MeshPlan& plan) {
  using Vector = Eigen::Matrix<double, D, 1>;
  plan.weights.clear();
  const BeamModel& model = system.model();
  const Mesh<D>& old = system.mesh();
  const Mesh<D> fresh = make_mesh<D>(model, plan);
  for (const MeshElement<D>& e : fresh.elements) {
    const Beam& beam = model.beams[e.beam];
    if (beam.weights != WeightRule::constant) continue;
    const double inset = 1e-9 * (e.s_b - e.s_a);
    const auto& first = old.elements[find_element<D>(model, old, state.q, e.beam, e.s_a + inset)];
    const auto& last = old.elements[find_element<D>(model, old, state.q, e.beam, e.s_b - inset)];
    const int segment = e.element.chart().segment;
    const auto u = [&](double s) { return segment < 0 ? s : beam.curve.parameter(segment, s); };
    std::array<double, 4> w{1, 1, 1, 1};
    if (&first == &last) {
      const auto q = gather<D>(first, state.q, state.v, state.v).q;
      Eigen::Matrix4d line = Eigen::Matrix4d::Zero();
      line.row(3) = first.element.bezier_weights(q).transpose();
      const double u0 = u(q[4 * D]), u1 = u(q[4 * D + 1]);
      const Eigen::Matrix4d part = RationalCubic(line)
                                       .piece(std::clamp((u(e.s_a) - u0) / (u1 - u0), 0.0, 1.0),
                                              std::clamp((u(e.s_b) - u0) / (u1 - u0), 0.0, 1.0))
                                       .points();
      w = {part(3, 0), part(3, 1), part(3, 2), part(3, 3)};
    } else if (beam.merge != MergeRule::ones) {
      const double s_h = position_of(old.nodes[e.beam][first.node_b], state.q);
      const auto a = material_point<D>(first, state.q, state.v, e.s_a);
      const auto h = material_point<D>(first, state.q, state.v, s_h);
      const auto b = material_point<D>(last, state.q, state.v, e.s_b);
      const double l = u(e.s_b) - u(e.s_a);
      const double J_a = segment < 0 ? 1 : beam.curve.geometry(segment, u(e.s_a)).stretch[0];
      const double J_b = segment < 0 ? 1 : beam.curve.geometry(segment, u(e.s_b)).stretch[0];
      w = merged_weights<D>(a.r, Vector(l * J_a * a.rs), b.r, Vector(l * J_b * b.rs), h.r,
                            (u(s_h) - u(e.s_a)) / l);
    }
    plan.weights.push_back({e.beam, e.s_a, e.s_b, w});
  }
}

template <int D>
const MeshNode* same_node(const std::vector<MeshNode>& nodes, const MeshNode& wanted) {
  for (const MeshNode& node : nodes)
    if (node.home == wanted.home && node.joint == wanted.joint) return &node;
  return nullptr;
}

// int rho A N' v_old ds over the new elements, N = dr/dq at fixed material, plus the bodies' momenta.
template <int D>
Eigen::VectorXd momentum_on(const BeamSystem<D>& from, const State& state, const BeamSystem<D>& to,
                            const State& next) {
  Eigen::VectorXd p = Eigen::VectorXd::Zero(to.coordinate_count());
  const BeamModel& model = to.model();
  const Mesh<D>& mesh = to.mesh();
  for (const MeshElement<D>& e : mesh.elements) {
    const Beam& beam = model.beams[e.beam];
    std::vector<double> parts{e.s_a, e.s_b};
    const auto add = [&](double place) {
      const double s = beam.curve.unrolled(place, (e.s_a + e.s_b) / 2);
      if (s > e.s_a && s < e.s_b) parts.push_back(s);
    };
    for (const MeshNode& node : from.mesh().nodes[e.beam]) add(position_of(node, state.q));
    for (double s : beam.curve.breaks()) add(s);
    std::sort(parts.begin(), parts.end());
    const ElementState<D> x = gather<D>(e, next.q, next.v, next.v);
    const Eigen::Matrix<double, D, 4> nodes = Eigen::Map<const Eigen::Matrix<double, D, 4>>(x.q.data());
    for (std::size_t i = 0; i + 1 < parts.size(); ++i)
      for (int g = 0; g < GaussRule::size; ++g) {
        const double length = parts[i + 1] - parts[i], s = parts[i] + length * GaussRule::points[g];
        const auto& old = from.mesh().elements[find_element<D>(model, from.mesh(), state.q, e.beam, s)];
        const auto velocity = material_point<D>(old, state.q, state.v, s).velocity;
        const PointField<D> r(e.element.shape_series(x.q, s).value, nodes);
        const double mass = beam.properties.mass_per_length * length * GaussRule::weights[g];
        for (int k = 0; k < element_size<D>; ++k)
          if (e.dofs[k] >= 0) p[e.dofs[k]] += mass * r.gradient.col(k).dot(velocity);
      }
  }
  for (std::size_t j = 0; j < mesh.joints.size(); ++j)
    p.segment<D>(mesh.joints[j].r) +=
        model.bodies[model.joints[j].body].mass * state.v.segment<D>(from.mesh().joints[j].r);
  return p;
}

// A motion on a new mesh whose elements cannot hold it exactly.
template <int D>
class Remap {
 public:
  Remap(const BeamSystem<D>& from, const State& state, const BeamSystem<D>& to)
      : from_(from), state_(state), to_(to) {}

  // The velocities for the places next.q, by L2 projection. Returns false when that is singular.
  bool set_velocities(State& next) {
    const Mesh<D>& mesh = to_.mesh();
    // A body on a point must lie on the curve, which the removal of its node has moved a little.
    for (std::size_t j = 0; j < mesh.joints.size(); ++j) {
      if (mesh.plan.modes[j] != JointMode::point) continue;
      const double s = next.q[mesh.joints[j].place];
      const int beam = to_.model().joints[j].beam;
      const auto& e = mesh.elements[find_element<D>(to_.model(), mesh, next.q, beam, s)];
      next.q.template segment<D>(mesh.joints[j].r) = material_point<D>(e, next.q, next.v, s).r;
    }
    return velocities_from_momentum(to_, momentum_on<D>(from_, state_, to_, next), next, impulse_);
  }

  // Moves nodes so that the total energy is the old one: those of new elements, which as interpolated carry
  // axial strain that the old ones had not, and where these cannot bring it, their neighbours too.
  void keep_energy(State& next) {
    const SystemEnergy old = from_.energy(state_);
    const double energy = old.mechanical();
    const double enough =
        1e-10 * (old.kinetic + old.axial + old.bending);  // the same wherever the model lies
    const auto excess = [&](const State& x) { return to_.energy(x).mechanical() - energy; };
    double e = excess(next);
    for (const bool with_neighbours : {false, true}) {
      const std::vector<int> free = free_coordinates(with_neighbours);
      constexpr int most_moves = 10;
      for (int i = 0; i < most_moves && std::abs(e) > enough && !free.empty(); ++i) {
        const double before = std::abs(e);
        if (!move_towards(next, free, excess, e)) break;
        if (std::abs(e) > 0.99 * before) break;
      }
    }
  }

  const Eigen::VectorXd& impulse() const { return impulse_; }

 private:
  // One move of the free coordinates, the least in the mass norm that takes the excess e away on the parabola
  // of the potential energy, or to its lowest. Returns whether |e| has fallen; else nothing changes.
  template <class Excess>
  bool move_towards(State& next, const std::vector<int>& free, const Excess& excess, double& e) {
    Eigen::VectorXd move = least_move(next, free, e);
    const Eigen::VectorXd impulse = impulse_;
    for (int attempt = 0; attempt < 4; ++attempt, move /= 2) {
      State trial = next;
      for (std::size_t i = 0; i < free.size(); ++i) trial.q[free[i]] += move[static_cast<long>(i)];
      if (!to_.admissible(trial) || !set_velocities(trial)) continue;
      const double left = excess(trial);
      if (!(std::abs(left) < std::abs(e))) continue;
      next = std::move(trial);
      e = left;
      return true;
    }
    impulse_ = impulse;
    return false;
  }

  // min d'Md/2 with g'd + d'Kd/2 = -e, K and g of the potential energy: d = -(K + mu M)^-1 g.
  Eigen::VectorXd least_move(const State& next, const std::vector<int>& free, double e) const {
    const long n = static_cast<long>(free.size());
    State still = next;
    still.v.setZero();
    still.a.setZero();
    still.lambda = Eigen::VectorXd::Zero(to_.constraint_count());
    Eigen::VectorXd force(to_.coordinate_count()), constraints(to_.constraint_count());
    to_.residual(still, force, constraints);
    const auto part = [&](const TangentWeights& weights) {
      Eigen::SparseMatrix<double> kkt = to_.tangent_pattern();
      to_.tangent(still, weights, kkt);
      Eigen::MatrixXd block(n, n);
      for (long i = 0; i < n; ++i)
        for (long k = 0; k < n; ++k) block(i, k) = kkt.coeff(free[i], free[k]);
      return Eigen::MatrixXd((block + block.transpose()) / 2);
    };
    Eigen::VectorXd g(n);
    for (long i = 0; i < n; ++i) g[i] = force[free[i]];
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(part({.stiffness = 1}),
                                                                          part({.mass = 1}));
    const Eigen::ArrayXd K = modes.eigenvalues().array();
    const Eigen::ArrayXd g_modes = (modes.eigenvectors().transpose() * g).array();
    const double largest = K.abs().maxCoeff();
    // From mu's ends, where K + mu M loses its sign, outwards the change of the energy falls to zero.
    const double end = e > 0 ? std::max(0.0, -K.minCoeff()) : -std::max(0.0, K.maxCoeff());
    const auto mu = [&](double exponent) {
      return end + (e > 0 ? 1 : -1) * largest * std::pow(10, exponent);
    };
    const auto change = [&](double exponent) {
      const Eigen::ArrayXd stiff = K + mu(exponent);
      return (g_modes.square() * (0.5 * K / stiff - 1) / stiff).sum();
    };
    double low = -12, high = 6;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (std::abs(change(middle)) > std::abs(e) ? low : high) = middle;
    }
    return modes.eigenvectors() * (-g_modes / (K + mu(high))).matrix();
  }

  // Positions and slopes of the nodes of new elements, and with_neighbours of the elements next to these: but
  // for supported positions, clamped slopes and positions of bodies.
  std::vector<int> free_coordinates(bool with_neighbours) const {
    const Mesh<D>& mesh = to_.mesh();
    std::set<std::pair<int, int>> nodes;  // beam, node
    for (const MeshElement<D>& e : mesh.elements)
      if (!was_there(e)) nodes.insert({{e.beam, e.node_a}, {e.beam, e.node_b}});
    if (with_neighbours)
      for (const std::set<std::pair<int, int>> inner = nodes; const MeshElement<D>& e : mesh.elements)
        if (inner.contains({e.beam, e.node_a}) || inner.contains({e.beam, e.node_b}))
          nodes.insert({{e.beam, e.node_a}, {e.beam, e.node_b}});
    std::set<int> free;
    for (const auto& [beam, i] : nodes) {
      const MeshNode& node = mesh.nodes[beam][i];
      bool held = node.joint >= 0, clamped = false;
      for (const Support& support : to_.model().supports)
        if (support.beam == beam && support.s == node.s) {
          held = true;
          clamped = clamped || support.clamped;
        }
      for (int k = 0; k < D; ++k) {
        if (!held) free.insert(node.r + k);
        if (!clamped) free.insert({node.slope_left + k, node.slope_right + k});
      }
    }
    return {free.begin(), free.end()};
  }

  // Whether the old mesh has an element between the same nodes.
  bool was_there(const MeshElement<D>& e) const {
    const Mesh<D>& old = from_.mesh();
    const auto& nodes = to_.mesh().nodes[e.beam];
    const MeshNode* a = same_node<D>(old.nodes[e.beam], nodes[e.node_a]);
    const MeshNode* b = same_node<D>(old.nodes[e.beam], nodes[e.node_b]);
    const long count = static_cast<long>(old.nodes[e.beam].size());
    const bool ring = to_.model().beams[e.beam].is_ring();
    return a != nullptr && b != nullptr && (b - a == 1 || (ring && b - a == 1 - count));
  }

  const BeamSystem<D>& from_;
  const State& state_;
  const BeamSystem<D>& to_;
  Eigen::VectorXd impulse_;  // of the constraints, by the last projection
};

}  // namespace

template <int D>
std::array<double, 4> merged_weights(const Eigen::Matrix<double, D, 1>& r_a,
                                     const Eigen::Matrix<double, D, 1>& slope_a,
                                     const Eigen::Matrix<double, D, 1>& r_b,
                                     const Eigen::Matrix<double, D, 1>& slope_b,
                                     const Eigen::Matrix<double, D, 1>& r_h, double u) {
  const double v = 1 - u;
  Eigen::Matrix<double, D, 3> A;
  A.col(0) = v * v * v * (r_a - r_h) + u * v * v * slope_a;
  A.col(1) = 3 * u * v * v * (r_a - r_h);
  A.col(2) = 3 * u * u * v * (r_b - r_h);
  const Eigen::Matrix<double, D, 1> B = u * u * v * slope_b - u * u * u * (r_b - r_h) - A.rowwise().sum();
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-2);
  const Eigen::Vector3d x = svd.solve(Eigen::VectorXd(B));
  if ((x.array() + 1 <= 0).any()) return {1, 1, 1, 1};
  return {x[0] + 1, x[1] + 1, x[2] + 1, 1};
}

template <int D>
MeshPlan present_plan(const BeamSystem<D>& system, const State& state) {
  MeshPlan plan = plan_at<D>(system, state);
  carry_weights<D>(system, state, plan);
  return plan;
}

template <int D>
NextPlan next_plan(const BeamSystem<D>& system, const State& state, const LengthControl& control) {
  NextPlan next;
  next.plan = plan_at<D>(system, state);
  for (std::size_t j = 0; j < next.plan.places.size(); ++j)
    if (JointRules<D>(system, state, control, static_cast<int>(j), next).apply()) {
      carry_weights<D>(system, state, next.plan);
      return next;
    }
  return next;
}

template <int D>
std::optional<State> transfer(const BeamSystem<D>& from, const State& state, const BeamSystem<D>& to,
                              bool exact, Eigen::VectorXd* impulse) {
  if (impulse != nullptr) impulse->resize(0);
  State next = to.drawn_state();
  next.t = state.t;
  const Mesh<D>&old = from.mesh(), &mesh = to.mesh();
  for (int b = 0; b < static_cast<int>(mesh.nodes.size()); ++b)
    for (const MeshNode& node : mesh.nodes[b]) {
      if (const MeshNode* kept = same_node<D>(old.nodes[b], node)) {
        const auto copy = [&](int target, int source, int n) {
          next.q.segment(target, n) = state.q.segment(source, n);
          next.v.segment(target, n) = state.v.segment(source, n);
        };
        copy(node.r, kept->r, D);
        copy(node.slope_left, kept->slope_left, D);
        copy(node.slope_right, kept->slope_right, D);
        if (node.place >= 0) copy(node.place, kept->place, 1);
        continue;
      }
      const auto& e = old.elements[find_element<D>(from.model(), old, state.q, b, node.s)];
      const MaterialPoint<D> p = material_point<D>(e, state.q, state.v, node.s);
      const double rate = node.joint >= 0 ? from.place_rate(state, node.joint) : 0;
      next.q.segment<D>(node.r) = p.r;
      next.v.segment<D>(node.r) = p.velocity + rate * p.rs;
      for (int slope : {node.slope_left, node.slope_right}) {
        next.q.segment<D>(slope) = p.rs;
        next.v.segment<D>(slope) = p.velocity_s + rate * p.rss;
      }
      if (node.place >= 0) {
        next.q[node.place] = node.s;
        next.v[node.place] = rate;
      }
    }
  for (std::size_t j = 0; j < mesh.joints.size(); ++j) {
    next.q.segment<D>(mesh.joints[j].r) = state.q.segment<D>(old.joints[j].r);
    next.v.segment<D>(mesh.joints[j].r) = state.v.segment<D>(old.joints[j].r);
    if (mesh.joints[j].place >= 0 && old.joints[j].place >= 0) {
      next.q[mesh.joints[j].place] = state.q[old.joints[j].place];
      next.v[mesh.joints[j].place] = state.v[old.joints[j].place];
    }
  }
  if (exact) return next;

  Remap<D> remap(from, state, to);
  if (!remap.set_velocities(next)) return std::nullopt;
  remap.keep_energy(next);
  if (impulse != nullptr) *impulse = remap.impulse();
  return next;
}

template MeshPlan present_plan<2>(const BeamSystem<2>&, const State&);
template MeshPlan present_plan<3>(const BeamSystem<3>&, const State&);
template NextPlan next_plan<2>(const BeamSystem<2>&, const State&, const LengthControl&);
template NextPlan next_plan<3>(const BeamSystem<3>&, const State&, const LengthControl&);
template std::optional<State> transfer<2>(const BeamSystem<2>&, const State&, const BeamSystem<2>&, bool,
                                          Eigen::VectorXd*);
template std::optional<State> transfer<3>(const BeamSystem<3>&, const State&, const BeamSystem<3>&, bool,
                                          Eigen::VectorXd*);
template std::array<double, 4> merged_weights<2>(const Eigen::Vector2d&, const Eigen::Vector2d&,
                                                 const Eigen::Vector2d&, const Eigen::Vector2d&,
                                                 const Eigen::Vector2d&, double);
template std::array<double, 4> merged_weights<3>(const Eigen::Vector3d&, const Eigen::Vector3d&,
                                                 const Eigen::Vector3d&, const Eigen::Vector3d&,
                                                 const Eigen::Vector3d&, double);

}  // namespace nurbeam
