#pragma once
#include <limits>
#include <sstream>
#include <stdexcept>

#include "solver/system/second_order_system.h"

/// Requirements of all methods on their arguments.
namespace nurbeam {

/// Shortest step relative to |t|: a smaller difference does not separate two times.
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

/// Throws std::invalid_argument unless the vector has as many entries as the system requires.
inline void require_size(const char* method, const char* name, Eigen::Index size, Eigen::Index expected) {
  require(size == expected, method, name, " has ", size, " entries, the system ", expected);
}

/// Throws std::invalid_argument unless all vectors of the state from which an integrator starts have the
/// right sizes.
inline void require_sizes(const char* method, const State& start, const SecondOrderSystem& system) {
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  require_size(method, "q", start.q.size(), n);
  require_size(method, "v", start.v.size(), n);
  require_size(method, "a", start.a.size(), n);
  require_size(method, "lambda", start.lambda.size(), m);
}

}  // namespace nurbeam
