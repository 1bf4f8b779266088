#pragma once
#include <string>
#include <string_view>

namespace nurbeam {

/// The text of a CAD file as OpenCASCADE reads it, where CAD systems are more tolerant. Of all: no
/// byte-order mark, UTF-16 as UTF-8, lines that end in CR alone. STEP: keywords and enumerations in capitals;
/// the data sections of edition 3 (ISO 10303-21:2016) as one, without parameters, and no sections ANCHOR,
/// REFERENCE and SIGNATURE; no comma before a closing parenthesis; reals without point (1E-3, or 25 where
/// only a real may stand) or with a small e as reals; complex instances of splines without weights and of
/// transformation operators as simple ones, the parts of others in alphabetical order; bytes that are no
/// UTF-8 taken for Latin-1. IGES: lines of 80 characters where the file has no line ends. DXF: in UTF-8
/// (drawing_letters.h). Any other text stays as it is.
std::string tolerant_text(std::string content);

bool is_utf8(std::string_view text);

/// The text if it is valid UTF-8, else with its bytes taken for Latin-1.
std::string as_utf8(std::string text);

}  // namespace nurbeam
