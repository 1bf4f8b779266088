#include "fem/motion/modes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fem/motion/free_lengths.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"
#include "solver/eigenpairs.h"
#include "solver/equilibrated_kkt.h"
#include "solver/stability.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

Matrix tangent(const BeamSystem& system, const State& state, const TangentWeights& w) {
  Matrix kkt = system.tangent_pattern().matrix();
  system.tangent(state, w, kkt);
  return kkt;
}

Matrix coordinate_block(const Matrix& kkt, int n) { return kkt.topLeftCorner(n, n); }

Failure failure_of(Failure::Kind kind, double growth = 0) { return {.kind = kind, .growth = growth}; }

// ---- The state ----

// At rest, or as drawn without loads.
MeshedState state_at_rest(std::shared_ptr<const BeamModel> model, const ModesOptions& options,
                          const std::function<bool()>& interrupted, RestReport& report) {
  MeshedState at = MeshedState::drawn(std::move(model));
  if (options.about_equilibrium && asks_for_lengths(at.system->model())) {
    report = find_free_lengths(at, interrupted);
    if (report.failure || report.interrupted) return at;
  }
  if (options.about_equilibrium) {
    report = options.bodies_held ? find_held_equilibrium(at, interrupted)
                                 : find_rest(at, options.length_control, interrupted);
    if (!report.failure && !report.freed) report.failure = failure_of(Failure::Kind::resting_place);
  } else if (options.bodies_held) {
    const std::vector<bool> held(at.system->model().joints.size(), true);
    at.system = at.system->replanned(at.system->mesh().plan, held);
    at.state = drawn_state(*at.system);
  }
  if (!options.about_equilibrium) at.state.load = 0;
  return at;
}

// Nothing where the state is stable, and K symmetric.
std::optional<Failure> instability(const MeshedState& at, const Matrix& kkt) {
  const int n = at.system->coordinate_count();
  const std::optional<Stability> found = stability(kkt, n);
  if (!found) return failure_of(Failure::Kind::no_energy);
  if (found->unstable_directions == 0) return std::nullopt;
  const Matrix M = coordinate_block(tangent(*at.system, at.state, {.mass = 1}), n);
  const Vector& x = found->direction;
  const double square = x.dot(coordinate_block(kkt, n) * x) / x.dot(M * x);
  return failure_of(Failure::Kind::unstable_state, std::sqrt(std::max(0.0, -square)));
}

// ---- Vibration ----

struct SquaredFrequencies {
  Vector values;           // increasing [1/s^2]
  Eigen::MatrixXd shapes;  // x'M x = 1
  double resolution = 0;   // what the shift leaves of one that vanishes
};

// Whether a squared frequency is round-off: of x'K x / x'M x, or of the way in which it was found.
bool is_rigid(const SquaredFrequencies& found, Eigen::Index i, const Matrix& K) {
  const Vector size = found.shapes.col(i).cwiseAbs();
  const double round_off =
      100 * std::numeric_limits<double>::epsilon() * size.dot(Matrix(K.cwiseAbs()) * size);
  return std::abs(found.values[i]) <= std::max(round_off, found.resolution);
}

// The lowest, by the inverse of K + shift M: as many digits are lost as the shift is away from them.
std::optional<SquaredFrequencies> lowest(const Matrix& kkt, const Matrix& mass_kkt, int n, int count,
                                         double shift, const std::function<void()>& between) {
  const Matrix M = coordinate_block(mass_kkt, n);
  // Constraints once: both have them.
  Matrix shifted = kkt;
  Matrix mass_alone = mass_kkt;
  for (int column = 0; column < mass_alone.cols(); ++column)
    for (Matrix::InnerIterator entry(mass_alone, column); entry; ++entry)
      if (entry.row() >= n || column >= n) entry.valueRef() = 0;
  shifted += shift * mass_alone;
  std::optional<Eigenpairs> found = largest_eigenpairs(shift * M, shifted, count, between);
  if (!found) return std::nullopt;
  constexpr double accuracy = 1e-14;  // of an eigenvalue near 1
  SquaredFrequencies result{shift * (found->values.cwiseInverse().array() - 1).matrix(), found->vectors,
                            accuracy * shift};
  for (Eigen::Index i = 0; i < result.values.size(); ++i) {
    Vector x = result.shapes.col(i) / std::sqrt(result.shapes.col(i).dot(M * result.shapes.col(i)));
    Eigen::Index largest = 0;
    x.cwiseAbs().maxCoeff(&largest);
    result.shapes.col(i) = x[largest] < 0 ? Vector(-x) : x;
  }
  return result;
}

// The same with a shift that is a hundredth of the last one, whatever that is.
std::optional<SquaredFrequencies> lowest(const Matrix& kkt, const Matrix& mass_kkt, int n, int count,
                                         const std::function<void()>& between) {
  double largest = 0;
  for (int i = 0; i < n; ++i)
    if (mass_kkt.coeff(i, i) > 0) largest = std::max(largest, kkt.coeff(i, i) / mass_kkt.coeff(i, i));
  double shift = largest > 0 ? 1e-12 * largest : 1;
  constexpr int most_attempts = 12;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const std::optional<SquaredFrequencies> found = lowest(kkt, mass_kkt, n, count, shift, between);
    if (!found) {
      shift *= 1e3;  // K + shift M was singular to the last digit
      continue;
    }
    const double last = found->values.size() > 0 ? found->values[found->values.size() - 1] : 0;
    const bool moves_freely = !(last > 1e-6 * shift);  // nothing but rigid motions
    if (moves_freely && shift <= 1e-12 * largest) return found;
    if (shift > 1e-3 * last && shift < 0.2 * last) return found;
    shift = moves_freely ? shift / 1e4 : 1e-2 * last;
  }
  return std::nullopt;
}

/// (n) The coordinates' rates of a translation of everything.
Vector translation(const BeamSystem& system, int axis) {
  Vector e = Vector::Zero(system.coordinate_count());
  if (axis >= system.dimension()) return e;
  for (const auto& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes) e[node.r + axis] = 1;
  for (const int r : system.mesh().bodies) e[r + axis] = 1;
  return e;
}

std::optional<Failure> find_vibrations(const ModesOptions& options, const std::function<void()>& between,
                                       ModesReport& report) {
  const BeamSystem& system = *report.at.system;
  const int n = system.coordinate_count();
  const Matrix kkt = tangent(system, report.at.state, {.stiffness = 1});
  if (auto failure = instability(report.at, kkt)) return failure;
  const Matrix mass_kkt = tangent(system, report.at.state, {.mass = 1});
  const Matrix K = coordinate_block(kkt, n), M = coordinate_block(mass_kkt, n);
  const int most = std::max(0, n - system.constraint_count());
  const auto found = lowest(kkt, mass_kkt, n, std::min(options.count, most), between);
  if (!found) return failure_of(Failure::Kind::eigenvalues);
  for (Eigen::Index i = 0; i < found->values.size(); ++i) {
    Mode mode;
    mode.shape = found->shapes.col(i);
    const double square = found->values[i];
    const bool rigid = is_rigid(*found, i, K);
    if (!rigid && square < 0) return failure_of(Failure::Kind::unstable_state, std::sqrt(-square));
    mode.omega = rigid ? 0 : std::sqrt(square);
    for (int axis = 0; axis < 3; ++axis)
      mode.participation[axis] = mode.shape.dot(M * translation(system, axis));
    report.modes.push_back(std::move(mode));
  }
  const Vector e = translation(system, 0);
  report.mass = e.dot(M * e);
  return std::nullopt;
}

// ---- Buckling ----

// That in which beams without torsion do not bend, in space: the strain of their bending is the size of the
// curvature, across which it is as stiff, and which turns with the loads. Its stiffness is alike all around.
BeamModel without_round_bending(const BeamModel& model, int dimension) {
  BeamModel bare = model;
  for (Beam& beam : bare.beams)
    if (dimension == 3 && !beam.properties.sections) beam.properties.bending_stiffness = 0;
  return bare;
}

// The same with all laws held on the side of their kinks where they are, by what they are there.
State with_sides(const BeamSystem& system, State state) {
  state.memory.resize(0);
  state.sides = with_assembly(system, [&](const auto& assembly) { return assembly.sides(state); });
  return state;
}

// The state a little way along the path that starts at a state under gravity.
State along(const State& from, const Vector& direction, double amount) {
  State state = from;
  const auto n = state.q.size();
  state.q += amount * direction.head(n);
  state.lambda += amount * direction.tail(direction.size() - n);
  return state;
}

// That with dampers that are as stiff in strain rates as its beams and connectors are in strains, beside its
// own.
BeamModel with_viscous_strains(const BeamModel& model) {
  BeamModel viscous = model;
  for (Beam& beam : viscous.beams) beam.properties.damping += 1;
  for (Connector& connector : viscous.connectors) connector.damping += connector.stiffness;
  return viscous;
}

struct LoadStiffness {
  Matrix geometric;  // by a factor of the loads
  double reach = 0;  // factor with which they move something by the length of a beam, or turn it by 1
  bool loads_have_energy = true;
};

double largest_entry(const Matrix& matrix) {
  return matrix.nonZeros() > 0 ? matrix.coeffs().abs().maxCoeff() : 0;
}

// The longest of the vectors of a change of coordinates, and the largest of those that are in none, over
// their scales: the same in every frame.
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

// By how much the section forces, multipliers and loads of `loaded` beside those of `system` stiffen it, by
// what they are in first order.
// `stressed`: `system` without bending that is alike all around; `viscous`: that with viscous strains.
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
  // What the loads would do were nothing else there: those that constraints carry do round-off of it.
  const Vector pull = (without - with).head(n);
  double free = 0;
  for (int i = 0; i < n; ++i)
    if (kkt.coeff(i, i) > 0) free += pull[i] * pull[i] / kkt.coeff(i, i);
  const bool moves = std::abs(pull.dot(path.head(n))) > 1e-12 * free;
  if (!moves) path.head(n).setZero();  // constraints carry them all
  const State here = with_sides(system, state);
  // What stiffness of the strains, turned by the path, would change is of second order in the loads.
  const auto of_stresses = [&](const State& at) -> Matrix {
    const Matrix of_strains = tangent(viscous, at, {.damping = 1}) - tangent(stressed, at, {.damping = 1});
    return tangent(stressed, at, {.stiffness = 1}) - of_strains;
  };
  const auto slope = [&](double h) -> Matrix {
    return (of_stresses(along(here, path, h)) - of_stresses(along(here, path, -h))) / (2 * h);
  };
  // Extrapolated: errors of h^4, round-off of 1e-13. By multipliers alone it is linear.
  const double multiplier = m > 0 ? path.tail(m).lpNorm<Eigen::Infinity>() : 0;
  const double h = moves ? 2e-3 / fastest : multiplier > 0 ? largest_entry(kkt) / multiplier : 1;
  const Matrix geometric = (4 * slope(h / 2) - slope(h)) / 3;
  const Matrix of_loads = tangent(loaded, state, {.stiffness = 1}) - kkt;
  // Stresses have an energy, of which differences leave less of the symmetry than of exact tangents is left.
  const Matrix unsymmetric = coordinate_block(of_loads - Matrix(of_loads.transpose()), n);
  const double allowed = 1e-9 * largest_entry(of_loads) + 1e-15 * largest_entry(kkt);
  return LoadStiffness{coordinate_block(geometric + of_loads, n),
                       moves ? 1 / fastest : std::numeric_limits<double>::infinity(),
                       largest_entry(unsymmetric) <= allowed};
}

// Whether it can move without strain.
bool moves_rigidly(const MeshedState& at, const Matrix& kkt, const std::function<void()>& between) {
  const Matrix mass = tangent(*at.system, at.state, {.mass = 1});
  const auto found = lowest(kkt, mass, at.system->coordinate_count(), 1, between);
  return found && found->values.size() > 0 &&
         is_rigid(*found, 0, coordinate_block(kkt, at.system->coordinate_count()));
}

std::optional<Failure> find_buckling(const std::vector<Force>& forces, const ModesOptions& options,
                                     const std::function<void()>& between, ModesReport& report) {
  const MeshedState& at = report.at;
  BeamModel model = at.system->model();  // with the lengths of its connectors that were found
  model.forces = forces;
  const int n = at.system->coordinate_count();
  const Matrix kkt = tangent(*at.system, at.state, {.stiffness = 1});
  if (auto failure = instability(at, kkt)) return failure;
  if (moves_rigidly(at, kkt, between)) return failure_of(Failure::Kind::not_held);
  std::vector<bool> held;  // or at rest against a stop or an end
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    held.push_back(row_of_place(*at.system, static_cast<int>(j)).has_value());
  const BeamSystem loaded(model, at.system->mesh().plan, held);
  if (loaded.constraint_count() != at.system->constraint_count())
    return failure_of(Failure::Kind::resting_place);
  State state = at.state;
  state.load = 1;
  const BeamModel bare = without_round_bending(at.system->model(), at.system->dimension());
  const BeamSystem stressed(bare, at.system->mesh().plan, held);
  const BeamSystem viscous(with_viscous_strains(bare), at.system->mesh().plan, held);
  const auto by_loads = stiffness_of_loads(*at.system, loaded, stressed, viscous, state, kkt);
  if (!by_loads) return failure_of(Failure::Kind::not_held);
  const Matrix& geometric = by_loads->geometric;
  if (!by_loads->loads_have_energy) return failure_of(Failure::Kind::no_energy);
  if (!(largest_entry(geometric) > 0)) return failure_of(Failure::Kind::nothing_buckles);
  const Matrix A = -(geometric + Matrix(geometric.transpose())) / 2;
  const int most = std::max(0, n - at.system->constraint_count());
  const auto found = largest_eigenpairs(A, kkt, std::min(options.count, most), between);
  if (!found) return failure_of(Failure::Kind::eigenvalues);
  for (Eigen::Index i = 0; i < found->values.size(); ++i) {
    Mode mode;
    mode.factor = 1 / found->values[i];
    if (std::abs(mode.factor) > by_loads->reach) break;  // nothing is linear there
    mode.shape = found->vectors.col(i);
    report.modes.push_back(std::move(mode));
  }
  if (report.modes.empty()) return failure_of(Failure::Kind::nothing_buckles);
  return std::nullopt;
}

// Whether it is there before the loads: the weight of lumps, and what pulls at guided supports.
bool is_permanent(const Force& force) {
  return std::visit(
      [](const auto& described) {
        if constexpr (
            requires { described.permanent; })
          return bool(described.permanent);
        else
          return false;
      },
      force);
}

// ---- Shapes ----

double size_of(const MeshedState& at) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& nodes : at.system->mesh().nodes)
    for (const MeshNode& node : nodes) {
      const Eigen::Vector3d r = vector_at(*at.system, at.state.q, node.r);
      low = low.cwiseMin(r);
      high = high.cwiseMax(r);
    }
  return (high - low).norm();
}

}  // namespace

ModesReport find_modes(std::shared_ptr<const BeamModel> model, const ModesOptions& options,
                       const std::function<bool()>& interrupted) {
  ModesReport report;
  std::shared_ptr<const BeamModel> at_rest = model;
  const bool buckling = options.kind == ModesOptions::Kind::buckling;
  if (buckling) {
    BeamModel dead = *model;
    std::erase_if(dead.forces, [](const Force& force) { return !is_permanent(force); });
    at_rest = std::make_shared<const BeamModel>(std::move(dead));
  }
  report.at = state_at_rest(at_rest, options, interrupted, report.rest);
  if (report.rest.failure || report.rest.interrupted) return report;
  const auto between = [&] {
    if (interrupted && interrupted()) throw Interruption{};
  };
  try {
    report.rest.failure = buckling ? find_buckling(model->forces, options, between, report)
                                   : find_vibrations(options, between, report);
  } catch (const Interruption&) {
    report.rest.interrupted = true;
  }
  return report;
}

double visible_amplitude(const MeshedState& at, const Mode& mode) {
  constexpr double part = 0.05, turn = 0.5;
  const double size = size_of(at);
  double largest = 0;  // of what each quantity may be
  const auto look_at = [&](int first, double limit) {
    largest = std::max(largest, vector_at(*at.system, mode.shape, first).norm() / limit);
  };
  for (const auto& nodes : at.system->mesh().nodes)
    for (const MeshNode& node : nodes) {
      look_at(node.r, part * size);
      look_at(node.slope_left, turn);
      look_at(node.slope_right, turn);
      for (const int angle : {node.angle_left, node.angle_right})
        if (angle >= 0) largest = std::max(largest, std::abs(mode.shape[angle]) / turn);
      if (node.place >= 0) largest = std::max(largest, std::abs(mode.shape[node.place]) / (part * size));
    }
  for (const int r : at.system->mesh().bodies) look_at(r, part * size);
  return largest > 0 ? 1 / largest : 0;
}

Snapshot record_mode(const MeshedState& at, const Mode& mode, double amount, double rate,
                     const std::vector<ProbePlace>& probes) {
  Snapshot snapshot = record_snapshot(*at.system, at.state, probes);
  State moved = at.state;
  moved.q += amount * mode.shape;
  moved.v = rate * mode.shape;
  const Snapshot there = record_snapshot(*at.system, moved, probes);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    static_cast<PointRecord&>(snapshot.probes[i]) = there.probes[i];
    snapshot.probes[i].displacement = there.probes[i].displacement;
  }
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    snapshot.bodies[i].point = there.bodies[i].point;
    snapshot.bodies[i].s = there.bodies[i].s;
  }
  for (std::size_t b = 0; b < snapshot.beams.size(); ++b) {
    BeamRecord& beam = snapshot.beams[b];
    const BeamRecord& shape = there.beams[b];
    for (std::size_t e = 0; e < beam.elements.size(); ++e) {
      beam.elements[e].control_points = shape.elements[e].control_points;
      beam.elements[e].velocity = shape.elements[e].velocity;
    }
    beam.node_positions = shape.node_positions;
    beam.node_slopes = shape.node_slopes;
    beam.length = shape.length;
  }
  return snapshot;
}

}  // namespace nurbeam
