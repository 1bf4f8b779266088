#include "fem/motion/remesh/mesh_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fem/motion/remesh/carried_sections.h"
#include "fem/motion/remesh/carried_weights.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// The present plan with the riders' present places. Its constant weights and charts still belong to the old
// places.
MeshPlan plan_at(const BeamSystem& system, const State& state) {
  MeshPlan plan = system.mesh().plan;
  for (int j = 0; j < static_cast<int>(plan.places.size()); ++j)
    if (const auto s = place(system, state, j)) plan.places[j] = *s;
  return plan;
}

// The rules of length control for one rider, from its two neighbours. On a ring, home nodes and places go on
// over the seam (Beam::home_place), as seen from the rider.
class RiderRules {
 public:
  RiderRules(const BeamSystem& system, const State& state, const LengthControl& control, int rider,
             NextPlan& next)
      : system_(system),
        state_(state),
        model_(system.model()),
        mesh_(system.mesh()),
        control_(control),
        joint_(rider),
        index_(model_.riders[rider].beam),
        beam_(model_.beams[index_]),
        next_(next),
        rate_(place_rate(system, state, rider)) {
    const auto s = place(system, state, rider);
    if (s) s_ = *s;
    if (mesh_.plan.modes[joint_] == Carried::node) look_around(state.q);
    if (mesh_.plan.modes[joint_] != Carried::free) watch_neighbours();
  }

  // The range of the rider's place in which apply(), having found nothing, would find nothing again,
  // whichever way the rider moves.
  const PlaceRange& quiet() const { return quiet_; }

  // Whether the rider is a node that may become a point: a point cannot carry a kink.
  bool may_become_point() const {
    const Rider& rider = model_.riders[joint_];
    return mesh_.plan.modes[joint_] == Carried::node && rider.continuous_slope && !rider.reel;
  }
  void become_point_for_good() {
    std::vector<bool>& for_good = plan().points_for_good;
    for_good.resize(model_.riders.size(), false);
    for_good[joint_] = true;
    become_point();
  }

  bool apply() {
    if (mesh_.plan.modes[joint_] == Carried::point) return leave_point();
    if (mesh_.plan.modes[joint_] != Carried::node) return false;
    if (!model_.riders[joint_].reel && (near_end() || is_near_as_point(passing_zone))) return become_point();
    return move_breaks() || exchange_nodes();
  }

 private:
  // A node at its present place.
  struct Node {
    double s;
    int home, rider;  // -1: none
  };
  static constexpr int on_each_side = 2;

  // Looks up the rider's node and two nodes on each side at their present places. A ring is gone round as
  // often as needed; an open beam may have fewer, and behind the mouth of a reel there is none.
  void look_around(const Eigen::VectorXd& q) {
    const std::vector<MeshNode>& nodes = mesh_.nodes[index_];
    const int count = static_cast<int>(nodes.size()), own = mesh_.riders[joint_].node;
    const int first = mesh_.first_span[index_];
    const double L = beam_.curve.length();
    const auto now = [&](int i) {
      return i + 1 < count || beam_.is_ring() ? mesh_.spans[first + i].start(q)
                                              : mesh_.spans[first + i - 1].end(q);
    };
    const int turns = beam_.is_ring() ? static_cast<int>(std::round((s_ - now(own)) / L)) : 0;
    for (int k = own - on_each_side; k <= own + on_each_side; ++k) {
      if (!beam_.is_ring() && (k < 0 || k >= count)) continue;
      const int turn = k < 0 ? -((count - 1 - k) / count) : k / count, i = k - turn * count;
      if (k == own) left_ = node_count_ - 1;  // -1 where there is none
      if (k == own + 1) right_ = node_count_;
      const int home = nodes[i].home >= 0 ? nodes[i].home + (turns + turn) * beam_.home_intervals() : -1;
      nodes_[node_count_++] = {now(i) + (turns + turn) * L, home, nodes[i].rider};
    }
    // The home nodes that can come and go, from the left neighbour to the right one.
    lowest_ = std::max(lowest(), beam_.home_interval(nearest_before()));
    highest_ = std::min(highest(), beam_.home_interval(nearest_behind()) + 1);
  }

  // Places of the neighbours; of the rider itself where there is none.
  double nearest_before() const { return left_ < 0 ? s_ : nodes_[left_].s; }
  double nearest_behind() const { return right_ < 0 ? s_ : nodes_[right_].s; }

  // Watches distances from two home nodes. While other riders are further away nothing else counts, and each
  // distance is watched before it is asked for.
  void watch_neighbours() {
    const int h = beam_.home_interval(s_);
    watch(at(h));
    watch(at(h + 1));
    if (node_count_ > 0 && std::any_of(nodes_.begin(), nodes_.begin() + node_count_, [&](const Node& node) {
          return node.rider >= 0 && node.rider != joint_;
        }))
      watch_closely();
  }
  void watch(double place) {
    const double round_off = 1e-12 * beam_.curve.length();
    if (place <= s_) quiet_.low = std::max(quiet_.low, place + round_off);
    if (place >= s_) quiet_.high = std::min(quiet_.high, place - round_off);
  }
  void watch(double place, double distance) {
    watch(place - distance);
    watch(place + distance);
  }
  // Other conditions may change at any time: no place but the present one is quiet.
  void watch_closely() { quiet_ = {s_, s_}; }
  bool is_near_as_point(double reach) {
    const int before = beam_.home_interval(s_);
    for (const int h : {before, before + 1})
      if (home(h).permanent) watch(at(h), reach * (at(before + 1) - at(before)));
    return near_as_point(model_, model_.riders[joint_], s_, reach);
  }

  double at(int h) const { return beam_.home_place(h); }
  const HomeNode& home(int h) const { return beam_.home_node(h); }
  int last() const { return beam_.home_intervals(); }
  bool is_end(int h) const { return !beam_.is_ring() && (h == 0 || h == last()); }
  // The home nodes that can come and go: all but the ends, or those of one turn around the rider.
  int lowest() const { return beam_.is_ring() ? beam_.home_interval(s_) - last() / 2 + 1 : 1; }
  int highest() const { return beam_.is_ring() ? lowest() + last() - 1 : last() - 1; }
  bool present(int h) const {
    return (is_planned_ ? next_.plan : mesh_.plan).beams[index_].present[beam_.home_index(h)];
  }
  // Length of the home interval that holds s.
  double spacing(double s) const { return beam_.home_spacing(s); }
  bool change(MeshChange kind) {
    next_.change = kind;
    next_.rider = joint_;
    return true;
  }
  // The next plan, made at the first change.
  MeshPlan& plan() {
    if (!std::exchange(is_planned_, true)) next_.plan = plan_at(system_, state_);
    return next_.plan;
  }
  void insert(int h) { plan().beams[index_].present[beam_.home_index(h)] = true; }
  void remove(int h) { plan().beams[index_].present[beam_.home_index(h)] = false; }

  bool leave_point() {
    if (mesh_.plan.is_point_for_good(joint_)) return false;
    const double from_end = std::min(s_ - at(0), at(last()) - s_), zone = 2 * end_zone * spacing(s_);
    if (!beam_.is_ring()) {
      watch(at(0) + zone);
      watch(at(last()) - zone);
    }
    if (!beam_.is_ring() && from_end < zone) return false;
    if (is_near_as_point(passing_zone_left)) return false;
    plan().modes[joint_] = Carried::node;
    return change(MeshChange::becomes_node);
  }

  bool near_end() {
    const auto near = [&](int neighbour) {
      const Node& node = nodes_[neighbour];
      if (node.rider >= 0 || !is_end(node.home)) return false;
      const double zone = end_zone * spacing(s_);
      watch(node.s, zone);
      return std::abs(node.s - s_) <= zone && is_approaching(node.s);
    };
    return near(left_) || near(right_);
  }

  bool is_approaching(double place) {
    watch_closely();
    return (place > s_) == (rate_ > 0);
  }

  // The rider becomes a point. All hidden nodes around it return, except those that another rider hides.
  bool become_point() {
    plan().modes[joint_] = Carried::point;
    for (int h = lowest_; h <= highest_; ++h)
      if (hidden(h) && !another_joint_near(h, passing_zone_left)) insert(h);
    return change(MeshChange::becomes_point);
  }

  bool hidden(int h) const { return !present(h) && at(h) > nearest_before() && at(h) < nearest_behind(); }

  // Whether a neighbour that is itself a moving node is within `reach` home intervals of a home node.
  bool another_joint_near(int h, double reach) const {
    for (const int neighbour : {left_, right_}) {
      if (neighbour < 0) continue;
      const Node& node = nodes_[neighbour];
      if (node.rider < 0) continue;
      const double gap = at(h) < node.s ? at(h + 1) - at(h) : at(h) - at(h - 1);
      if (std::abs(at(h) - node.s) <= reach * gap) return true;
    }
    return false;
  }

  // Whether a home node is a break that gives way to this rider, as its slope is discontinuous.
  bool gives_way(int h) const {
    return home(h).kind == NodeKind::smooth && passing(model_.riders[joint_], home(h)) == Passing::gives_way;
  }

  bool move_breaks() {
    for (int h = lowest_; h <= highest_; ++h) {
      if (!gives_way(h)) continue;
      const double distance = std::abs(at(h) - s_);
      const double gap = at(h) < s_ ? at(h + 1) - at(h) : at(h) - at(h - 1);
      watch(at(h), passing_zone_left * gap);
      watch(at(h), passing_zone * gap);
      if (hidden(h) && distance > passing_zone_left * gap && !another_joint_near(h, passing_zone_left)) {
        insert(h);
        return change(MeshChange::merge);  // charts change too: velocities are projected
      }
      const auto is_here = [&](int neighbour) {
        return neighbour >= 0 && nodes_[neighbour].rider < 0 && nodes_[neighbour].home == h;
      };
      if ((is_here(left_) || is_here(right_)) && distance < passing_zone * gap && is_approaching(at(h))) {
        remove(h);
        return change(MeshChange::merge);
      }
    }
    return false;
  }

  // Returns whether a hidden home node comes back in the element towards a neighbour.
  bool insert_towards(int neighbour) {
    if (neighbour < 0) return false;
    const Node& far = nodes_[neighbour];
    if (far.rider >= 0) return insert_between_joints(far);
    for (int h = lowest_; h <= highest_; ++h) {
      if (!hidden(h) || home(h).permanent || (at(h) > s_) != (far.s > s_)) continue;
      const double longest = control_.max * std::abs(far.s - at(h));
      watch(far.s, longest);
      if (std::abs(far.s - s_) <= longest) continue;
      insert(h);
      return true;
    }
    return false;
  }

  // A hidden node between two moving nodes returns when it is half a standard length from both.
  bool insert_between_joints(const Node& far) {
    for (int h = lowest_; h <= highest_; ++h) {
      if (!hidden(h) || home(h).permanent || (at(h) > s_) != (far.s > s_)) continue;
      const double margin = (control_.max - 1) * spacing(at(h));
      if (std::abs(at(h) - s_) <= margin || std::abs(at(h) - far.s) <= margin) continue;
      insert(h);
      return true;
    }
    return false;
  }

  bool remove_at(int neighbour) {
    if (neighbour < 0) return false;
    const Node& near = nodes_[neighbour];
    const int h = near.home;
    if (near.rider >= 0 || is_end(h) || home(h).permanent) return false;
    // If the next node is a moving one too, it hides the home node beyond it.
    const Node& beyond = nodes_[neighbour + (neighbour == left_ ? -1 : 1)];
    if (beyond.rider < 0 && !present(near.s < s_ ? h - 1 : h + 1)) return false;
    const double distance = std::abs(near.s - s_);
    const double here = std::abs(at(near.s < s_ ? h + 1 : h - 1) - at(h)),
                 behind = std::abs(at(near.s < s_ ? h - 1 : h + 1) - at(h));
    constexpr double last_moment = 0.1;
    for (const double threshold : {control_.min * here, (control_.max - 1) * behind, last_moment * here})
      watch(near.s, threshold);
    if (distance >= control_.min * here || distance > (control_.max - 1) * behind) return false;
    // Another hidden node comes back first, unless it is too near to a second rider and this node is too near
    // here.
    for (int k = lowest_; k <= highest_ && distance > last_moment * here; ++k)
      if (hidden(k) && !home(k).permanent) return false;
    remove(h);
    return true;
  }

  bool exchange_nodes() {
    const bool inserted = insert_towards(left_) || insert_towards(right_);
    const bool removed = remove_at(left_) || remove_at(right_);
    if (removed) return change(MeshChange::merge);
    return inserted && change(MeshChange::split);
  }

  const BeamSystem& system_;
  const State& state_;
  const BeamModel& model_;
  const Mesh& mesh_;
  const LengthControl& control_;
  int joint_, index_;
  const Beam& beam_;
  NextPlan& next_;
  bool is_planned_ = false;
  double s_ = 0, rate_;
  PlaceRange quiet_;
  std::array<Node, 2 * on_each_side + 1> nodes_;
  int node_count_ = 0;
  int left_ = -1, right_ = -1;     // indices in nodes_; -1: no such neighbour
  int lowest_ = 0, highest_ = -1;  // numbers of home nodes
};

}  // namespace

MeshPlan present_plan(const BeamSystem& system, const State& state) {
  MeshPlan plan = plan_at(system, state);
  carry_weights(system, state, plan);
  carry_sections(system, state, plan);
  return plan;
}

MeshPlan plan_like(const MeshPlan& like, const BeamSystem& system, const State& state) {
  MeshPlan plan = plan_at(system, state);
  plan.beams = like.beams;
  plan.modes = like.modes;
  plan.held = like.held;
  plan.points_for_good = like.points_for_good;
  plan.closed = like.closed;
  carry_weights(system, state, plan);
  carry_sections(system, state, plan, &like);
  return plan;
}

NextPlan next_plan(const BeamSystem& system, const State& state, const LengthControl& control,
                   int first_joint) {
  NextPlan next;
  for (int j = first_joint; j < static_cast<int>(system.mesh().plan.places.size()); ++j) {
    RiderRules rules(system, state, control, j, next);
    if (!rules.apply()) {
      next.quiet.push_back(rules.quiet());
      continue;
    }
    carry_weights(system, state, next.plan);
    carry_sections(system, state, next.plan);
    return next;
  }
  return next;
}

std::optional<NextPlan> point_for_good(const BeamSystem& system, const State& state,
                                       const LengthControl& control, int rider) {
  NextPlan next;
  RiderRules rules(system, state, control, rider, next);
  if (!rules.may_become_point()) return {};
  rules.become_point_for_good();
  carry_weights(system, state, next.plan);
  carry_sections(system, state, next.plan);
  return next;
}

bool MeshWatch::is_quiet(const std::shared_ptr<const BeamSystem>& system, const State& state) const {
  if (system_.owner_before(system) || system.owner_before(system_)) return false;
  const std::vector<MeshRider>& riders = system->mesh().riders;
  for (std::size_t j = 0; j < riders.size(); ++j)
    if (riders[j].place >= 0 && !quiet_[j].holds(state.q[riders[j].place])) return false;
  return true;
}

void MeshWatch::look(const std::shared_ptr<const BeamSystem>& system, const NextPlan& next) {
  system_.reset();
  if (next.change != MeshChange::none || next.quiet.size() != system->mesh().riders.size()) return;
  system_ = system;
  quiet_ = next.quiet;
}

bool can_wait(const BeamSystem& system, const State& state, const NextPlan& next) {
  constexpr double shortest = 0.01, longest = 1.5;  // in home element lengths
  if (next.change == MeshChange::becomes_node) return true;
  const Mesh& mesh = system.mesh();
  const int beam = system.model().riders[next.rider].beam;
  for (const int span : spans_at(mesh, beam, mesh.riders[next.rider].node)) {
    const double start = mesh.spans[span].start(state.q), end = mesh.spans[span].end(state.q);
    const double standard = system.model().beams[beam].home_spacing((start + end) / 2);
    if (end - start < shortest * standard || end - start > longest * standard) return false;
  }
  return true;
}

}  // namespace nurbeam
