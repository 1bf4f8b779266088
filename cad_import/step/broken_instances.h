#pragma once
#include <string>
#include <vector>

namespace nurbeam {

/// An instance of a STEP file that ISO 10303-21 does not allow.
struct BrokenInstance {
  std::string label;  ///< "#62 CARTESIAN_POINT"
  std::string
      token;  ///< what is neither number, reference, string, enumeration nor a keyword with parameters
};

/// Takes those instances of the data section out of the text that have such a token, as "0x10" for a number:
/// OpenCASCADE cannot go on behind them. What refers to them is told of as of any that is not there.
std::vector<BrokenInstance> remove_broken_instances(std::string& text);

}  // namespace nurbeam
