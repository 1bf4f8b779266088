#include "fem/motion/rest/free_lengths.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fem/mesh/drawn_coordinates.h"
#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"
#include "solver/algebra/equilibrated_kkt.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

bool is_asked(const Connector& connector) { return connector.length_rule != ConnectorLength::given; }

// One condition per asked connector, in an equilibrium: its residual over its size, and its derivatives by
// the free lengths.
struct LengthResiduals {
  std::vector<int> connectors;
  Eigen::VectorXd residual, size;
  Eigen::MatrixXd by_length;
};

template <int D>
class LengthEquations {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  LengthEquations(const BeamSystem& system, const Assembly<D>& a, const State& state)
      : system_(system), a_(a), state_(state), drawn_(state) {
    drawn_.q = drawn_coordinates(*a.model(), a.mesh());
  }

  LengthResiduals conditions() const {
    const std::vector<Connector>& all = a_.model()->connectors;
    LengthResiduals c;
    for (int i = 0; i < static_cast<int>(all.size()); ++i)
      if (is_asked(all[i])) c.connectors.push_back(i);
    const int m = static_cast<int>(c.connectors.size());
    const Eigen::MatrixXd moved = by_lengths(c.connectors);
    c.residual.resize(m);
    c.size.resize(m);
    c.by_length.resize(m, m);
    for (int i = 0; i < m; ++i) {
      const int own = c.connectors[i];
      const Connector& connector = all[own];
      const ConnectorAxis<D> axis = axis_of(own);
      const Vector n0 = axis.line(drawn_).n, n = axis.line(state_).n;
      const auto row_of = [&](const Vector& along, int end) -> Eigen::RowVectorXd {
        const int r = axis.dofs()[end * D];
        if (r < 0) return Eigen::RowVectorXd::Zero(m);
        return along.transpose() * moved.middleRows(r, D);
      };
      if (connector.length_rule == ConnectorLength::as_drawn) {
        const int r = axis.dofs()[0];
        c.residual[i] = n0.dot(state_.q.segment<D>(r) - drawn_.q.segment<D>(r));
        c.size[i] = axis.line(drawn_).length + connector.length;
        c.by_length.row(i) = row_of(n0, 0);
      } else {
        c.residual[i] = length_and_force(system_, state_, own).second - connector.force;
        c.size[i] = std::abs(connector.force) + connector.stiffness * 1e-6 * axis.line(drawn_).length;
        const double k = stiffness_of(own);
        c.by_length.row(i) = k * (row_of(n, 1) - row_of(n, 0));
        c.by_length(i, i) -= k;
      }
    }
    return c;
  }

 private:
  ConnectorAxis<D> axis_of(int i) const {
    return ConnectorAxis<D>(a_.model()->connectors[i], *a_.model(), a_.mesh());
  }

  // Of a connector at its present stretch [N/m].
  double stiffness_of(int i) const {
    const Connector& connector = a_.model()->connectors[i];
    return connector.elastic(axis_of(i).line(state_).length - connector.length).stiffness;
  }

  // (n, connectors) dq/dl_0 of the equilibrium.
  Eigen::MatrixXd by_lengths(const std::vector<int>& connectors) const {
    Eigen::SparseMatrix<double> kkt = tangent_matrix(a_, state_, {.stiffness = 1});
    const int n = a_.coordinate_count();
    const EquilibratedKkt solver(kkt, n);
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(connectors.size()));
    for (std::size_t k = 0; k < connectors.size() && solver.regular(); ++k) {
      const Connector& connector = a_.model()->connectors[connectors[k]];
      Eigen::VectorXd rhs = Eigen::VectorXd::Zero(kkt.rows());
      if (connector.type == ConnectorType::rod)
        rhs[n + *row_of_rod(system_, connectors[k])] = 1;
      else
        axis_of(connectors[k])
            .add_pull(stiffness_of(connectors[k]) * axis_of(connectors[k]).line(state_).n, rhs.head(n));
      moved.col(static_cast<Eigen::Index>(k)) = solver.solve(rhs).head(n);
    }
    return moved;
  }

  const BeamSystem& system_;
  const Assembly<D>& a_;
  const State& state_;
  State drawn_;
};

LengthResiduals conditions_of(const BeamSystem& system, const State& state) {
  return with_assembly(
      system, [&]<int D>(const Assembly<D>& a) { return LengthEquations<D>(system, a, state).conditions(); });
}

// The model with springs for asked connectors of one sign.
std::shared_ptr<BeamModel> two_sided(const BeamModel& model) {
  auto free = std::make_shared<BeamModel>(model);
  for (Connector& connector : free->connectors)
    if (is_asked(connector) && connector.type != ConnectorType::rod) connector.type = ConnectorType::spring;
  return free;
}

std::vector<double> lengths_of(const BeamModel& model) {
  std::vector<double> lengths;
  for (const Connector& connector : model.connectors) lengths.push_back(connector.length);
  return lengths;
}

// The first connector whose force would have the wrong sign.
std::optional<Failure> wrong_sign(const BeamModel& model, const MeshedState& at) {
  for (int i = 0; i < static_cast<int>(model.connectors.size()); ++i) {
    const Connector& connector = model.connectors[i];
    const bool tension = connector.type == ConnectorType::tension_only;
    if (!is_asked(connector) || !(tension || connector.type == ConnectorType::compression_only)) continue;
    const auto [length, force] = length_and_force(*at.system, at.state, i);
    const double none = 1e-9 * connector.stiffness * length;
    if ((tension ? -force : force) > none)
      return Failure{
          .kind = Failure::Kind::wrong_sign, .time = at.state.t, .connector = i, .force = std::abs(force)};
  }
  return std::nullopt;
}

void add_cost(const RestReport& part, RestReport& sum) {
  sum.load_steps += part.load_steps;
  sum.newton_iterations += part.newton_iterations;
  sum.failure = part.failure;
  sum.interrupted = part.interrupted;
}

}  // namespace

bool asks_for_lengths(const BeamModel& model) {
  return std::any_of(model.connectors.begin(), model.connectors.end(), is_asked);
}

std::shared_ptr<const BeamModel> with_lengths(const BeamModel& model, const std::vector<double>& lengths) {
  auto found = std::make_shared<BeamModel>(model);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    found->connectors[i].length = lengths[i];
    found->connectors[i].length_rule = ConnectorLength::given;
  }
  return found;
}

RestReport find_free_lengths(MeshedState& at, const std::function<bool()>& interrupted) {
  const BeamModel& asked = at.system->model();
  const std::shared_ptr<const BeamModel> original = at.system->shared_model();
  const MeshPlan plan = at.system->mesh().plan;
  const std::vector<bool> held(asked.riders.size(), true);
  std::shared_ptr<BeamModel> model = two_sided(*original);
  RestReport report;
  constexpr int most_steps = 30;
  constexpr double exact = 1e-12, good = 1e-8;
  double last = 0;
  for (int step = 0;; ++step) {
    at.system = std::make_unique<BeamSystem>(model, plan, held);
    add_cost(find_held_equilibrium(at, interrupted), report);
    if (report.failure || report.interrupted) return report;
    const LengthResiduals c = conditions_of(*at.system, at.state);
    const double error = c.residual.cwiseQuotient(c.size).lpNorm<Eigen::Infinity>();
    if (error <= exact || (step > 0 && error <= good && error > last / 2)) break;
    const Eigen::FullPivLU<Eigen::MatrixXd> solver(c.by_length);
    if (step == most_steps || !solver.isInvertible()) {
      report.failure = Failure{.kind = Failure::Kind::free_lengths, .time = at.state.t};
      return report;
    }
    const Eigen::VectorXd change = solver.solve(-c.residual);
    model = std::make_shared<BeamModel>(*model);
    for (std::size_t k = 0; k < c.connectors.size(); ++k)
      model->connectors[c.connectors[k]].length += change[static_cast<Eigen::Index>(k)];
    last = error;
  }
  report.failure = wrong_sign(*original, at);
  if (report.failure) return report;
  at.system = std::make_unique<BeamSystem>(with_lengths(*original, lengths_of(*model)), plan, held);
  return report;
}

}  // namespace nurbeam
