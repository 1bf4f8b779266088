#include "fem/forces/memory.h"

#include <algorithm>

namespace nurbeam {

namespace {

constexpr int of_friction = 3;

int first_of_joint(const Structure& structure, std::size_t joint) {
  return of_friction * static_cast<int>(std::count_if(
                           structure.joints.begin(), structure.joints.begin() + static_cast<long>(joint),
                           [](const SlidingJoint& j) { return j.friction.has_value(); }));
}

int of_stop(const Structure& structure, int stop) {
  return first_of_joint(structure, structure.joints.size()) + stop;
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
  const auto body = [&](int joint) { return "\"" + structure.body_of(structure.joints[joint]).name + "\""; };
  std::vector<std::string> all;
  for (std::size_t j = 0; j < structure.joints.size(); ++j)
    if (structure.joints[j].friction)
      all.push_back("the friction of " + body(static_cast<int>(j)) + " on beam \"" +
                    structure.beam_of(structure.joints[j]).name + "\"");
  for (const Stop& stop : structure.stops)
    all.push_back(stop.other < 0 ? "a stop of " + body(stop.joint) + " on beam \"" +
                                       structure.beam_of(structure.joints[stop.joint]).name + "\""
                                 : "the stop between " + body(stop.joint) + " and " + body(stop.other));
  for (const Connector& connector : structure.connectors)
    if (connector.jumps()) all.push_back("the damping of connector \"" + connector.name + "\"");
  return all;
}

FrictionMemory friction_memory(const Structure& structure, const Eigen::VectorXd& memory, int joint) {
  const int first = first_of_joint(structure, joint);
  return {memory[first], memory[first + 1], static_cast<int>(memory[first + 2])};
}

void set_friction_memory(const Structure& structure, Eigen::VectorXd& memory, int joint,
                         const FrictionMemory& of_joint) {
  memory.segment<of_friction>(first_of_joint(structure, joint)) << of_joint.z, of_joint.s, of_joint.slides;
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
