#include "fem/motion/rest/coupled_descent.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/system/observables.h"
#include "solver/algebra/kkt_solver.h"
#include "solver/algebra/quadratic_programme.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

// Disjoint groups; each is known by its first member.
class Groups {
 public:
  explicit Groups(std::size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), 0); }
  int of(int i) const { return first_[i] == i ? i : of(first_[i]); }
  void join(int i, int k) { first_[std::max(of(i), of(k))] = std::min(of(i), of(k)); }

 private:
  std::vector<int> first_;
};

// The eyelets of one beam: between them it is taut, and one that moves alone strains it.
void join_rings(const BeamModel& model, Groups& groups) {
  std::vector<int> first(model.beams.size(), -1);
  for (const Rider& rider : model.riders) {
    if (model.body_of(rider).mass > 0) continue;
    int& ring = first[rider.beam];
    if (ring < 0) ring = rider.body;
    groups.join(ring, rider.body);
  }
}

}  // namespace

std::vector<std::vector<int>> coupled_joints(const BeamModel& model, const std::vector<bool>& slides) {
  Groups groups(model.bodies.size());
  for (const Connector& connector : model.connectors)
    if (connector.ends[0].body >= 0 && connector.ends[1].body >= 0)
      groups.join(connector.ends[0].body, connector.ends[1].body);
  for (const Stop& stop : model.stops)
    if (stop.other >= 0) groups.join(model.riders[stop.rider].body, model.riders[stop.other].body);
  join_rings(model, groups);
  std::vector<std::vector<int>> members(model.bodies.size());
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    members[groups.of(model.riders[j].body)].push_back(j);
  std::vector<std::vector<int>> coupled;
  for (const std::vector<int>& group : members)
    if (group.size() > 1 && std::any_of(group.begin(), group.end(), [&](int j) { return slides[j]; }))
      coupled.push_back(group);
  return coupled;
}

std::optional<Eigen::MatrixXd> holding_stiffness(const BeamSystem& system, const State& state,
                                                 const std::vector<int>& riders) {
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {.stiffness = 1});
  KktSolver solver;
  if (!solver.factorise(kkt)) return {};
  const int n = system.coordinate_count();
  const auto count = static_cast<Eigen::Index>(riders.size());
  Eigen::MatrixXd H(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(kkt.rows());
    moved[n + row_of_place(system, riders[j]).value()] = 1;
    const Eigen::VectorXd rate = solver.solve(moved);
    for (Eigen::Index i = 0; i < count; ++i) H(i, j) = -rate[n + row_of_place(system, riders[i]).value()];
  }
  return Eigen::MatrixXd((H + H.transpose()) / 2);
}

LimitedMove least_within(const Eigen::VectorXd& f, const Eigen::MatrixXd& H, double round_off, double push,
                         const std::vector<MoveLimit>& limits) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
  const Eigen::MatrixXd& V = eigen.eigenvectors();
  Eigen::VectorXd values = eigen.eigenvalues(), along = V.transpose() * f;
  // Flatter directions, as all are on a straight guide, make no move longer than the limits of a move.
  constexpr double far_beyond = 1e3;  // moves
  const double flat = std::max({1e-12 * values.cwiseAbs().maxCoeff(), round_off / push,
                                f.lpNorm<Eigen::Infinity>() / (far_beyond * push)});
  if (flat == 0) return {Eigen::VectorXd::Zero(f.size()), std::vector<bool>(limits.size(), false)};
  for (Eigen::Index k = 0; k < f.size(); ++k) {
    const bool ridge = values[k] < -flat;
    values[k] = std::max(std::abs(values[k]), flat);
    if (ridge && std::abs(along[k]) <= round_off) along[k] = -push * values[k];
  }
  const Eigen::MatrixXd upward = V * values.asDiagonal() * V.transpose();
  const Eigen::VectorXd pull = V * along;

  const auto count = static_cast<Eigen::Index>(limits.size());
  Eigen::MatrixXd rows(count, f.size());
  Eigen::VectorXd bounds(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    rows.row(k) = limits[k].row;
    bounds[k] = limits[k].least;
  }
  const QuadraticMinimum least = least_quadratic(upward, pull, rows, bounds, 1e-12 * push);
  LimitedMove move{least.x, {}};
  for (Eigen::Index k = 0; k < count; ++k) move.pushed.push_back(least.pressures[k] > round_off);
  return move;
}

}  // namespace nurbeam
