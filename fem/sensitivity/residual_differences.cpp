#include "fem/sensitivity/residual_differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "fem/sensitivity/column_batches.h"
#include "fem/sensitivity/differing_pair.h"
#include "fem/sensitivity/number_adjoint.h"
#include "fem/system/with_assembly.h"
#include "solver/algebra/side_by_side.h"

namespace nurbeam {

namespace {

// States of shape, velocity and acceleration in which unequal sections respond differently: nodes are
// independent of each other, and one of the three outweighs all else.
std::vector<State> uneven_states(const SecondOrderSystem& system, const State& near) {
  constexpr double strain = 1e-4, speed = 1e6, acceleration = 1e9;
  State still = near;
  still.v.setZero();
  still.a.setZero();
  State bent = still, moving = still, driven = still;
  const Eigen::VectorXd scale = system.coordinate_scale();
  for (Eigen::Index i = 0; i < near.lambda.size(); ++i)
    bent.lambda[i] = std::cos(1.9 * static_cast<double>(i) + 0.2);
  for (Eigen::Index i = 0; i < near.q.size(); ++i) {
    const auto k = static_cast<double>(i);
    bent.q[i] += strain * scale[i] * std::sin(1.7 * k + 0.3);
    moving.v[i] = speed * std::cos(2.3 * k + 0.1);
    driven.a[i] = acceleration * std::sin(3.1 * k + 0.7);
  }
  return {bent, moving, driven};
}

// Sets `state` to `at`, later by part x `later`, with coordinates shifted by part x shift.
void shift(const State& at, double part, double later, const std::vector<ResidualDifferences::Shift>& shifts,
           State& state) {
  state = at;
  state.t += part * later;
  for (const auto& [coordinate, by] : shifts) state.q[coordinate] += part * by;
}

State shifted(const State& at, double part, const std::vector<ResidualDifferences::Shift>& shifts) {
  State state;
  shift(at, part, 0, shifts, state);
  return state;
}

// A state with the time and load factor that loads depend on.
State at_time(const State& at, double later) {
  State state;
  state.t = at.t + later;
  state.load = at.load;
  return state;
}

}  // namespace

struct ResidualDifferences::Implementation {
  using Columns = ResidualDifferences::Columns;
  virtual ~Implementation() = default;
  virtual void find(const State& at, const Eigen::RowVectorXd& later,
                    const std::vector<std::vector<Shift>>& shifts, Columns& dynamics,
                    Columns& constraints) = 0;
  virtual void go_back(const BeamSystem& system, const State& at,
                       const std::vector<std::vector<Shift>>& shifts, Eigen::Index sums) = 0;
  virtual bool are_all_in_sums() const = 0;
  virtual void add(const State& at, const Columns& multipliers) = 0;
  virtual Columns sums() const = 0;
  virtual std::vector<bool> outlast(const State& at, const std::vector<std::vector<Shift>>& shifts,
                                    const std::vector<int>& elements) = 0;
  virtual Columns momenta(const Eigen::VectorXd& velocities) const = 0;
  virtual Eigen::RowVectorXd energies(const State& at) const = 0;
  double work = 0;
};

template <int D>
struct ResidualDifferences::In final : Implementation {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Sides = DifferingPair<D>;
  using Different = typename Sides::Different;
  using Apart = typename Sides::Apart;
  std::vector<Sides> pairs;
  ColumnBatches<D> batches;
  std::optional<NumberAdjoint<D>> adjoint;
  Columns forces;  // more and less of each pair, a column each; zero between calls of find
  Eigen::VectorXd more_dynamics, less_dynamics, more_constraints, less_constraints;  // of a whole pair
  State general;                 // state in which unequal elements respond differently
  State moved_more, moved_less;  // room for the shifted states of find()

  // Data of pairs that outlast a change of the mesh.
  struct Before {
    const In* of;
    const std::vector<bool>* outlasting;
    const Assembly<D>* system;  // after the change
    const std::vector<int>* elements;
  };

  In(const std::vector<Pair>& of, const State& near, const std::optional<Before>& before = {})
      : forces(near.q.size(), 2 * static_cast<Eigen::Index>(of.size())),
        more_constraints(near.lambda.size()),
        less_constraints(near.lambda.size()) {
    if (of.empty()) return;
    forces.setZero();
    const auto outlasts = [&](std::size_t k) { return before && (*before->outlasting)[k]; };
    const std::vector<State> states =
        before ? uneven_states(*before->system, near) : uneven_states(*of.front().more, near);
    general = states.front();  // bent, and driven as fast as a bent shape responds
    general.a = states.back().a / states.back().a.template lpNorm<Eigen::Infinity>();
    std::vector<std::vector<bool>> unlike(of.size());  // per pair: its elements that differ
    side_by_side(static_cast<int>(of.size()), [&](int k) {
      const auto& [more, less, step] = of[static_cast<std::size_t>(k)];
      if (outlasts(static_cast<std::size_t>(k))) return;
      const Assembly<D>&own = *more->template assembly<D>(), &other = *less->template assembly<D>();
      std::vector<std::optional<bool>> known;
      if (before)
        known = before->of->pairs[static_cast<std::size_t>(k)].known_unlike(*before->elements,
                                                                            own.elements().size());
      unlike[static_cast<std::size_t>(k)] = own.elements_unlike(other, states, known);
    });
    for (std::size_t k = 0; k < of.size(); ++k)
      pairs.push_back(outlasts(k) ? before->of->pairs[k].behind(*before->elements)
                                  : Sides::of(of[k], unlike[k], near));
    set_batches(before ? *before->system : *pairs.front().more);
  }

  // Sets up the batches, with the elements of all pairs that are not in sums.
  void set_batches(const Assembly<D>& present) {
    batches = {};
    work = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (pairs[k].is_in_sums) continue;
      add(pairs[k], static_cast<Eigen::Index>(k), present);
      work += pairs[k].work;
    }
    batches.close(present);
  }

  // Adds the elements of a pair to the batches, and finds its coordinates and loads.
  void add(Sides& pair, Eigen::Index k, const Assembly<D>& present) {
    pair.loads.clear();
    pair.coordinates.clear();
    for (auto& [index, now, dofs] : pair.batched) {
      dofs = present.elements()[now].dofs;
      std::copy_if(dofs.begin(), dofs.end(), std::back_inserter(pair.coordinates),
                   [](int dof) { return dof >= 0; });
      for (const Assembly<D>* side : {pair.more, pair.less}) {
        const int load =
            batches.add(*side, side->elements()[index], now, 2 * k + (side == pair.less ? 1 : 0));
        if (pair.loads.empty() || pair.loads.back() != load) pair.loads.push_back(load);
      }
    }
    std::sort(pair.coordinates.begin(), pair.coordinates.end());
    pair.coordinates.erase(std::unique(pair.coordinates.begin(), pair.coordinates.end()),
                           pair.coordinates.end());
  }

  // Whether the loads on both sides of a pair are equal: for all beams, and for the elements in batches.
  bool same_loads(const Sides& pair, const State& above, const State& below) const {
    const auto loads_are = [&](int beam, const Vector& load, double strain) {
      return pair.more->line_load(beam, above) == load && pair.less->line_load(beam, below) == load &&
             pair.more->free_strain_of(beam, above) == strain &&
             pair.less->free_strain_of(beam, below) == strain;
    };
    const BeamModel& model = *pair.more->model();
    for (int b = 0; b < static_cast<int>(model.beams.size()); ++b)
      if (!model.beams[b].rigid &&
          !loads_are(b, pair.more->line_load(b, above), pair.more->free_strain_of(b, above)))
        return false;
    return std::all_of(pair.loads.begin(), pair.loads.end(), [&](int index) {
      const auto& [beam, load, free_strain] = batches.load(index);
      return loads_are(beam, load, free_strain);
    });
  }

  // Whether a pair differs only in elements in batches, with shifted coordinates.
  bool is_local(Sides& pair, const std::vector<Shift>& shifts) const {
    if (!pair.apart.empty() || pair.carries_point) return false;
    std::optional<bool>& known = pair.is_local[shifts.empty() ? 0 : 1];
    if (!known)
      known = pair.more->differs_in_elements(*pair.less, shifted(general, pair.step, shifts),
                                             shifted(general, -pair.step, shifts));
    return *known;
  }

  std::vector<bool> outlast(const State& at, const std::vector<std::vector<Shift>>& shifts,
                            const std::vector<int>& elements) override {
    batches.set_loads(at);
    std::vector<bool> all;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      all.push_back(std::all_of(pairs[k].batched.begin(), pairs[k].batched.end(),
                                [&](const Different& each) { return elements[each.now] >= 0; }) &&
                    is_local(pairs[k], shifts[k]) && same_loads(pairs[k], at, at) &&
                    pairs[k].has_same_free_strains());
    return all;
  }

  void go_back(const BeamSystem& system, const State& at, const std::vector<std::vector<Shift>>& shifts,
               Eigen::Index sums) override {
    const Assembly<D>& present = *system.assembly<D>();
    batches.set_loads(at);
    std::set<int> elements;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      Sides& pair = pairs[k];
      pair.is_in_sums =
          shifts[k].empty() && is_local(pair, shifts[k]) && pair.has_other_numbers_alone(present);
      pair.was_whole = true;
      if (!pair.is_in_sums) continue;
      for (const Different& each : pair.batched) elements.insert(each.now);
    }
    adjoint.emplace(present, std::vector<int>(elements.begin(), elements.end()), sums);
    set_batches(present);
    constexpr double of_numbers = 3;  // relative to the forces of an element
    work += of_numbers * static_cast<double>(sums) * static_cast<double>(elements.size()) /
            static_cast<double>(present.elements().size());
  }

  bool are_all_in_sums() const override {
    return std::all_of(
        pairs.begin(), pairs.end(), [](const Sides& pair) { return pair.is_in_sums; });
  }

  void add(const State& at, const Columns& multipliers) override { adjoint->add(at, multipliers); }

  Columns sums() const override {
    Columns sums = Columns::Zero(adjoint->sums(), static_cast<Eigen::Index>(pairs.size()));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (!pairs[k].is_in_sums) continue;
      for (const Different& each : pairs[k].batched)
        for (Eigen::Index i = 0; i < sums.rows(); ++i)
          sums(i, static_cast<Eigen::Index>(k)) +=
              adjoint->difference(i, each.now, pairs[k].more->elements()[each.index].element,
                                  pairs[k].less->elements()[each.index].element) /
              (2 * pairs[k].step);
    }
    return sums;
  }

  Columns momenta(const Eigen::VectorXd& velocities) const override {
    Columns momenta = Columns::Zero(velocities.size(), static_cast<Eigen::Index>(pairs.size()));
    for (std::size_t k = 0; k < pairs.size(); ++k)
      for (const auto& [index, now, dofs] : pairs[k].batched) {
        if (!pairs[k].outlasts) break;
        ElementVector<D> rates = ElementVector<D>::Zero();
        for (int i = 0; i < ElementLayout<D>::nodal; ++i) rates[i] = velocities[dofs[i]];
        const ElementNodes<D> of_nodes = ElementLayout<D>::nodes(rates),
                              change = pairs[k].more->elements()[index].element.nodal_momentum(of_nodes) -
                                       pairs[k].less->elements()[index].element.nodal_momentum(of_nodes);
        for (int i = 0; i < ElementLayout<D>::nodal; ++i)
          momenta(dofs[i], static_cast<Eigen::Index>(k)) += change.reshaped()[i] / (2 * pairs[k].step);
      }
    return momenta;
  }

  Eigen::RowVectorXd energies(const State& at) const override {
    Eigen::RowVectorXd energies = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(pairs.size()));
    batches.energies(at, [&](Eigen::Index column, double energy) {
      energies[column / 2] +=
          (column % 2 == 0 ? 1 : -1) * energy / (2 * pairs[static_cast<std::size_t>(column / 2)].step);
    });
    return energies;
  }

  void find(const State& at, const Eigen::RowVectorXd& later, const std::vector<std::vector<Shift>>& shifts,
            Columns& dynamics, Columns& constraints) override {
    batches.set_loads(at);
    batches.add_forces(at, forces);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      Sides& pair = pairs[k];
      if (pair.is_in_sums) {
        if (!std::exchange(pair.was_whole, false)) continue;
        dynamics.col(column).setZero();
        constraints.col(column).setZero();
        continue;
      }
      if (is_local(pair, shifts[k]) &&
          same_loads(pair, at_time(at, pair.step * later[column]), at_time(at, -pair.step * later[column]))) {
        if (pair.was_whole) {
          dynamics.col(column).setZero();
          constraints.col(column).setZero();
        }
        pair.was_whole = !shifts[k].empty();  // the part due to the shifts is taken off
        const double over = 2 * pair.step;
        for (const int i : pair.coordinates) {
          double* const both = &forces(i, 2 * column);
          dynamics(i, column) = (both[0] - both[1]) / over;
          both[0] = both[1] = 0;
        }
        continue;
      }
      const bool moves = later[column] != 0 || !shifts[k].empty();
      if (moves) {
        shift(at, pair.step, later[column], shifts[k], moved_more);
        shift(at, -pair.step, later[column], shifts[k], moved_less);
      }
      evaluate(pair, moves ? moved_more : at, moves ? moved_less : at, column);
      constraints.col(column) = (more_constraints - less_constraints) / (2 * pair.step);
      dynamics.col(column) = (more_dynamics - less_dynamics) / (2 * pair.step);
      forces.middleCols(2 * column, 2).setZero();
      pair.was_whole = true;
    }
  }

  // Completes the forces of a pair, and finds its constraints.
  void evaluate(Sides& pair, const State& above, const State& below, Eigen::Index column) {
    more_dynamics = forces.col(2 * column);
    less_dynamics = forces.col(2 * column + 1);
    if (same_loads(pair, above, below)) {
      add_apart(pair, *pair.more, above, 0, more_dynamics, more_constraints);
      add_apart(pair, *pair.less, below, 1, less_dynamics, less_constraints);
    } else {
      pair.more->residual(above, more_dynamics, more_constraints);
      pair.less->residual(below, less_dynamics, less_constraints);
    }
  }

  // Adds the elements in no batch, on one side. Their points are reused where their ends have not moved.
  static void add_apart(Sides& pair, const Assembly<D>& of, const State& state, std::size_t side,
                        Eigen::Ref<Eigen::VectorXd> dynamics, Eigen::Ref<Eigen::VectorXd> constraints) {
    using Layout = ElementLayout<D>;
    std::vector<int> others;
    for (Apart& apart : pair.apart) {
      const MeshElement<D>& e = of.elements()[apart.index];
      if (e.element.fixed() || e.twist || of.is_form_p(e)) {
        others.push_back(apart.index);
        continue;
      }
      const ElementState<D> x = gather<D>(e, state);
      auto& points = apart.points[side];
      if (!points || points->ends != std::array{x.q[Layout::place(0)], x.q[Layout::place(1)]})
        points = e.element.points(x.q);
      const ElementVector<D> f = e.element.force(x, of.line_load(e.span->beam, state), *points);
      for (int k = 0; k < element_size<D>; ++k)
        if (e.dofs[k] >= 0) dynamics[e.dofs[k]] += f[k];
    }
    of.add_residual_of(others, state, dynamics, constraints);
  }
};

ResidualDifferences::ResidualDifferences(const std::vector<Pair>& pairs, const State& near) {
  if (!pairs.empty() && pairs.front().more->dimension() == 2)
    in_ = std::make_unique<In<2>>(pairs, near);
  else
    in_ = std::make_unique<In<3>>(pairs, near);
}

ResidualDifferences::ResidualDifferences(const std::vector<Pair>& pairs, const State& near,
                                         const ResidualDifferences& before,
                                         const std::vector<bool>& outlasting, const BeamSystem& system,
                                         const std::vector<int>& elements) {
  with_assembly(
      system,
      [&]<int D>(const Assembly<D>& assembly) {
        const In<D>& was = dynamic_cast<const In<D>&>(*before.in_);
        in_ = std::make_unique<In<D>>(pairs, near,
                                      typename In<D>::Before{&was, &outlasting, &assembly, &elements});
      });
}

ResidualDifferences::~ResidualDifferences() = default;
ResidualDifferences::ResidualDifferences(ResidualDifferences&&) noexcept = default;
ResidualDifferences& ResidualDifferences::operator=(ResidualDifferences&&) noexcept = default;

void ResidualDifferences::find(const BeamSystem& system, const State& at, const Eigen::RowVectorXd& later,
                               const std::vector<std::vector<Shift>>& shifts, Columns& dynamics,
                               Columns& constraints) {
  State held = at;
  held.sides = with_assembly(system, [&](const auto& assembly) { return assembly.sides(at); });
  in_->find(held, later, shifts, dynamics, constraints);
}

void ResidualDifferences::go_back(const BeamSystem& system, const State& at,
                                  const std::vector<std::vector<Shift>>& shifts, Eigen::Index sums) {
  in_->go_back(system, at, shifts, sums);
}

bool ResidualDifferences::are_all_in_sums() const { return in_->are_all_in_sums(); }

void ResidualDifferences::add(const State& at, const Columns& multipliers) { in_->add(at, multipliers); }

ResidualDifferences::Columns ResidualDifferences::sums() const { return in_->sums(); }

std::vector<bool> ResidualDifferences::outlast(const State& at, const std::vector<std::vector<Shift>>& shifts,
                                               const std::vector<int>& elements) {
  return in_->outlast(at, shifts, elements);
}

ResidualDifferences::Columns ResidualDifferences::momenta(const Eigen::VectorXd& velocities) const {
  return in_->momenta(velocities);
}

Eigen::RowVectorXd ResidualDifferences::energies(const State& at) const { return in_->energies(at); }

double ResidualDifferences::work() const { return in_->work; }

}  // namespace nurbeam
