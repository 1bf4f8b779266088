#include "fem/sensitivity/transfer_tangent.h"

#include <Eigen/QR>
#include <cmath>
#include <numeric>

#include "fem/motion/remesh/new_elements.h"
#include "fem/motion/remesh/relative_motion.h"
#include "fem/sensitivity/sensitivities_parts.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"
#include "solver/algebra/side_by_side.h"
#include "solver/system/scaled_kkt.h"
#include "solver/system/tangent_rows.h"
#include "solver/tangents/start_tangent.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;
using Matrix = MotionTangents::Matrix;

// An acceleration so large that forces are lost in round-off beside it.
const double vast = std::ldexp(1.0, 300);

State without_motion(const State& state) {
  State still = state;
  still.v.setZero();
  still.a.setZero();
  still.lambda.setZero();
  return still;
}

// Rows of elements with moving ends or with torsion, and of all coordinates that constraints hold.
std::vector<int> rows_that_change_with_shape(const BeamSystem& system) {
  const int n = system.coordinate_count();
  const SparsePattern& pattern = system.tangent_pattern();
  std::vector<bool> wanted(static_cast<std::size_t>(pattern.size()), false);
  for (int k = pattern.column_starts()[n]; k < pattern.column_starts()[pattern.size()]; ++k)
    wanted[pattern.rows()[k]] = true;
  const auto want = [&](const auto& dofs) {
    for (const int dof : dofs)
      if (dof >= 0) wanted[dof] = true;
  };
  with_assembly(system, [&]<int D>(const Assembly<D>& assembly) {
    for (const MeshElement<D>& e : assembly.elements()) {
      if (e.twist)
        want(e.twist->dofs);
      else if (!e.element.fixed())
        want(e.dofs);
    }
  });
  std::vector<int> rows;
  for (int i = 0; i < n; ++i)
    if (wanted[i]) rows.push_back(i);
  return rows;
}

}  // namespace

TransferTangent::TransferTangent(std::shared_ptr<const BeamSystem> before,
                                 std::shared_ptr<const BeamSystem> system, const TransferPath& path,
                                 std::vector<Neighbours> neighbours, Kept kept,
                                 ResidualChanges residual_changes)
    : before_(std::move(before)),
      system_(std::move(system)),
      path_(path),
      neighbours_(std::move(neighbours)),
      momenta_(neighbours_.size()),
      kept_(std::move(kept)),
      residual_changes_(std::move(residual_changes)),
      with_shape_(rows_that_change_with_shape(*system_)) {
  for_each_parameter([&](std::size_t k) {
    const Neighbours& of = neighbours_[k];
    momenta_[k].more.emplace(*of.more_before.system, of.more_before.state, *of.more);
    momenta_[k].less.emplace(*of.less_before.system, of.less_before.state, *of.less);
  });
}

bool TransferTangent::carry(MotionTangents& tangents) const {
  interpolate(tangents);
  for (std::size_t i = 0; i < path_.stages.size(); ++i) {
    if (i > 0 && !move(path_.stages[i - 1], path_.moves[i - 1], tangents)) return false;
    put_bodies(path_.stages[i].state, tangents);
    if (!find_velocities(path_.stages[i], tangents)) return false;
  }
  if (path_.excess) keep_energy(path_.stages.back().state, *path_.excess, tangents);
  return true;
}

template <class Work>
void TransferTangent::for_each_parameter(const Work& work) const {
  side_by_side(
      static_cast<int>(neighbours_.size()), [&](int k) { work(static_cast<std::size_t>(k)); });
}

// Half the difference of `of`(parameter, whether it is more) over the step, a column for each parameter.
template <class Of>
TransferTangent::Matrix TransferTangent::rates(Eigen::Index rows, const Of& of) const {
  Matrix rates(rows, static_cast<Eigen::Index>(neighbours_.size()));
  for_each_parameter([&](std::size_t k) {
    rates.col(static_cast<Eigen::Index>(k)) = (of(k, true) - of(k, false)) / (2 * neighbours_[k].step);
  });
  return rates;
}

// Interpolates the tangents. Without new nodes the transfer of a motion beside the run's own is linear in it.
void TransferTangent::interpolate(MotionTangents& tangents) const {
  const bool is_linear = new_nodes(*before_, *system_).empty();
  const auto carried = path_.excess ? balanced : interpolated;
  for_each_parameter([&](std::size_t k) {
    const Neighbours& of = neighbours_[k];
    State tangent;
    if (is_linear && is_own(k))
      tangent = interpolated(*before_, rate(of.more_before.state, of.less_before.state, of.step), *system_);
    else
      tangent = rate(carried(*of.more_before.system, of.more_before.state, *of.more),
                     carried(*of.less_before.system, of.less_before.state, *of.less), of.step);
    const auto column = static_cast<Eigen::Index>(k);
    tangents.q.col(column) = tangent.q;
    tangents.v.col(column) = tangent.v;
    tangents.a.col(column) = tangent.a;
    tangents.lambda.col(column) = tangent.lambda;
  });
}

// Puts bodies that are points of the mesh on the curve.
void TransferTangent::put_bodies(const State& at, MotionTangents& tangents) const {
  const Mesh& mesh = system_->mesh();
  const int D = mesh.dimension;
  for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
    if (mesh.plan.modes[j] != Carried::point) continue;
    const Rider& rider = system_->model().riders[j];
    const Matrix places = rates(D, [&](std::size_t k, bool more) -> Vector {
      const Neighbours& of = neighbours_[k];
      const State state = moved_along(at, tangents, k, more ? of.step : -of.step);
      return material_point(more ? *of.more : *of.less, state, rider.beam, state.q[mesh.riders[j].place])
          .r.head(D);
    });
    tangents.q.middleRows(mesh.bodies[rider.body], D) = places;
  }
}

bool TransferTangent::find_velocities(const Transferred& stage, MotionTangents& tangents) const {
  const Eigen::Index n = stage.state.q.size(), m = stage.state.lambda.size();
  State driven = without_motion(stage.state);
  driven.a = vast * stage.state.v;
  driven.lambda = vast * stage.impulse;
  Matrix right(n + m, tangents.parameters()), left;
  const auto part = [&](std::size_t k, bool more) {
    return more ? neighbours_[k].step : -neighbours_[k].step;
  };
  right.topRows(n) = kept_.momenta + rates(n, [&](std::size_t k, bool more) -> Vector {
                       const State at = moved_along(stage.state, tangents, k, part(k, more));
                       return (more ? momenta_[k].more : momenta_[k].less)->on(at);
                     });
  right.topRows(n) -= residual_changes_(driven, tangents.q, with_shape_) / vast;
  right.bottomRows(m) = -rates(m, [&](std::size_t k, bool more) -> Vector {
    const BeamSystem& system = more ? *neighbours_[k].more : *neighbours_[k].less;
    const State at = moved_along(stage.state, tangents, k, part(k, more));
    return system.constraint_product(at, stage.state.v) + system.constraint_rate(at);
  });
  const ScaledKkt kkt(*system_, without_motion(stage.state));
  KktSolver solver;
  if (!solver.factorise(kkt.matrix, system_->moving_unknowns())) return false;
  right.topRows(n) /= kkt.scale;
  solver.solve(right, left);
  tangents.v = left.topRows(n);
  return true;
}

// (1, a column for each parameter) Change of the excess of energy of a state after the transfer over the
// state before.
TransferTangent::Matrix TransferTangent::energies(const State& at, const MotionTangents& tangents) const {
  return rates(
             1,
             [&](std::size_t k, bool more) {
               const Neighbours& of = neighbours_[k];
               const MeshedState& before = more ? of.more_before : of.less_before;
               const State beside = moved_along(at, tangents, k, more ? of.step : -of.step);
               return Eigen::Matrix<double, 1, 1>(
                   energy_change(*before.system, before.state, more ? *of.more : *of.less, beside));
             }) +
         kept_.energies(at);
}

// Conserves the energy by velocities.
void TransferTangent::keep_energy(const State& at, double excess, MotionTangents& tangents) const {
  const Matrix energy = energies(at, tangents);
  tangents.v += rates(at.v.size(), [&](std::size_t k, bool more) -> Vector {
    const Neighbours& of = neighbours_[k];
    const double part = more ? of.step : -of.step;
    const RelativeMotion motion =
        relative_motion(*(more ? of.more_before : of.less_before).system, more ? *of.more : *of.less,
                        moved_along(at, tangents, k, part));
    Vector change = Vector::Zero(at.v.size());
    change(motion.coordinates) =
        motion.growth(excess + part * energy(0, static_cast<Eigen::Index>(k))).value_or(0) *
        motion.velocities;
    return change;
  });
}

bool TransferTangent::move(const Transferred& stage, const MadeMove& made, MotionTangents& tangents) const {
  const BeamSystem& system = *system_;
  const Eigen::Index n = stage.state.q.size(), m = stage.state.lambda.size(),
                     f = static_cast<Eigen::Index>(made.free.size());
  const State still = without_motion(stage.state);
  const TangentRows stiffness(system, still, {.stiffness = 1}, made.free),
      mass(system, still, {.mass = 1}, made.free);
  const Eigen::MatrixXd K = stiffness.entries(made.free), M = mass.entries(made.free);
  std::vector<int> ties(static_cast<std::size_t>(m));
  std::iota(ties.begin(), ties.end(), static_cast<int>(n));
  const Eigen::MatrixXd G = mass.entries(ties).transpose();
  Vector force(n), constraints(m);
  system.residual(still, force, constraints);
  const Vector g = force(made.free), Kd = K * made.d, Md = M * made.d;
  const Vector nu = G.transpose().completeOrthogonalDecomposition().solve(-(Kd + made.mu * Md + g));

  // Changes of the equations while d, nu and mu stay.
  Vector whole = Vector::Zero(n);
  whole(made.free) = made.d;
  State ahead = still, behind = still, driven = still;
  const double part_of_it = small_part(system, whole);
  ahead.q += part_of_it * whole;
  behind.q -= part_of_it * whole;
  driven.a = (vast * made.mu) * whole;
  driven.lambda = vast * nu;
  const auto change_at = [&](const State& at) -> Matrix {
    return residual_changes_(at, tangents.q, made.free)(made.free, Eigen::all);
  };
  const Matrix dg = change_at(still), dKd = (change_at(ahead) - change_at(behind)) / (2 * part_of_it),
               inertia = change_at(driven) / vast;
  const auto part = [&](std::size_t k, bool more) {
    return more ? neighbours_[k].step : -neighbours_[k].step;
  };
  const Matrix across = rates(m, [&](std::size_t k, bool more) -> Vector {
    const BeamSystem& of = more ? *neighbours_[k].more : *neighbours_[k].less;
    return of.constraint_product(moved_along(still, tangents, k, part(k, more)), whole);
  });
  // Change of the energy that the move must bring; zero where the move does not bring it.
  Matrix energy = Matrix::Zero(1, tangents.parameters());
  if (made.mu != 0) {
    energy = energies(stage.state, tangents);
    energy += made.d.transpose() * (dg + dKd / 2);
  }

  // Rows and columns are scaled to one size, as the rank is determined. Rows are zero of constraints that
  // hold no part of the move, and of the energy where it is not brought.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(f + m + 1, f + m + 1);
  matrix.topLeftCorner(f, f) = K + made.mu * M;
  matrix.block(f, 0, m, f) = G;
  matrix.block(0, f, f, m) = G.transpose();
  if (made.mu != 0) {
    matrix.block(f + m, 0, 1, f) = (g + Kd).transpose();
    matrix.block(0, f + m, f, 1) = Md;
  }
  Vector rows = Vector::Ones(f + m + 1);
  for (Eigen::Index i = 0; i < f; ++i)
    if (const double stiff = std::abs(matrix(i, i)); stiff > 0) rows[i] = std::sqrt(stiff);
  Vector columns = rows;
  matrix.topRows(f).array().colwise() /= rows.head(f).array();
  matrix.leftCols(f).array().rowwise() /= columns.head(f).transpose().array();
  for (Eigen::Index i = f; i <= f + m; ++i) {
    if (const double size = matrix.row(i).norm(); size > 0) rows[i] = size;
    if (const double size = matrix.col(i).norm(); size > 0) columns[i] = size;
  }
  matrix.bottomRows(m + 1).array().colwise() /= rows.tail(m + 1).array();
  matrix.rightCols(m + 1).array().rowwise() /= columns.tail(m + 1).transpose().array();
  Eigen::MatrixXd right(f + m + 1, tangents.parameters());
  right << -(dg + dKd + inertia), -across, -energy;
  right.array().colwise() /= rows.array();
  const Eigen::MatrixXd left =
      columns.asDiagonal().inverse() * Eigen::MatrixXd(matrix.completeOrthogonalDecomposition().solve(right));
  if (!left.allFinite()) return false;
  tangents.q(made.free, Eigen::all) += std::ldexp(1.0, -made.halvings) * left.topRows(f);
  return true;
}

}  // namespace nurbeam
