#pragma once
#include <filesystem>
#include <string>

#include "tests/campaign/random_case.h"

namespace nurbeam::campaign {

/// How a case came out.
struct Verdict {
  std::string outcome;         ///< "done", "refused", or the first words of the message it ended with
  std::string complaint = {};  ///< what must not be: empty where all is well
  double drift = 0;            ///< of the total energy over the energy that moves
  double imbalance = 0;        ///< of reactions, loads and inertia over the largest force
  double seconds = 0;
};

/// Reads, builds and runs a case, and holds it to the laws: the total energy with inputs and losses is
/// constant to the order of the integrator, or a warning or a message says that it is not; reactions balance
/// loads and inertia to 1e-8 of the largest force; no number is NaN; what is wrong is said. It is left after
/// so many steps.
Verdict try_case(const std::filesystem::path& file, long most_steps);
Verdict try_case(const Json& c, long most_steps);

}  // namespace nurbeam::campaign
