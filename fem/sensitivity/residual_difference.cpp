#include "fem/sensitivity/residual_difference.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

// Shapes, velocities and accelerations to which elements that are not the same answer differently: nodes have
// nothing to do with each other, and one of the three outweighs all else.
std::vector<State> uneven_states(const BeamSystem& system, const State& near) {
  constexpr double strain = 1e-4, speed = 1e6, acceleration = 1e9;
  State still = near;
  still.v.setZero();
  still.a.setZero();
  State bent = still, moving = still, driven = still;
  const Eigen::VectorXd scale = system.coordinate_scale();
  for (Eigen::Index i = 0; i < near.q.size(); ++i) {
    const auto k = static_cast<double>(i);
    bent.q[i] += strain * scale[i] * std::sin(1.7 * k + 0.3);
    moving.v[i] = speed * std::cos(2.3 * k + 0.1);
    driven.a[i] = acceleration * std::sin(3.1 * k + 0.7);
  }
  return {bent, moving, driven};
}

// visit(more, less) with the assemblies of their dimension.
template <class Visit>
void with_assemblies(const BeamSystem& more, const BeamSystem& less, Visit&& visit) {
  if (more.dimension() == 2)
    visit(*more.assembly<2>(), *less.assembly<2>());
  else
    visit(*more.assembly<3>(), *less.assembly<3>());
}

}  // namespace

ResidualDifference::ResidualDifference(const BeamSystem& more, const BeamSystem& less, const State& near)
    : more_(&more), less_(&less), dynamics_(more.coordinate_count()), constraints_(more.constraint_count()) {
  for (const State& state : uneven_states(more, near))
    with_assemblies(
        more, less,
        [&](const auto& above, const auto& below) {
          const std::vector<bool> unlike = above.parts_unlike(below, state);
          unlike_.resize(unlike.size());
          std::transform(unlike.begin(), unlike.end(), unlike_.begin(), unlike_.begin(), std::logical_or<>());
        });
}

void ResidualDifference::find(const State& at, double step, double later, const std::vector<Shift>& shifts,
                              Eigen::Ref<Eigen::VectorXd> dynamics, Eigen::Ref<Eigen::VectorXd> constraints) {
  const State *above = &at, *below = &at;
  if (later != 0 || !shifts.empty()) {
    above_ = below_ = at;
    above_.t += step * later;
    below_.t -= step * later;
    for (const auto& [coordinate, by] : shifts) {
      above_.q[coordinate] += step * by;
      below_.q[coordinate] -= step * by;
    }
    above = &above_;
    below = &below_;
  }
  with_assemblies(*more_, *less_, [&](const auto& more, const auto& less) {
    more.residuals(less, unlike_, *above, *below, dynamics, constraints, dynamics_, constraints_);
  });
  dynamics = (dynamics - dynamics_) / (2 * step);
  constraints = (constraints - constraints_) / (2 * step);
}

double ResidualDifference::share() const {
  if (unlike_.empty()) return 1;
  const auto evaluated = static_cast<double>(std::count(unlike_.begin(), unlike_.end(), true));
  return evaluated / static_cast<double>(unlike_.size());
}

}  // namespace nurbeam
