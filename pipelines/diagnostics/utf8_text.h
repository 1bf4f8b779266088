#pragma once
#include <string>
#include <string_view>

namespace nurbeam {

/// The number of characters of a text in UTF-8.
std::size_t character_count(std::string_view text);

/// How many columns of a terminal a text in UTF-8 takes: two for each wide character (East Asian ones,
/// pictures), none for marks that stand over another one.
std::size_t column_count(std::string_view text);

/// The first characters of a text in UTF-8, at most so many; "..." stands for the others.
std::string first_characters(std::string_view text, std::size_t most);

}  // namespace nurbeam
