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

/// Which tokens are looked for: all that the syntax does not allow, as "0x10", behind which OpenCASCADE
/// cannot go on; or only numbers with two points, as "1.2.3", of which it reads a part.
enum class BrokenToken { any, number };

/// Takes those instances of the data section out of the text that have such a token. What refers to them is
/// told of as of any that is not there.
std::vector<BrokenInstance> remove_broken_instances(std::string& text, BrokenToken wanted);

/// Takes those instances of the data section out of the text whose number one before them has: OpenCASCADE
/// may look for them without end. Returns how they are called, "#62 CARTESIAN_POINT".
std::vector<std::string> remove_repeated_instances(std::string& text);

/// Whether a number with two points may stand anywhere in the text, be it in a string.
bool may_have_broken_numbers(const std::string& text);

}  // namespace nurbeam
