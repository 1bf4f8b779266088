#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace nurbeam {

/// A mode of vibration, or of buckling, in the world's axes.
struct ModeRow {
  double omega = 0;   ///< [rad/s]; 0 of a rigid motion
  double factor = 0;  ///< on the loads that are not gravity; below 0 for reversed loads
  Eigen::Vector3d participation = Eigen::Vector3d::Zero();  ///< [sqrt(kg)]

  double round_off = 0;  ///< of omega^2 [1/s^2]
  int whirl = 0;         ///< 1 forward, -1 backward, as what turns in the model; 0 neither
  std::optional<double> error =
      {};  ///< of mesh, where it was asked for: of the frequency [Hz], of the factor
  /// Half wave of bending in diameters of the beam, and the part by which the frequency is too high without
  /// shear and rotary inertia; infinite and 0 where the mode does not bend.
  double diameters = std::numeric_limits<double>::infinity(), excess = 0;

  /// How well the mesh follows the mode: elements a half wave of the beam that follows it worst, its name,
  /// and how many elements it has; infinite where nothing moves in waves.
  double per_half_wave = std::numeric_limits<double>::infinity();
  std::string beam = {};
  int elements = 0;

  double frequency() const;                                                     ///< [Hz]
  Eigen::Vector3d effective_mass() const { return participation.cwiseAbs2(); }  ///< [kg]
};

/// The modes of a run, number 1 first.
struct ModeTable {
  bool buckling = false;
  double mass = 0;  ///< of the whole model [kg]
  std::vector<ModeRow> rows;

  /// Whether modes go round.
  bool whirls() const;
};

/// modes.csv. Numbers have the digits that give them back exactly; the period of a rigid motion is empty.
/// Throws std::runtime_error (file and reason).
void write_mode_table(const std::filesystem::path& file, const ModeTable& table);

/// One line for people: "mode 3: 12.1 Hz, effective mass (0.3, 0, 0) kg".
std::string mode_text(const ModeTable& table, std::size_t i);

}  // namespace nurbeam
