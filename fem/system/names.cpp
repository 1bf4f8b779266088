#include "fem/system/names.h"

#include <algorithm>

#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

using Names = std::vector<std::string>;

void name_vector(Names& names, int first, int dimension, const std::string& name) {
  if (first < 0) return;
  for (int d = 0; d < dimension; ++d) names[first + d] = name + "." + "xyz"[d];
}
void name_number(Names& names, int at, const std::string& name) {
  if (at >= 0) names[at] = name;
}

std::string place_name(const BeamModel& model, const Rider& rider) {
  const std::string& body = model.bodies[rider.body].name;
  const bool on_others = std::ranges::count(model.riders, rider.body, &Rider::body) > 1;
  return on_others ? body + "." + model.beam_of(rider).name + ".s" : body + ".s";
}

std::string stop_name(const BeamModel& model, const Stop& stop) {
  const std::string name = "stop." + model.bodies[model.riders[stop.rider].body].name;
  return stop.other < 0 ? name : name + "." + model.bodies[model.riders[stop.other].body].name;
}

template <int D>
void name_rows(Names& names, const typename Assembly<D>::Rows& rows, const std::string& name) {
  for (int k = 0; k < rows.count; ++k)
    names[rows.first + k] = rows.count == 1 ? name : name + "[" + std::to_string(k + 1) + "]";
}

// The name of the part of a structure that asks for a constraint; empty where there is none to name.
template <int D>
std::string part_name(const Assembly<D>& a, const auto& constraint) {
  const BeamModel& model = *a.model();
  const Mesh& mesh = a.mesh();
  constexpr ConstraintOffers offers = offers_of<decltype(constraint)>;
  if constexpr (offers.connector) return model.connectors[constraint.connector()].name;
  if constexpr (offers.stop) return stop_name(model, model.stops[constraint.closed_stop()]);
  if constexpr (offers.place)
    for (std::size_t j = 0; j < mesh.riders.size(); ++j)
      if (mesh.riders[j].place == constraint.place()) return place_name(model, model.riders[j]);
  if constexpr (offers.body)
    for (std::size_t i = 0; i < mesh.bodies.size(); ++i)
      if (mesh.bodies[i] == constraint.body()) return model.bodies[i].name;
  return {};
}

}  // namespace

std::vector<std::string> coordinate_names(const BeamSystem& system) {
  const Mesh& mesh = system.mesh();
  const BeamModel& model = system.model();
  const int D = mesh.dimension;
  Names names(mesh.coordinate_count);
  for (int b = 0; b < static_cast<int>(mesh.nodes.size()); ++b)
    for (int i = 0; i < static_cast<int>(mesh.nodes[b].size()); ++i) {
      const MeshNode& node = mesh.nodes[b][i];
      const std::string name = model.beams[b].name + "[" + std::to_string(i) + "]";
      name_vector(names, node.r, D, name);
      name_vector(names, node.slope_right, D, name + ".slope_right");
      name_vector(names, node.slope_left, D,
                  name + (node.slope_left == node.slope_right ? ".slope" : ".slope_left"));
      name_number(names, node.angle_right, name + ".angle_right");
      name_number(names, node.angle_left,
                  name + (node.angle_left == node.angle_right ? ".angle" : ".angle_left"));
    }
  for (int i = 0; i < static_cast<int>(mesh.spans.size()); ++i) {
    const int b = mesh.spans[i].beam;
    name_number(names, mesh.spans[i].bubble,
                model.beams[b].name + "[" + std::to_string(i - mesh.first_span[b]) + "].bubble");
  }
  for (int i = 0; i < static_cast<int>(mesh.bodies.size()); ++i)
    name_vector(names, mesh.bodies[i], D, model.bodies[i].name);
  for (int i = 0; i < static_cast<int>(mesh.bodies.size()); ++i)
    for (int k = 0; k < 4 && mesh.attitudes[i] >= 0; ++k)
      names[mesh.attitudes[i] + k] = model.bodies[i].name + ".q" + "wxyz"[k];
  for (int j = 0; j < static_cast<int>(mesh.riders.size()); ++j)
    name_number(names, mesh.riders[j].place, place_name(model, model.riders[j]));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].empty()) names[i] = "coordinate[" + std::to_string(i) + "]";
  return names;
}

std::vector<std::string> row_names(const BeamSystem& system) {
  Names names(system.constraint_count());
  const BeamModel& model = system.model();
  with_assembly(system, [&]<int D>(const Assembly<D>& a) {
    for (std::size_t i = 0; i < model.constraints.size(); ++i)
      name_rows<D>(names, a.rows_of(static_cast<int>(i)),
                   std::visit([&](const auto& c) { return c.reaction_name(model); }, model.constraints[i]));
    a.for_each_constraint([&](const auto& constraint, const typename Assembly<D>::Rows& rows) {
      if (names[rows.first].empty()) name_rows<D>(names, rows, part_name(a, constraint));
    });
  });
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].empty()) names[i] = "constraint[" + std::to_string(i) + "]";
  return names;
}

}  // namespace nurbeam
