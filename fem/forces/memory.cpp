#include "fem/forces/memory.h"

namespace nurbeam {

std::vector<std::string> what_remembers(const Structure& structure) {
  const auto body = [&](int rider) { return "\"" + structure.body_of(structure.riders[rider]).name + "\""; };
  std::vector<std::string> all;
  for (std::size_t j = 0; j < structure.riders.size(); ++j)
    if (structure.riders[j].friction)
      all.push_back("the friction of " + body(static_cast<int>(j)) + " on beam \"" +
                    structure.beam_of(structure.riders[j]).name + "\"");
  for (const Stop& stop : structure.stops)
    all.push_back(stop.other < 0 ? "a stop of " + body(stop.rider) + " on beam \"" +
                                       structure.beam_of(structure.riders[stop.rider]).name + "\""
                                 : "the stop between " + body(stop.rider) + " and " + body(stop.other));
  for (const Connector& connector : structure.connectors)
    if (connector.jumps()) all.push_back("the damping of connector \"" + connector.name + "\"");
  for (const RotationalConnector& connector : structure.rotational_connectors)
    if (connector.counts(structure.dimension))
      all.push_back("the angle of connector \"" + connector.name + "\"");
  return all;
}

FrictionMemory friction_memory(const MemoryPlaces& places, const Eigen::VectorXd& memory, int rider) {
  const int first = places.riders[rider];
  return {memory[first], memory[first + 1], static_cast<int>(memory[first + 2])};
}

void set_friction_memory(const MemoryPlaces& places, Eigen::VectorXd& memory, int rider,
                         const FrictionMemory& of_rider) {
  memory.segment<3>(places.riders[rider]) << of_rider.z, of_rider.s, of_rider.slides;
}

BufferContact buffer_contact(const MemoryPlaces& places, const Eigen::VectorXd& memory, int stop) {
  return memory.size() > 0 ? static_cast<BufferContact>(memory[places.stops[stop]]) : BufferContact::away;
}

void set_buffer_contact(const MemoryPlaces& places, Eigen::VectorXd& memory, int stop,
                        BufferContact contact) {
  memory[places.stops[stop]] = static_cast<double>(contact);
}

bool is_taut(const MemoryPlaces& places, const Eigen::VectorXd& memory, int connector) {
  return memory[places.connectors[connector]] != 0;
}

void set_taut(const MemoryPlaces& places, Eigen::VectorXd& memory, int connector, bool taut) {
  memory[places.connectors[connector]] = taut ? 1 : 0;
}

}  // namespace nurbeam
