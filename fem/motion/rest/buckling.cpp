#include "fem/motion/rest/buckling.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/motion/rest/find_loose_part.h"
#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"
#include "solver/algebra/eigenpairs.h"
#include "solver/algebra/equilibrated_kkt.h"
#include "solver/algebra/lowest_frequencies.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// The model without the bending of beams without torsion, in space. Their bending strain is the magnitude of
// the curvature, and it resists bending across the curvature too, in a direction that turns with the loads.
// This stiffness is equal all around.
BeamModel without_round_bending(const BeamModel& model, int dimension) {
  BeamModel bare = model;
  for (Beam& beam : bare.beams)
    if (dimension == 3 && !beam.properties.sections) {
      beam.properties = beam.properties.without_bending();
      for (PipeBend& bend : beam.bends) bend.properties = bend.properties.without_bending();
    }
  return bare;
}

// The state with all laws held on the side of their kinks where they are in it.
State with_sides(const BeamSystem& system, State state) {
  state.memory.resize(0);
  state.sides = with_assembly(system, [&](const auto& assembly) { return assembly.sides(state); });
  return state;
}

// The state moved by `amount` along `direction`, in coordinates and multipliers (n + m).
State along(const State& from, const Vector& direction, double amount) {
  State state = from;
  const auto n = state.q.size();
  state.q += amount * direction.head(n);
  state.lambda += amount * direction.tail(direction.size() - n);
  return state;
}

// The model with additional dampers, as stiff in strain rates as its beams and connectors are in strains.
BeamModel with_viscous_strains(const BeamModel& model) {
  BeamModel viscous = model;
  for (Beam& beam : viscous.beams) {
    beam.properties.damping += 1;
    for (PipeBend& bend : beam.bends) bend.properties.damping += 1;
  }
  for (Connector& connector : viscous.connectors) connector.damping += connector.stiffness;
  for (RotationalConnector& connector : viscous.rotational_connectors)
    connector.damping += connector.stiffness;
  return viscous;
}

struct LoadStiffness {
  Matrix geometric;  // derivative by a factor of the loads
  double reach = 0;  // factor at which loads move a place by the length of a beam, or turn it by 1
  bool loads_have_energy = true;
};

double largest_entry(const Matrix& matrix) {
  return matrix.nonZeros() > 0 ? matrix.coeffs().abs().maxCoeff() : 0;
}

// The longest vector of a change of coordinates, or the largest coordinate that belongs to no vector, over
// their scales: equal in every frame.
double longest(const BeamSystem& system, const Vector& change) {
  const Vector over = change.cwiseQuotient(system.coordinate_scale());
  double result = 0;
  std::vector<bool> in_vector(over.size(), false);
  const auto look_at = [&](int first) {
    result = std::max(result, over.segment(first, system.dimension()).norm());
    for (int i = 0; i < system.dimension(); ++i) in_vector[first + i] = true;
  };
  for (const auto& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes)
      for (const int first : {node.r, node.slope_left, node.slope_right}) look_at(first);
  for (const int r : system.mesh().bodies) look_at(r);
  for (Eigen::Index i = 0; i < over.size(); ++i)
    if (!in_vector[i]) result = std::max(result, std::abs(over[i]));
  return result;
}

// The largest entry of an unsymmetric matrix (n) that motions see which the constraints of `kkt` allow: its
// projection onto these. A moment that is fixed in space has no energy by itself, but it has one where
// supports hold the section's turn about another axis.
double largest_allowed(const Matrix& unsymmetric, const Matrix& kkt) {
  const auto n = unsymmetric.rows(), m = kkt.rows() - n;
  std::vector<Eigen::Index> loaded;
  for (Eigen::Index k = 0; k < n; ++k)
    for (Matrix::InnerIterator entry(unsymmetric, k); entry; ++entry)
      if (entry.value() != 0) {
        loaded.push_back(k);
        break;
      }
  if (loaded.empty()) return 0;
  Eigen::MatrixXd allowed = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(loaded.size()));
  for (std::size_t i = 0; i < loaded.size(); ++i) allowed(loaded[i], static_cast<Eigen::Index>(i)) = 1;
  if (m > 0) {
    const Matrix G = kkt.bottomLeftCorner(m, n);
    Eigen::SimplicialLDLT<Matrix> square(Matrix(G * Matrix(G.transpose())));
    if (square.info() != Eigen::Success) return largest_entry(unsymmetric);
    allowed -= Matrix(G.transpose()) * square.solve(Eigen::MatrixXd(G * allowed));
  }
  return (allowed.transpose() * (unsymmetric * allowed)).cwiseAbs().maxCoeff();
}

// The stiffness from section forces, multipliers and loads that `loaded` has beyond those of `system`, to
// first order in the loads. `stressed`: `system` without bending that is equal all around; `viscous`:
// `stressed` with viscous strains.
std::optional<LoadStiffness> stiffness_of_loads(const BeamSystem& system, const BeamSystem& loaded,
                                                const BeamSystem& stressed, const BeamSystem& viscous,
                                                const State& state, const Matrix& kkt) {
  const int n = system.coordinate_count(), m = system.constraint_count();
  Vector without(n + m), with(n + m);
  system.residual(state, without.head(n), without.tail(m));
  loaded.residual(state, with.head(n), with.tail(m));
  const EquilibratedKkt solver(kkt, n);
  if (!solver.regular()) return std::nullopt;
  Vector path = solver.solve(without - with);
  const double fastest = longest(system, path.head(n));
  // Energy of the loads if only the diagonal stiffness resisted them: loads that constraints carry do
  // round-off of it.
  const Vector pull = (without - with).head(n);
  double free = 0;
  for (int i = 0; i < n; ++i)
    if (kkt.coeff(i, i) > 0) free += pull[i] * pull[i] / kkt.coeff(i, i);
  const bool moves = std::abs(pull.dot(path.head(n))) > 1e-12 * free;
  if (!moves) path.head(n).setZero();  // constraints carry all loads
  const State here = with_sides(system, state);
  // The material stiffness, turned by the path, would change at second order in the loads only.
  const auto of_stresses = [&](const State& at) -> Matrix {
    const Matrix of_strains =
        tangent_matrix(viscous, at, {.damping = 1}) - tangent_matrix(stressed, at, {.damping = 1});
    return tangent_matrix(stressed, at, {.stiffness = 1}) - of_strains;
  };
  const auto slope = [&](double h) -> Matrix {
    return (of_stresses(along(here, path, h)) - of_stresses(along(here, path, -h))) / (2 * h);
  };
  // Richardson extrapolation: errors of h^4, round-off of 1e-13. The change by multipliers alone is linear.
  const double multiplier = m > 0 ? path.tail(m).lpNorm<Eigen::Infinity>() : 0;
  const double h = moves ? 2e-3 / fastest : multiplier > 0 ? largest_entry(kkt) / multiplier : 1;
  const Matrix geometric = (4 * slope(h / 2) - slope(h)) / 3;
  // Both tangents have load factor 1, which scales free strains; kkt of a drawn state is without them.
  const Matrix of_loads =
      tangent_matrix(loaded, state, {.stiffness = 1}) - tangent_matrix(system, state, {.stiffness = 1});
  // The test of symmetry is for the loads alone: stresses have an energy, and their differences are less
  // symmetric than exact tangents.
  const Matrix unsymmetric = Matrix(of_loads - Matrix(of_loads.transpose())).topLeftCorner(n, n);
  const double allowed = 1e-9 * largest_entry(of_loads) + 1e-15 * largest_entry(kkt);
  return LoadStiffness{Matrix(geometric + of_loads).topLeftCorner(n, n),
                       moves ? 1 / fastest : std::numeric_limits<double>::infinity(),
                       largest_entry(unsymmetric) <= allowed || largest_allowed(unsymmetric, kkt) <= allowed};
}

// Whether the model can move without strain.
bool moves_rigidly(const MeshedState& at, const Matrix& kkt, const std::function<void()>& between) {
  const int n = at.system->coordinate_count();
  constexpr int most_rigid = 6;
  const auto found =
      lowest_frequencies(kkt, tangent_matrix(*at.system, at.state, {.mass = 1}), n,
                         std::min(most_rigid, std::max(0, n - at.system->constraint_count())), between);
  if (!found) return false;
  const Matrix K = kkt.topLeftCorner(n, n);
  std::vector<double> round_offs;
  for (Eigen::Index i = 0; i < found->values.size(); ++i) round_offs.push_back(round_off(*found, i, K));
  const std::vector<bool> rigid = rigid_motions(*found, round_offs);
  return std::find(rigid.begin(), rigid.end(), true) != rigid.end();
}

}  // namespace

std::optional<Failure> find_buckling(const std::vector<Force>& forces, int count, const Matrix& kkt,
                                     const std::function<void()>& between, ModesReport& report) {
  const MeshedState& at = report.at;
  BeamModel model = at.system->model();  // with the lengths of its connectors that were found
  model.forces = forces;
  const int n = at.system->coordinate_count();
  if (moves_rigidly(at, kkt, between))
    return Failure{.kind = Failure::Kind::not_held, .loose = find_free_part(at)};
  std::vector<bool> held;  // held, or at rest against a stop or an end
  for (std::size_t j = 0; j < model.riders.size(); ++j)
    held.push_back(row_of_place(*at.system, static_cast<int>(j)).has_value());
  const BeamSystem loaded(model, at.system->mesh().plan, held);
  if (loaded.constraint_count() != at.system->constraint_count())
    return Failure{.kind = Failure::Kind::resting_place};
  State state = at.state;
  state.load = 1;
  const BeamModel bare = without_round_bending(at.system->model(), at.system->dimension());
  const BeamSystem stressed(bare, at.system->mesh().plan, held);
  const BeamSystem viscous(with_viscous_strains(bare), at.system->mesh().plan, held);
  const auto by_loads = stiffness_of_loads(*at.system, loaded, stressed, viscous, state, kkt);
  if (!by_loads) return Failure{.kind = Failure::Kind::not_held};
  const Matrix& geometric = by_loads->geometric;
  if (!by_loads->loads_have_energy) return Failure{.kind = Failure::Kind::no_energy};
  if (!(largest_entry(geometric) > 0)) return Failure{.kind = Failure::Kind::nothing_buckles};
  const Matrix A = -(geometric + Matrix(geometric.transpose())) / 2;
  const int most = std::max(0, n - at.system->constraint_count());
  const auto found = largest_eigenpairs(A, kkt, std::min(count, most), between);
  if (!found) return Failure{.kind = Failure::Kind::eigenvalues};
  for (Eigen::Index i = 0; i < found->values.size(); ++i) {
    Mode mode;
    mode.factor = 1 / found->values[i];
    if (std::abs(mode.factor) > by_loads->reach) break;  // the response is not linear there
    mode.shape = found->vectors.col(i);
    report.modes.push_back(std::move(mode));
  }
  if (report.modes.empty()) return Failure{.kind = Failure::Kind::nothing_buckles};
  return std::nullopt;
}

}  // namespace nurbeam
