#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>

namespace nurbeam {

/// A function of places in standard normal space; nothing where it has no value.
struct SphereFunction {
  std::function<std::optional<double>(const Eigen::VectorXd& u)> value;
  std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd& u)> gradient;
};

/// A place on a sphere, and the angle there between its radius and the steepest descent [rad].
struct SpherePlace {
  Eigen::VectorXd u;
  double angle = 0;
};

/// Where a function is least on the sphere of that radius about the origin (a local minimum): there its
/// descent points outwards, u = -radius grad f / |grad f|. Begins at the place of the sphere in the direction
/// of `start`, or down the slope at the origin where that is 0. Each step goes along the great circle towards
/// that direction, shortened until f decreases (the advanced mean value method of Wu, Millwater and Cruse,
/// 1990, with a line search). Nothing where f has no value on the way, or no end is found.
std::optional<SpherePlace> least_on_sphere(const SphereFunction& f, double radius,
                                           const Eigen::VectorXd& start);

}  // namespace nurbeam
