#pragma once
#include <vector>

#include "fem/mesh/mesh.h"

namespace nurbeam {

/// The coordinates of the places of a stop's bodies; -1 where there is none.
inline std::vector<int> places_of_stop(const Mesh& mesh, const Stop& stop) {
  return {mesh.joints[stop.joint].place, stop.other < 0 ? -1 : mesh.joints[stop.other].place};
}

/// Whether all its bodies are on their beams.
inline bool is_in_place(const Mesh& mesh, const Stop& stop) {
  return mesh.joints[stop.joint].place >= 0 && (stop.other < 0 || mesh.joints[stop.other].place >= 0);
}

/// d of a stop that is in place [m], and of the rates of its places [m/s].
inline double stop_rate(const Mesh& mesh, const Stop& stop, const Eigen::VectorXd& v) {
  const std::vector<int> places = places_of_stop(mesh, stop);
  return stop.weight_of_joint() * v[places[0]] + (places[1] >= 0 ? stop.weight_of_other() * v[places[1]] : 0);
}
inline double stop_distance(const Mesh& mesh, const Stop& stop, const Eigen::VectorXd& q) {
  return stop_rate(mesh, stop, q) + stop.offset();
}

}  // namespace nurbeam
