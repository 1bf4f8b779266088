#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace nurbeam {

/// A number in the text of a STEP file, and how ISO 10303-21 writes it.
struct NumberText {
  std::size_t size = 0;   ///< its characters in the file; 0: there is no number
  std::string text = {};  ///< a real has a point, and a capital E before its exponent
};

/// The number that begins at `at`. It is a real if it has a point or an exponent, or if the value `is_real`
/// whatever it looks like.
NumberText number_text(std::string_view text, std::size_t at, bool is_real);

/// Whether the parameter that begins where this text ends is that of a typed real: LENGTH_MEASURE(,
/// PARAMETER_VALUE(.
bool opens_typed_real(std::string_view text);

}  // namespace nurbeam
