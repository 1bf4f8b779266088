#include "fem/motion/rest/snap.h"

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "fem/system/observables.h"
#include "solver/algebra/equilibrated_kkt.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

// Parts of the way: of the answer, and of one where the equilibria near a branch's end are not found.
constexpr double resolution = 1e-3, coarse_resolution = 1e-2;
constexpr double near_no_load = 0.02;
constexpr int few_load_steps = 12, most_load_steps = 400;  // of one equilibrium, and of all in between
/// What the search may cost, in Newton iterations: this many times what the answer has cost, but always as
/// many as solve for so many unknowns, a fraction of a second.
constexpr int times_the_answer = 2, always_solved = 300'000;

// Coordinates that add up to the angles of sections about the axis. A round section may turn freely in its
// place, and nothing else depends on these.
std::vector<int> turning_coordinates(const Mesh& mesh) {
  std::vector<int> found;
  const auto add = [&](int coordinate) {
    if (coordinate >= 0) found.push_back(coordinate);
  };
  for (const std::vector<MeshNode>& nodes : mesh.nodes)
    for (const MeshNode& node : nodes) {
      add(node.angle_left);
      if (node.angle_right != node.angle_left) add(node.angle_right);
    }
  for (const MeshSpan& span : mesh.spans) add(span.bubble);
  return found;
}

class SnapSearch {
 public:
  // `cost`: of the answer, in Newton iterations.
  SnapSearch(const BeamSystem& system, Loading from, Loading to, int cost,
             const std::function<bool()>& interrupted)
      : system_(system),
        way_(system, from, to, interrupted),
        interrupted_(interrupted),
        scale_(system.coordinate_scale()),
        turning_(turning_coordinates(system.mesh())),
        first_(from.load > 0 ? 0 : near_no_load),
        iterations_left_(std::max(always_solved / system.coordinate_count(), times_the_answer * cost)) {}

  // The part of the way from `from` (0) to `to` (1) at which the branch ends; nothing where it does not.
  std::optional<double> run(const State& from, const State& to) {
    State start = from;
    StaticReport found = settled(start, 0, 0, few_load_steps);
    if (found.leaves_start && found.status != StaticStatus::converged)
      found = settled(start, 0, 0, most_load_steps);
    if (found.status != StaticStatus::converged) return {};
    if (first_ > 0 && found.leaves_start && outweighs_loads(from, start)) return 0;
    whole_ = distance(start, to);
    constexpr double noticeable = 1e-6;  // relative to the model's size
    if (whole_ < noticeable) return {};
    return between({start, 0}, {to, 1});
  }

 private:
  struct Point {
    State state;
    double part;  // part of the way
  };

  std::optional<double> between(const Point& a, const Point& b) {
    if (b.part <= first_ || joined(a, b)) return {};
    const double part = b.part - a.part;
    if (part <= resolution) return end_of_branch(a, b);
    const std::optional<Point> middle = between_equilibria(a, b);
    if (!middle) return part <= coarse_resolution ? end_of_branch(a, b) : std::nullopt;
    if (const auto found = between(a, *middle)) return found;
    return between(*middle, b);
  }

  // The later part, where the model moves by twenty times an even share between the two.
  std::optional<double> end_of_branch(const Point& a, const Point& b) const {
    constexpr double jump = 20;
    if (distance(a.state, b.state) > jump * (b.part - a.part) * whole_) return b.part;
    return {};
  }

  // The equilibrium half way between two, started from the earlier one if that is not far, else from the
  // later one.
  std::optional<Point> between_equilibria(const Point& a, const Point& b) {
    const double part = (a.part + b.part) / 2;
    for (const auto& [from, load_steps] :
         {std::pair(&a, few_load_steps), {&b, few_load_steps}, {&a, most_load_steps}})
      if (State state = from->state; settle(state, part, from->part, load_steps))
        return Point{std::move(state), part};
    return {};
  }

  bool settle(State& state, double part, double from, int most) {
    return settled(state, part, from, most).status == StaticStatus::converged;
  }
  StaticReport settled(State& state, double part, double from, int most) {
    most = std::min(most, load_steps_left_);
    if (most <= 0 || iterations_left_ <= 0) return {};
    const LoadedBetween system(system_, way_.at(from), way_.at(part), interrupted_);
    state.load = 1;
    const StaticReport found = find_static_equilibrium({.max_load_steps = most}, system, state);
    load_steps_left_ -= found.load_steps;
    iterations_left_ -= found.newton_iterations;
    return found;
  }

  // Whether the bending energy of a model bent without loads exceeds the work that all loads could do on the
  // way there.
  bool outweighs_loads(const State& drawn, const State& bent) const {
    const Point point{bent, 0};
    const Vector loads = (residual(point, 1) - residual(point, 0)).head(scale_.size());
    return loads.cwiseProduct(scale_).lpNorm<1>() * distance(drawn, bent) <= energy(system_, bent).bending;
  }

  // Whether the tangents at both points lead from one to the other.
  bool joined(const Point& a, const Point& b) {
    constexpr double astray = 0.5, round_off = 1e-6;  // part of the whole way
    if (distance(a.state, b.state) <= round_off * whole_) return true;
    const Vector way = seen(b.state.q - a.state.q);
    iterations_left_ -= 2;  // each tangent costs as much as one
    const auto leads = [&](const Vector& move) { return (move - way).norm() <= astray * way.norm(); };
    return leads(heading(a, b.part)) && leads(-heading(b, a.part));
  }

  // (n) The move by the tangent; zero where it is singular.
  Vector heading(const Point& from, double part) const {
    constexpr double held = 1e-8;  // part of the stiffness of an angle, so that none is free
    const int n = system_.coordinate_count();
    Eigen::SparseMatrix<double> tangent = tangent_matrix(way_, at(from, from.part), {.stiffness = 1});
    for (const int i : turning_) tangent.coeffRef(i, i) *= 1 + held;
    const EquilibratedKkt kkt(tangent, n);
    if (!kkt.regular()) return Vector::Zero(n);
    return seen(kkt.solve(residual(from, from.part) - residual(from, part)).head(n));
  }
  Vector residual(const Point& point, double part) const {
    const int n = system_.coordinate_count(), m = system_.constraint_count();
    Vector rows(n + m);
    way_.residual(at(point, part), rows.head(n), rows.tail(m));
    return rows;
  }
  static State at(const Point& point, double part) {
    State state = point.state;
    state.load = part;
    return state;
  }

  double distance(const State& a, const State& b) const { return seen(a.q - b.q).lpNorm<Eigen::Infinity>(); }
  // (n) A move over the scales of its coordinates, without those that turn sections in their places.
  Vector seen(const Vector& move) const {
    Vector over = move.cwiseQuotient(scale_);
    for (const int i : turning_) over[i] = 0;
    return over;
  }

  const BeamSystem& system_;
  const LoadedBetween way_;
  const std::function<bool()>& interrupted_;
  const Vector scale_;
  const std::vector<int> turning_;
  const double first_;
  double whole_ = 0;
  int load_steps_left_ = most_load_steps, iterations_left_;
};

}  // namespace

std::optional<Loading> find_snap(const BeamSystem& system, const LoadedState& from, const LoadedState& to,
                                 int cost, const std::function<bool()>& interrupted) {
  SnapSearch search(system, from.loading, to.loading, cost, interrupted);
  const std::optional<double> part = search.run(from.state, to.state);
  if (!part) return {};
  return LoadedBetween(system, from.loading, to.loading, interrupted).at(*part);
}

}  // namespace nurbeam
