#pragma once
#include <cmath>
#include <random>
#include <vector>

namespace nurbeam::campaign {

/// Draws numbers and choices, the same for the same seed.
class Draw {
 public:
  explicit Draw(unsigned long seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool chance(double p) { return uniform(0, 1) < p; }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  template <class T>
  T one_of(const std::vector<T>& choices) {
    return choices[whole(0, static_cast<int>(choices.size()) - 1)];
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace nurbeam::campaign
