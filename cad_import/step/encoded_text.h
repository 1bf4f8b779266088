#pragma once
#include <string>
#include <string_view>

namespace nurbeam {

/// The text with its characters outside ASCII in hexadecimal, 8 digits each (ISO 10303-21, 6.4.3.3).
std::string step_encoded(std::string_view utf8);

/// The text as a string of a STEP file holds it, without the apostrophes around it: theirs and backslashes
/// doubled, and step_encoded().
std::string step_string(std::string_view utf8);

/// What the inside of a string of a STEP file says, as UTF-8: \X2\, \X4\, \X\, \S\ and doubled backslashes
/// decoded.
std::string step_decoded(std::string_view text);

/// The text of a STEP file in whose strings apostrophes stand in hexadecimal, not doubled: OpenCASCADE takes
/// a doubled one before a comma or a bracket for the end of its string. A text that ends within a string
/// stays as it is.
std::string with_encoded_apostrophes(std::string text);

}  // namespace nurbeam
