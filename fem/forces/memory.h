#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/forces/friction_law.h"
#include "fem/structure/structure.h"

/// State::memory: three numbers of each rider with friction in turn, then one of each stop, what a body
/// does to its buffer; then one of each connector that jumps: 1 where it is taut.
namespace nurbeam {

/// What remembers, each by its name: the friction of "trolley" on beam "cable", ...
std::vector<std::string> what_remembers(const Structure& structure);
/// All zero, of a model.
Eigen::VectorXd no_memory(const Structure& structure);
FrictionMemory friction_memory(const Structure& structure, const Eigen::VectorXd& memory, int rider);
void set_friction_memory(const Structure& structure, Eigen::VectorXd& memory, int rider,
                         const FrictionMemory& of_rider);
/// A body at a buffer: away from it, pressing, or let go by its damper while it is still pressed in.
enum class BufferContact { away, pressing, let_go };
BufferContact buffer_contact(const Structure& structure, const Eigen::VectorXd& memory, int stop);
void set_buffer_contact(const Structure& structure, Eigen::VectorXd& memory, int stop, BufferContact contact);
bool is_taut(const Structure& structure, const Eigen::VectorXd& memory, int connector);
void set_taut(const Structure& structure, Eigen::VectorXd& memory, int connector, bool taut);

}  // namespace nurbeam
