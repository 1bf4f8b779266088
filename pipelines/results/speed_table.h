#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nurbeam {

/// A natural frequency over the speed of what turns in the model.
struct SpeedLine {
  int whirl = 0;              ///< 1 forward, -1 backward, as the rotor; 0 neither
  int number = 1;             ///< among the lines of its whirl, the lowest first
  std::vector<double> omega;  ///< one a speed [rad/s]; not a number where it is none of the modes found

  std::string name() const;  ///< "forward 1", "mode 3"
};

/// A speed at which a line meets that of the rotor: an imbalance then excites the mode.
struct CriticalSpeed {
  double speed = 0;  ///< [rad/s]
  std::string line;  ///< its name
};

/// The Campbell diagram of a model.
struct SpeedTable {
  std::vector<double> speeds;  ///< [rad/s], increasing
  std::vector<SpeedLine> lines;
  std::vector<CriticalSpeed> critical = {};
};

/// speeds.csv: a row a speed, a column a line. Numbers have the digits that give them back exactly.
/// Throws std::runtime_error (file and reason).
void write_speed_table(const std::filesystem::path& file, const SpeedTable& table);

/// "critical speed: 57.3 rad/s (547 rev/min), where forward 1 meets it".
std::string critical_text(const CriticalSpeed& critical);

}  // namespace nurbeam
