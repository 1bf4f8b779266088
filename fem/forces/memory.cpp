#include "fem/forces/memory.h"

#include <algorithm>

namespace nurbeam {

namespace {

constexpr int of_friction = 3;

int first_of_rider(const Structure& structure, std::size_t rider) {
  return of_friction * static_cast<int>(std::count_if(
                           structure.riders.begin(), structure.riders.begin() + static_cast<long>(rider),
                           [](const Rider& j) { return j.friction.has_value(); }));
}

int of_stop(const Structure& structure, int stop) {
  return first_of_rider(structure, structure.riders.size()) + stop;
}

int of_connector(const Structure& structure, std::size_t connector) {
  return of_stop(structure, static_cast<int>(structure.stops.size())) +
         static_cast<int>(std::count_if(
             structure.connectors.begin(), structure.connectors.begin() + static_cast<long>(connector),
             [](const Connector& c) { return c.jumps(); }));
}

}  // namespace

Eigen::VectorXd no_memory(const Structure& structure) {
  return Eigen::VectorXd::Zero(of_connector(structure, structure.connectors.size()));
}

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
  return all;
}

FrictionMemory friction_memory(const Structure& structure, const Eigen::VectorXd& memory, int rider) {
  const int first = first_of_rider(structure, rider);
  return {memory[first], memory[first + 1], static_cast<int>(memory[first + 2])};
}

void set_friction_memory(const Structure& structure, Eigen::VectorXd& memory, int rider,
                         const FrictionMemory& of_rider) {
  memory.segment<of_friction>(first_of_rider(structure, rider)) << of_rider.z, of_rider.s, of_rider.slides;
}

BufferContact buffer_contact(const Structure& structure, const Eigen::VectorXd& memory, int stop) {
  return memory.size() > 0 ? static_cast<BufferContact>(memory[of_stop(structure, stop)])
                           : BufferContact::away;
}

void set_buffer_contact(const Structure& structure, Eigen::VectorXd& memory, int stop,
                        BufferContact contact) {
  memory[of_stop(structure, stop)] = static_cast<double>(contact);
}

bool is_taut(const Structure& structure, const Eigen::VectorXd& memory, int connector) {
  return memory[of_connector(structure, connector)] != 0;
}

void set_taut(const Structure& structure, Eigen::VectorXd& memory, int connector, bool taut) {
  memory[of_connector(structure, connector)] = taut ? 1 : 0;
}

}  // namespace nurbeam
