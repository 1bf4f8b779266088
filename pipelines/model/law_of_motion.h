#pragma once
#include <string>

namespace nurbeam {

/// A motion that a function of the program prescribes.
struct LawOfMotion {
  std::string path;  ///< in the case
  int function;
  int rider = -1, constraint = -1;  ///< of the model: one of them, without that motion
};

}  // namespace nurbeam
