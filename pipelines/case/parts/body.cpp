#include "pipelines/case/parts/body.h"

#include "pipelines/case/case_json.h"

namespace nurbeam {

Eigen::Matrix3d inertia_matrix(const std::vector<double>& components) {
  Eigen::Matrix3d J = Eigen::Vector3d(components[0], components[1], components[2]).asDiagonal();
  if (components.size() < 6) return J;
  // Products are given as integrals; in the matrix they have the other sign.
  J(0, 1) = J(1, 0) = -components[3];
  J(1, 2) = J(2, 1) = -components[4];
  J(0, 2) = J(2, 0) = -components[5];
  return J;
}

void take_points(const Json& value, CaseBody& body) {
  for (const auto& [name, place] : value.items())
    if (!place.is_null()) take(place, body.points.emplace_back(name, Eigen::Vector3d::Zero()).second);
}

}  // namespace nurbeam
