#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// "NAMED_UNIT" and "*" of "NAMED_UNIT(*)".
struct InstancePart {
  std::string_view keyword, parameters;
};

/// The parts of the value of a complex STEP instance, "( A(...) B(...) )", which has no blanks around; empty
/// where it is none.
std::vector<InstancePart> parts_of(std::string_view value);

/// The value with its parts in the order of the alphabet, as ISO 10303-21 wants them; nothing where they
/// stand so, and of what is no complex instance.
std::optional<std::string> in_alphabetical_order(std::string_view value);

std::string_view without_blanks(std::string_view text);

}  // namespace nurbeam
