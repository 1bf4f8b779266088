#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/forces/friction_law.h"
#include "fem/structure/memory_places.h"
#include "fem/structure/structure.h"

/// State::memory in the order of MemoryPlaces. A rider with friction has its FrictionMemory, a stop the
/// BufferContact of its body, a connector that jumps has 1 where it is taut, and a rotational connector its
/// angle [rad].
namespace nurbeam {

/// Names of all parts with a memory: the friction of "trolley" on beam "cable", ...
std::vector<std::string> what_remembers(const Structure& structure);
/// A memory of zeros.
inline Eigen::VectorXd no_memory(const MemoryPlaces& places) { return Eigen::VectorXd::Zero(places.size); }
FrictionMemory friction_memory(const MemoryPlaces& places, const Eigen::VectorXd& memory, int rider);
void set_friction_memory(const MemoryPlaces& places, Eigen::VectorXd& memory, int rider,
                         const FrictionMemory& of_rider);
/// A body at a buffer: away from it, pressing, or let go by its damper while it is still pressed in.
enum class BufferContact { away, pressing, let_go };
BufferContact buffer_contact(const MemoryPlaces& places, const Eigen::VectorXd& memory, int stop);
void set_buffer_contact(const MemoryPlaces& places, Eigen::VectorXd& memory, int stop, BufferContact contact);
bool is_taut(const MemoryPlaces& places, const Eigen::VectorXd& memory, int connector);
void set_taut(const MemoryPlaces& places, Eigen::VectorXd& memory, int connector, bool taut);

}  // namespace nurbeam
