#pragma once
#include <Eigen/Core>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// A wire of a catenary.
struct CatenaryWire {
  double tension;        ///< [N]
  double area;           ///< [m^2]
  double density;        ///< [kg/m^3]
  double modulus;        ///< of elasticity [Pa]
  double second_moment;  ///< [m^4]
};

/// An overhead contact line of one tension section along x: a messenger wire that masts hold, and a contact
/// wire on droppers below it, at z = 0 at the supports.
struct CatenaryData {
  std::vector<double> spans;     ///< lengths [m]
  double encumbrance = 1.2;      ///< height of the messenger over the contact wire at the masts [m]
  std::vector<double> droppers;  ///< from the start of the first span [m]; of others in proportion to length
  std::vector<double> dropper_lengths = {};  ///< [m]; empty: those that hold the wire where it is drawn
  double dropper_stiffness = 100e3;          ///< [N/m]
  double clamp_mass = 0;                     ///< at both ends of a dropper [kg]
  double pre_sag = 0;                        ///< of the contact wire in the middle of a span [m]
  double stagger = 0;                        ///< of the contact wire at masts, by turns to both sides [m]
  /// Force that lifts the contact wire at masts [N]; empty: its weight halfway to the droppers beside them.
  std::optional<double> mast_force = {};
  std::optional<double> arm = {};  ///< length of registration arms [m]; empty: none
  double arm_mass = 0;             ///< that moves with the wire [kg]
  CatenaryWire messenger{16e3, 120e-6, 1.07 / 120e-6, 110e9, 131.7 / 110e9};
  CatenaryWire contact{20e3, 150e-6, 9000, 100e9, 1950e-12};
  double mass_damping = 0.0125;      ///< [1/s]
  double stiffness_damping = 1e-4;   ///< [s]
  double element = 0.8;              ///< greatest length of elements [m]
  std::optional<double> speed = {};  ///< of a pantograph [m/s]

  double length() const;
  /// Where masts stand, with the two ends [m].
  std::vector<double> masts() const;
  /// Places of the droppers of a span [m].
  std::vector<double> droppers_of(std::size_t span) const;
  /// What lifts the contact wire at an inner mast [N].
  double lift_at(std::size_t mast) const;
  /// The messenger as drawn, at a place along the line: about as it hangs under both wires.
  Eigen::Vector3d messenger_at(double x) const;
  /// The contact wire as drawn, at a place along the line.
  Eigen::Vector3d contact_at(double x) const;
};

/// Throws std::invalid_argument, with option, value and rule, where the data are no catenary.
void check(const CatenaryData& data);
/// The case file, in lines that a person can read and change.
void write_case(const CatenaryData& data, const std::string& name, std::ostream& out);
/// Messenger and contact wire as drawn.
std::vector<NamedCurve> wires_of(const CatenaryData& data);

}  // namespace nurbeam
