#include "fem/motion/rest/modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "fem/mesh/attitude.h"
#include "fem/motion/rest/buckling.h"
#include "fem/motion/rest/free_lengths.h"
#include "fem/system/initial_state.h"
#include "solver/algebra/lowest_frequencies.h"
#include "solver/rest/stability.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

Matrix coordinate_block(const Matrix& kkt, int n) { return kkt.topLeftCorner(n, n); }

Failure failure_of(Failure::Kind kind, double growth = 0) { return {.kind = kind, .growth = growth}; }

// The state of the model at rest, or as drawn without loads.
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
    const std::vector<bool> held(at.system->model().riders.size(), true);
    at.system = at.system->replanned(at.system->mesh().plan, held);
    at.state = drawn_state(*at.system);
  }
  if (!options.about_equilibrium) at.state.load = 0;
  return at;
}

// The failure of an unstable state or of an unsymmetric K; nothing where the state is stable.
std::optional<Failure> instability(const MeshedState& at, const Matrix& kkt) {
  const int n = at.system->coordinate_count();
  const std::optional<Stability> found = stability(kkt, n);
  if (!found) return failure_of(Failure::Kind::no_energy);
  if (found->unstable_directions == 0) return std::nullopt;
  const Matrix M = coordinate_block(tangent_matrix(*at.system, at.state, {.mass = 1}), n);
  const Vector& x = found->direction;
  const double square = x.dot(coordinate_block(kkt, n) * x) / x.dot(M * x);
  return failure_of(Failure::Kind::unstable_state, std::sqrt(std::max(0.0, -square)));
}

/// (n) Rates of the coordinates in a translation of the whole model along an axis.
Vector translation(const BeamSystem& system, int axis) {
  Vector e = Vector::Zero(system.coordinate_count());
  if (axis >= system.dimension()) return e;
  for (const auto& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes) e[node.r + axis] = 1;
  for (const int r : system.mesh().bodies) e[r + axis] = 1;
  return e;
}

/// Vibrations with gyroscopic forces.
struct Whirling {
  SquaredFrequencies found;  ///< shapes at their widest moment
  Eigen::MatrixXd quarter;   ///< shapes a quarter of a period later
};

/// Vibrations with gyroscopic forces, M x'' + G x' + K x = 0 with G' = -G, in the space of the lowest
/// vibrations without them, where M = 1 and K = L^2 is diagonal. With y = (L x, x') it is y' = S y with the
/// skew matrix S = [0, L; -L, -G], of eigenvalues i omega.
Whirling with_gyroscopes(const SquaredFrequencies& still, const Matrix& gyroscopic, int count) {
  const Eigen::Index n = still.values.size();
  const Eigen::MatrixXd G = still.shapes.transpose() * (gyroscopic * still.shapes);
  const Eigen::MatrixXd L = still.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  Eigen::MatrixXcd H = Eigen::MatrixXcd::Zero(2 * n, 2 * n);  // -i S
  const std::complex<double> i(0, 1);
  H.topRightCorner(n, n) = -i * L;
  H.bottomLeftCorner(n, n) = i * L;
  H.bottomRightCorner(n, n) = i * (G - G.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(H);
  Whirling whirling{{.values = Vector(count),
                     .shapes = Eigen::MatrixXd(still.shapes.rows(), count),
                     .resolution = still.resolution},
                    Eigen::MatrixXd(still.shapes.rows(), count)};
  for (int k = 0; k < count; ++k) {
    const double omega = solver.eigenvalues()[n + k];  // those below 0 are as many
    whirling.found.values[k] = omega * omega;
    // x' is i omega x; the phase in which x is widest.
    Eigen::VectorXcd x = solver.eigenvectors().col(n + k).tail(n);
    const std::complex<double> square = x.cwiseProduct(x).sum();
    if (std::abs(square) > 1e-12) x *= std::exp(-i * std::arg(square) / 2.0);
    const Vector real = x.real(), imaginary = x.imag();
    const double size = real.norm();
    whirling.found.shapes.col(k) = still.shapes * (real / size);
    whirling.quarter.col(k) = still.shapes * (-imaginary / size);
  }
  return whirling;
}

/// What vectors sweep about axes from one moment of a mode to that a quarter of a period later.
struct Swept {
  double area = 0, most = 0;  // with the sign of the axes; twice what it can be

  void add(const Eigen::Vector3d& axis, const Eigen::Vector3d& now, const Eigen::Vector3d& then) {
    area += axis.dot(now.cross(then));
    most += now.squaredNorm() + then.squaredNorm();
  }
  int sense() const {
    constexpr double nothing = 1e-6;
    return std::abs(area) <= nothing * most ? 0 : area > 0 ? 1 : -1;
  }
};

// Of the turns of bodies about the axes of their rotors.
Swept swept_by_rotors(const MeshedState& at, const Vector& now, const Vector& then) {
  const BeamModel& model = at.system->model();
  Swept swept;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const int first = at.system->mesh().attitudes[i];
    if (first < 0 || model.bodies[i].rigid->rotor.isZero(0)) continue;
    const Eigen::Vector4d p = at.state.q.segment<4>(first);
    const Eigen::Vector3d axis = attitude::turned<double>(p, model.bodies[i].rigid->rotor).normalized();
    swept.add(axis, attitude::spin(p, now.segment<4>(first)), attitude::spin(p, then.segment<4>(first)));
  }
  return swept;
}

// Of the ways of nodes and bodies about the axis of the frame.
Swept swept_in_frame(const MeshedState& at, const Vector& now, const Vector& then) {
  const BeamSystem& system = *at.system;
  const Eigen::Vector3d axis = system.model().field->rate.normalized();
  Swept swept;
  const auto add = [&](int r) {
    const auto way = [&](const Vector& x) {
      Eigen::Vector3d d = Eigen::Vector3d::Zero();
      d.head(system.dimension()) = x.segment(r, system.dimension());
      return d;
    };
    swept.add(axis, way(now), way(then));
  };
  for (const auto& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes) add(node.r);
  for (const int r : system.mesh().bodies) add(r);
  return swept;
}

bool has_rotor(const Body& body) { return body.rigid && !body.rigid->rotor.isZero(0); }
bool turns(const MassField& field) { return !field.rate.isZero(0); }

// Forwards or backwards: of the rotors where there are some, else of the frame.
int whirl(const MeshedState& at, const Vector& now, const Vector& then) {
  const BeamModel& model = at.system->model();
  return (std::ranges::any_of(model.bodies, has_rotor) ? swept_by_rotors(at, now, then)
                                                       : swept_in_frame(at, now, then))
      .sense();
}

/// The lowest vibrations without gyroscopic forces: `wanted` of them to all digits, which a search for many
/// loses where the last is far above the first, and more, orthogonal to them, up to `many` in all.
std::optional<SquaredFrequencies> wide_space(const Matrix& kkt, const Matrix& mass_kkt, const Matrix& M,
                                             int wanted, int many, const std::function<void()>& between) {
  constexpr double same = 0.5;  // part of a unit vector that is new: less where a frequency is shared
  const auto n = static_cast<int>(M.rows());
  std::optional<SquaredFrequencies> space = lowest_frequencies(kkt, mass_kkt, n, wanted, between);
  if (!space || many <= wanted) return space;
  const auto wide = lowest_frequencies(kkt, mass_kkt, n, many, between);
  if (!wide) return std::nullopt;
  const auto append = [](auto& list, const auto& more) {
    list.conservativeResize(Eigen::NoChange, list.cols() + 1);
    list.rightCols(1) = more;
  };
  Eigen::RowVectorXd values = space->values.transpose();
  for (Eigen::Index i = 0; i < wide->values.size() && space->shapes.cols() < many; ++i) {
    Vector x = wide->shapes.col(i);
    for (int pass = 0; pass < 2; ++pass) x -= space->shapes * (space->shapes.transpose() * (M * x)).eval();
    const double size = std::sqrt(x.dot(M * x));
    if (!(size > same)) continue;
    append(space->shapes, x / size);
    append(values, Eigen::Matrix<double, 1, 1>(wide->values[i]));
  }
  space->values = values.transpose();
  return space;
}

std::optional<Failure> find_vibrations(int count, const Matrix& kkt, const std::function<void()>& between,
                                       ModesReport& report) {
  const BeamSystem& system = *report.at.system;
  const int n = system.coordinate_count();
  const Matrix mass_kkt = tangent_matrix(system, report.at.state, {.mass = 1});
  const Matrix K = coordinate_block(kkt, n), M = coordinate_block(mass_kkt, n);
  const int most = std::max(0, n - system.constraint_count());
  const BeamModel& model = system.model();
  const bool gyroscopic =
      (model.field && turns(*model.field)) || std::ranges::any_of(model.bodies, has_rotor);
  constexpr int more = 30;  // the space in which gyroscopic forces are
  const int wanted = std::min(count, most);
  auto found =
      wide_space(kkt, mass_kkt, M, wanted, gyroscopic ? std::min(4 * count + more, most) : wanted, between);
  if (!found) return failure_of(Failure::Kind::eigenvalues);
  std::optional<Whirling> whirling;
  if (gyroscopic) {
    whirling = with_gyroscopes(
        *found, coordinate_block(tangent_matrix(system, report.at.state, {.damping = 1}), n), wanted);
    found = whirling->found;
  }
  std::vector<double> round_offs;
  for (Eigen::Index i = 0; i < found->values.size(); ++i) round_offs.push_back(round_off(*found, i, K));
  const std::vector<bool> are_rigid = rigid_motions(*found, round_offs);
  for (Eigen::Index i = 0; i < found->values.size(); ++i) {
    Mode mode;
    mode.shape = found->shapes.col(i);
    const double square = found->values[i];
    mode.round_off = round_offs[i];
    const bool rigid = are_rigid[i];
    if (!rigid && square < 0) return failure_of(Failure::Kind::unstable_state, std::sqrt(-square));
    mode.omega = rigid ? 0 : std::sqrt(square);
    if (whirling && !rigid) mode.whirl = whirl(report.at, mode.shape, whirling->quarter.col(i));
    for (int axis = 0; axis < 3; ++axis)
      mode.participation[axis] = mode.shape.dot(M * translation(system, axis));
    report.modes.push_back(std::move(mode));
  }
  const Vector e = translation(system, 0);
  report.mass = e.dot(M * e);
  return std::nullopt;
}

// Whether a force acts before the loads: the weight of lumps, and forces at guided supports.
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
    const Matrix kkt = tangent_matrix(*report.at.system, report.at.state, {.stiffness = 1});
    report.rest.failure = instability(report.at, kkt);
    if (!report.rest.failure)
      report.rest.failure = buckling ? find_buckling(model->forces, options.count, kkt, between, report)
                                     : find_vibrations(options.count, kkt, between, report);
  } catch (const Interruption&) {
    report.rest.interrupted = true;
  }
  return report;
}

}  // namespace nurbeam
