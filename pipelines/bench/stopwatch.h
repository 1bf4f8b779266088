#pragma once
#include <chrono>
#include <ctime>

namespace nurbeam {

/// Processor time of this thread [s].
inline double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Time by the clock, from when does not matter [s].
inline double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What one call takes by such a time [s]: the least of three series that last 20 ms each, or of one call
/// where that takes longer than ten of them.
template <double time() = processor_seconds, class Call>
double seconds_of(const Call& call) {
  constexpr double series = 0.02;
  double least = 0;
  for (int i = 0; i < 3; ++i) {
    const double start = time();
    double taken = 0;
    long calls = 0;
    while (taken < series) {
      call();
      ++calls;
      taken = time() - start;
    }
    const double each = taken / static_cast<double>(calls);
    least = i == 0 || each < least ? each : least;
    if (calls == 1 && taken > 10 * series) break;
  }
  return least;
}

}  // namespace nurbeam
