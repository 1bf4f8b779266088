#include "pipelines/verification/mass_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbeam::verification {

int MassChain::add_mass(double mass, const Eigen::Vector3d& place, const Eigen::Vector3d& velocity) {
  r_.push_back(place);
  v_.push_back(velocity);
  mass_.push_back(mass);
  held_.push_back(false);
  return size() - 1;
}

void MassChain::add_part(int a, int b, double length, const MassChainLaw& law) {
  parts_.push_back({a, b, length, law});
  for (const int i : {a, b}) mass_[i] += law.mass_per_length * length / 2;
}

void MassChain::add_string(int a, int b, double length, int parts, const MassChainLaw& law) {
  int last = a;
  for (int i = 1; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    const int next =
        i == parts ? b : add_mass(0, r_[a] + share * (r_[b] - r_[a]), v_[a] + share * (v_[b] - v_[a]));
    add_part(last, next, length / parts, law);
    last = next;
  }
}

void MassChain::find_forces() {
  for (std::size_t i = 0; i < r_.size(); ++i) force_[i] = mass_[i] * gravity_;
  for (const Part& part : parts_) {
    const auto& [tension, stiffness, mass, is_hooke] = part.law;
    const Eigen::Vector3d along = (r_[part.b] - r_[part.a]) / part.length;
    const double stretch = along.norm();
    const double pull =
        is_hooke ? stiffness * (1 - 1 / stretch) : tension + stiffness * (stretch * stretch - 1) / 2;
    force_[part.a] += pull * along;
    force_[part.b] -= pull * along;
  }
}

/// A fifth of what waves along the stiffest part allow, so that the step adds less than the parts do.
double MassChain::stable_step() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) {
    const double speed = std::sqrt((part.law.tension + 2 * part.law.stiffness) / part.law.mass_per_length);
    least = std::min(least, part.length / speed);
  }
  return 0.4 * least;
}

void MassChain::advance(double until) {
  force_.resize(r_.size());
  const long steps = std::lround(std::ceil((until - t_) / stable_step()));
  const double h = (until - t_) / static_cast<double>(steps);
  const auto kick = [&] {
    for (std::size_t i = 0; i < r_.size(); ++i)
      if (!held_[i]) v_[i] += h / 2 / mass_[i] * force_[i];
  };
  find_forces();
  for (long k = 0; k < steps; ++k) {
    kick();
    for (std::size_t i = 0; i < r_.size(); ++i)
      if (!held_[i]) r_[i] += h * v_[i];
    find_forces();
    kick();
  }
  t_ = until;
}

}  // namespace nurbeam::verification
