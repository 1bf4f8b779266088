#pragma once

namespace nurbeam::verification {

/// A rope of 10 m and 1 kg/m, as limp as a chain, that hangs folded from two points 1 m apart and is let go
/// at one: beside a chain of 800 masses.
struct FallingChain {
  double at_0_6 = 0, at_1_2 = 0;  ///< rms distance from the chain at 0.6 and 1.2 s [m]
  double least_slope = 1;         ///< the least |r_s| inside an element until then
};

/// With so many elements, until `end` [s]. Throws std::runtime_error where a step fails.
FallingChain falling_chain(int elements, double end);

/// A rope of that length and weight that buckles, level and stretched by 1 %, and is let go at its end: it
/// recoils, and its weight lets it fall.
struct Recoil {
  double end_x = 0;        ///< place of its end at 1 s [m]
  double least_slope = 1;  ///< the least |r_s| inside an element until then
};
Recoil recoil(int elements);

}  // namespace nurbeam::verification
