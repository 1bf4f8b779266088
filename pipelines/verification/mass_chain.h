#pragma once
#include <Eigen/Core>
#include <vector>

/// Ropes as masses that springs join: an oracle that shares nothing with the elements.
namespace nurbeam::verification {

/// A string on its label s: the force along it, over the stretch of s. Green's law is
/// (tension + stiffness (lambda^2 - 1)/2) lambda, Hooke's stiffness (lambda - 1).
struct MassChainLaw {
  double tension, stiffness;  ///< [N]
  double mass_per_length;     ///< per s [kg/m]
  bool is_hooke = false;
};

/// Masses in space that springs without bending stiffness join, moved on by Stoermer's and Verlet's rule.
class MassChain {
 public:
  explicit MassChain(Eigen::Vector3d gravity) : gravity_(std::move(gravity)) {}

  /// Adds a mass [kg], which may be 0 until strings end there, and returns its number.
  int add_mass(double mass, const Eigen::Vector3d& place,
               const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero());
  void hold(int i) { held_[i] = true; }
  /// Joins two masses by a string of so many equal springs, with masses in a straight line between; `length`
  /// is that of its label.
  void add_string(int a, int b, double length, int parts, const MassChainLaw& law);
  /// Joins two masses by one spring of a string, half of whose mass is theirs each.
  void add_part(int a, int b, double length, const MassChainLaw& law);

  const Eigen::Vector3d& place(int i) const { return r_[i]; }
  int size() const { return static_cast<int>(r_.size()); }
  void advance(double until);

 private:
  struct Part {
    int a, b;
    double length;
    MassChainLaw law;
  };
  void find_forces();
  double stable_step() const;

  Eigen::Vector3d gravity_;
  std::vector<Eigen::Vector3d> r_, v_, force_;
  std::vector<double> mass_;
  std::vector<bool> held_;
  std::vector<Part> parts_;
  double t_ = 0;
};

}  // namespace nurbeam::verification
