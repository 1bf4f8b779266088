#include "fem/sensitivity/residual_differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "fem/element/element_batch.h"
#include "fem/system/with_assembly.h"
#include "solver/side_by_side.h"

namespace nurbeam {

namespace {

// Shapes, velocities and accelerations to which sections that are not the same answer differently: nodes have
// nothing to do with each other, and one of the three outweighs all else.
std::vector<State> uneven_states(const BeamSystem& system, const State& near) {
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

// A state at a time that is `later`, with shifted coordinates, times `part`.
State shifted(const State& at, double part, double later, const std::vector<ResidualDifferences::Shift>& by) {
  State state = at;
  state.t += part * later;
  for (const auto& [coordinate, shift] : by) state.q[coordinate] += part * shift;
  return state;
}

// What loads look at.
State at_time(const State& at, double later) {
  State state;
  state.t = at.t + later;
  state.load = at.load;
  return state;
}

}  // namespace

struct ResidualDifferences::Implementation {
  virtual ~Implementation() = default;
  virtual void find(const State& at, const Eigen::RowVectorXd& later,
                    const std::vector<std::vector<Shift>>& shifts, Columns& dynamics,
                    Columns& constraints) = 0;
  double work = 0;
};

template <int D>
struct ResidualDifferences::In final : Implementation {
  using Vector = Eigen::Matrix<double, D, 1>;

  // The elements of one beam that differ in a pair, on the two sides; those that are one with others of their
  // kind are in a group's batches, the indices of the rest here.
  struct Side {
    const Assembly<D>* assembly = nullptr;
    std::vector<int> apart = {};
  };
  struct Sides {
    Side more, less;
    double step = 0;
    std::vector<int> groups = {};
    std::vector<int> coordinates = {};  // of the elements in batches
    bool carries_point = false;         // a body moves over an element that differs
    bool was_whole = true;              // the last columns that were found may not be zero elsewhere
    // Whether no more differs than these: at the same coordinates, and at shifted ones.
    std::array<std::optional<bool>, 2> is_local = {};
  };
  // Elements of all pairs that are made of the same, under one load: that of the beam in one of the systems.
  struct Group {
    const Assembly<D>* of;
    int beam;
    std::vector<ElementBatch<D>> batches = {};
    Vector load = Vector::Zero();  // at present
    double free_strain = 0;
  };

  std::vector<Sides> pairs;
  std::vector<Group> groups;
  Eigen::MatrixXd forces;  // more and less of each pair, a column each; zero between calls of find
  Eigen::VectorXd more_constraints, less_constraints;
  State general;  // to which what is not the same answers differently

  In(const std::vector<Pair>& of, const State& near)
      : forces(near.q.size(), 2 * static_cast<Eigen::Index>(of.size())),
        more_constraints(near.lambda.size()),
        less_constraints(near.lambda.size()) {
    if (of.empty()) return;
    forces.setZero();
    const std::vector<State> states = uneven_states(*of.front().more, near);
    general = states.front();  // bent, and driven as fast as what is bent answers
    general.a = states.back().a / states.back().a.template lpNorm<Eigen::Infinity>();
    std::vector<std::vector<bool>> elements(of.size());  // that are unlike, of each pair
    side_by_side(static_cast<int>(of.size()), [&](int k) {
      const auto& [more, less, step] = of[static_cast<std::size_t>(k)];
      elements[static_cast<std::size_t>(k)] =
          more->template assembly<D>()->elements_unlike(*less->template assembly<D>(), states);
    });
    for (const auto& [more, less, step] : of) {
      const std::vector<bool>& unlike = elements[pairs.size()];
      Sides& pair = pairs.emplace_back();
      pair.more.assembly = more->template assembly<D>();
      pair.less.assembly = less->template assembly<D>();
      pair.step = step;
      work += 2 * static_cast<double>(std::count(unlike.begin(), unlike.end(), true)) /
              std::max<double>(1, static_cast<double>(unlike.size()));
      for (std::size_t i = 0; i < unlike.size(); ++i)
        if (unlike[i])
          for (Side* side : {&pair.more, &pair.less}) add(pair, *side, static_cast<int>(i));
      pair.carries_point = carries_point(*pair.more.assembly, unlike, near);
      std::sort(pair.coordinates.begin(), pair.coordinates.end());
      pair.coordinates.erase(std::unique(pair.coordinates.begin(), pair.coordinates.end()),
                             pair.coordinates.end());
    }
  }

  // Whether a body is a point of one of these elements, wherever on it, or runs on a guide.
  static bool carries_point(const Assembly<D>& assembly, const std::vector<bool>& elements,
                            const State& near) {
    const Mesh& mesh = assembly.mesh();
    for (std::size_t j = 0; j < mesh.joints.size(); ++j) {
      const JointMode mode = mesh.plan.modes[j];
      if (mode == JointMode::node || mode == JointMode::free) continue;
      const int beam = assembly.model()->joints[j].beam;
      if (assembly.model()->beams[beam].rigid) return true;
      if (elements[find_span(*assembly.model(), mesh, near.q, beam, mesh.plan.places[j])]) return true;
    }
    return false;
  }

  void add(Sides& pair, Side& side, int i) {
    const MeshElement<D>& e = side.assembly->elements()[i];
    if (e.twist || !ElementBatch<D>::takes(e.element)) return side.apart.push_back(i);
    std::copy_if(e.dofs.begin(), e.dofs.end(), std::back_inserter(pair.coordinates),
                 [](int dof) { return dof >= 0; });
    const int g = group_of(*side.assembly, e);
    if (pair.groups.empty() || pair.groups.back() != g) pair.groups.push_back(g);
    std::vector<ElementBatch<D>>& batches = groups[g].batches;
    if (batches.empty() || batches.back().is_full()) batches.emplace_back(e.element.properties());
    const std::ptrdiff_t column = 2 * (&pair - pairs.data()) + (&side == &pair.less ? 1 : 0);
    batches.back().add(e.element, e.dofs, e.slope_offset, column * forces.rows());
  }

  int group_of(const Assembly<D>& assembly, const MeshElement<D>& e) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& each) {
      return each.beam == e.beam &&
             each.of->model()->beams[e.beam].properties == assembly.model()->beams[e.beam].properties;
    });
    if (group != groups.end()) return static_cast<int>(group - groups.begin());
    groups.push_back({&assembly, e.beam});
    return static_cast<int>(groups.size()) - 1;
  }

  // Whether the elements that are alike in a pair have the same loads on both sides, and those of its groups
  // the loads of these.
  bool same_loads(const Sides& pair, const State& above, const State& below) const {
    const auto loads_are = [&](int beam, const Vector& load, double strain) {
      return pair.more.assembly->line_load(beam, above) == load &&
             pair.less.assembly->line_load(beam, below) == load &&
             pair.more.assembly->free_strain_of(beam, above) == strain &&
             pair.less.assembly->free_strain_of(beam, below) == strain;
    };
    const BeamModel& model = *pair.more.assembly->model();
    for (int b = 0; b < static_cast<int>(model.beams.size()); ++b)
      if (!model.beams[b].rigid && !loads_are(b, pair.more.assembly->line_load(b, above),
                                              pair.more.assembly->free_strain_of(b, above)))
        return false;
    return std::all_of(pair.groups.begin(), pair.groups.end(), [&](int g) {
      return loads_are(groups[g].beam, groups[g].load, groups[g].free_strain);
    });
  }

  // Whether no more differs than elements in batches, between shifted coordinates.
  bool is_local(Sides& pair, const std::vector<Shift>& shifts) const {
    if (!pair.more.apart.empty() || pair.carries_point) return false;
    std::optional<bool>& known = pair.is_local[shifts.empty() ? 0 : 1];
    if (!known)
      known =
          pair.more.assembly->differs_in_elements(*pair.less.assembly, shifted(general, pair.step, 0, shifts),
                                                  shifted(general, -pair.step, 0, shifts));
    return *known;
  }

  void find(const State& at, const Eigen::RowVectorXd& later, const std::vector<std::vector<Shift>>& shifts,
            Columns& dynamics, Columns& constraints) override {
    for (Group& group : groups) {
      group.load = group.of->line_load(group.beam, at);
      group.free_strain = group.of->free_strain_of(group.beam, at);
      for (const ElementBatch<D>& batch : group.batches)
        batch.add_forces(at, group.load, group.free_strain, forces.data());
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      Sides& pair = pairs[k];
      if (is_local(pair, shifts[k]) &&
          same_loads(pair, at_time(at, pair.step * later[column]), at_time(at, -pair.step * later[column]))) {
        if (pair.was_whole) {
          dynamics.col(column).setZero();
          constraints.col(column).setZero();
        }
        pair.was_whole = !shifts[k].empty();  // what is due to these is taken off
        for (const int i : pair.coordinates) {
          dynamics(i, column) = (forces(i, 2 * column) - forces(i, 2 * column + 1)) / (2 * pair.step);
          forces(i, 2 * column) = forces(i, 2 * column + 1) = 0;
        }
        continue;
      }
      const bool moves = later[column] != 0 || !shifts[k].empty();
      const State above = moves ? shifted(at, pair.step, later[column], shifts[k]) : State{},
                  below = moves ? shifted(at, -pair.step, later[column], shifts[k]) : State{};
      evaluate(pair, moves ? above : at, moves ? below : at, column);
      constraints.col(column) = (more_constraints - less_constraints) / (2 * pair.step);
      dynamics.col(column) = (forces.col(2 * column) - forces.col(2 * column + 1)) / (2 * pair.step);
      forces.middleCols(2 * column, 2).setZero();
      pair.was_whole = true;
    }
  }

  // Completes the forces of a pair, and finds its constraints.
  void evaluate(const Sides& pair, const State& above, const State& below, Eigen::Index column) {
    auto more = forces.col(2 * column), less = forces.col(2 * column + 1);
    if (same_loads(pair, above, below)) {
      pair.more.assembly->add_residual_of(pair.more.apart, above, more, more_constraints);
      pair.less.assembly->add_residual_of(pair.less.apart, below, less, less_constraints);
    } else {
      pair.more.assembly->residual(above, more, more_constraints);
      pair.less.assembly->residual(below, less, less_constraints);
    }
  }
};

ResidualDifferences::ResidualDifferences(const std::vector<Pair>& pairs, const State& near) {
  if (!pairs.empty() && pairs.front().more->dimension() == 2)
    in_ = std::make_unique<In<2>>(pairs, near);
  else
    in_ = std::make_unique<In<3>>(pairs, near);
}

ResidualDifferences::~ResidualDifferences() = default;
ResidualDifferences::ResidualDifferences(ResidualDifferences&&) noexcept = default;
ResidualDifferences& ResidualDifferences::operator=(ResidualDifferences&&) noexcept = default;

void ResidualDifferences::find(const State& at, const Eigen::RowVectorXd& later,
                               const std::vector<std::vector<Shift>>& shifts, Columns& dynamics,
                               Columns& constraints) {
  in_->find(at, later, shifts, dynamics, constraints);
}

double ResidualDifferences::work() const { return in_->work; }

}  // namespace nurbeam
