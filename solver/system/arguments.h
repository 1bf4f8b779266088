#pragma once
#include <limits>
#include <sstream>
#include <stdexcept>

#include "solver/system/second_order_system.h"

/// What every method asks of its arguments.
namespace nurbeam {

/// Of a step, over |t|: less is no distance between two times.
constexpr double shortest_step = 16 * std::numeric_limits<double>::epsilon();

/// Throws std::invalid_argument "method: parts..." unless `rule`; numbers keep their digits.
template <class... Parts>
void require(bool rule, const char* method, const Parts&... parts) {
  if (rule) return;
  std::ostringstream message;
  message.precision(10);
  message << method << ": ";
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

/// Throws std::invalid_argument unless the vector has as many entries as the system asks for.
inline void require_size(const char* method, const char* name, Eigen::Index size, Eigen::Index expected) {
  require(size == expected, method, name, " has ", size, " entries, the system ", expected);
}

/// The same of all vectors of a state that an integrator starts from.
inline void require_sizes(const char* method, const State& start, const SecondOrderSystem& system) {
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  require_size(method, "q", start.q.size(), n);
  require_size(method, "v", start.v.size(), n);
  require_size(method, "a", start.a.size(), n);
  require_size(method, "lambda", start.lambda.size(), m);
}

}  // namespace nurbeam
