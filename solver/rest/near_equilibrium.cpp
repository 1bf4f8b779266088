#include "solver/rest/near_equilibrium.h"

#include <algorithm>
#include <limits>
#include <span>

#include "solver/algebra/side_by_side.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;
using Columns = KktSolver::Columns;

// (n + m) Rows of the residual.
Vector residual(const SecondOrderSystem& system, const State& state) {
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  Vector rows(n + m);
  system.residual(state, rows.head(n), rows.tail(m));
  return rows;
}

// Largest correction of a coordinate, over its scale.
double size_of(const SecondOrderSystem& system, const Vector& correction) {
  const Vector scale = system.coordinate_scale();
  return correction.head(scale.size()).cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
}

void take_off(const Vector& correction, State& state) {
  state.q -= correction.head(state.q.size());
  state.lambda -= correction.tail(state.lambda.size());
}

// One rest on its way to its equilibrium, with factors of a tangent near its own.
class Settling {
 public:
  explicit Settling(const NearRest& rest) : rest_(rest) {}

  bool is_on_its_way() const { return stage_ == Stage::on_its_way; }
  bool is_there() const { return stage_ == Stage::there; }
  /// The size of the last correction.
  double last() const { return last_; }
  Vector open() const { return residual(*rest_.system, *rest_.state); }

  void correct(const Vector& correction) {
    constexpr double slow = 0.2, little = 1e-12, rounding = 1e-16;
    const double size = size_of(*rest_.system, correction), contraction = size / last_;
    if (!(contraction < slow)) {
      stage_ = last_ < little ? Stage::there : Stage::astray;
      return;
    }
    take_off(correction, *rest_.state);
    last_ = size;
    if (size == 0 || (contraction > 0 && size * contraction < rounding)) stage_ = Stage::there;
    if (!rest_.system->admissible(*rest_.state)) stage_ = Stage::astray;
  }

 private:
  enum class Stage { on_its_way, there, astray };

  NearRest rest_;
  Stage stage_ = Stage::on_its_way;
  double last_ = std::numeric_limits<double>::infinity();
};

// Settles one rest with factors of its own tangent, renewed when corrections become slow.
bool settle_alone(const NearRest& rest) {
  constexpr double close = 1e-6;
  constexpr int most_tangents = 6;
  Eigen::SparseMatrix<double> tangent = rest.system->tangent_pattern().matrix();
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_tangents && rest.system->admissible(*rest.state); ++i) {
    rest.system->tangent(*rest.state, {.stiffness = 1}, tangent);
    const EquilibratedKkt kkt(tangent, rest.system->coordinate_count());
    if (!kkt.regular()) return false;
    Settling settling(rest);
    while (settling.is_on_its_way()) settling.correct(kkt.solve(settling.open()));
    if (settling.is_there()) return true;
    if (!(settling.last() < before / 2)) break;
    before = settling.last();
  }
  return before < close;
}

// Settles the rests whose corrections do not become slow.
void settle_together(std::span<Settling> all, const EquilibratedKkt& near) {
  std::vector<Settling*> moving;
  const auto of_moving = [&](const auto& work) {
    side_by_side(static_cast<int>(moving.size()),
                 [&](int k) { work(k, *moving[static_cast<std::size_t>(k)]); });
  };
  Columns columns;
  for (;;) {
    moving.clear();
    for (Settling& each : all)
      if (each.is_on_its_way()) moving.push_back(&each);
    if (moving.empty()) return;
    columns.resize(near.size(), static_cast<Eigen::Index>(moving.size()));
    of_moving([&](int k, const Settling& each) { columns.col(k) = each.open(); });
    columns = near.solutions(columns);
    of_moving([&](int k, Settling& each) { each.correct(columns.col(k)); });
  }
}

}  // namespace

bool settle_near(const std::vector<NearRest>& rests, const EquilibratedKkt& near) {
  std::vector<Settling> all(rests.begin(), rests.end());
  // If the factors do not serve the first rest, they hardly serve the others.
  const std::span<Settling> first(all.data(), std::min<std::size_t>(all.size(), 1));
  settle_together(first, near);
  if (std::all_of(first.begin(), first.end(), [](const Settling& each) { return each.is_there(); }))
    settle_together(all, near);
  std::vector<char> is_there(all.size());
  side_by_side(
      static_cast<int>(all.size()),
      [&](int k) {
        const auto i = static_cast<std::size_t>(k);
        is_there[i] = all[i].is_there() || settle_alone(rests[i]);
      });
  return std::all_of(is_there.begin(), is_there.end(), [](char each) { return each != 0; });
}

}  // namespace nurbeam
