#pragma once
#include <string>
#include <string_view>

namespace nurbeam {

/// The value in UTF-8 with the letters that drawings before 2007 write by their numbers: "\U+00FC", and
/// "\M+5B5E7", of which the first digit is a code page of East Asia.
std::string decoded_letters(std::string_view value);

}  // namespace nurbeam
