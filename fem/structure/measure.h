#pragma once
#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace nurbeam {

/// Where a part of a beam ends: at a place of the undeformed beam [m], or at a rider, which runs along it.
struct PartEnd {
  double s;
  int rider = -1;
};

/// How far a part of a beam hangs below the line between its ends.
struct PartSag {
  std::string name;  ///< heads its column
  int beam;
  PartEnd from, to;
};

/// The least height of a beam over a profile of the ground, which is straight between its points [m].
struct Clearance {
  std::string name;  ///< heads its column
  int beam;
  std::vector<Eigen::Vector3d> profile;
};

/// What is measured of the shape of a model, along its gravity.
using Measure = std::variant<PartSag, Clearance>;

inline const std::string& name_of(const Measure& measure) {
  return std::visit([](const auto& of) -> const std::string& { return of.name; }, measure);
}

}  // namespace nurbeam
