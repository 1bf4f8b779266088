#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// A value in an instance of a STEP text: what stands between commas.
struct IfcValue {
  enum class Kind { none, number, text, enumeration, reference, list, typed };

  Kind kind = Kind::none;  ///< none: "$", "*", or not there
  double number = 0;
  int reference = 0;
  std::string text = {};  ///< of texts, enumerations (without points) and the keyword of typed ones
  std::vector<IfcValue> items = {};  ///< of lists, and what a typed one holds

  bool is_reference() const { return kind == Kind::reference; }
  /// Of a number, or a typed one; throws std::runtime_error for others.
  double as_number() const;
  /// The item, or one that is not there.
  const IfcValue& at(std::size_t i) const&;
  IfcValue at(std::size_t i) &&;
};

/// The values of an instance, "IFCLINE(#1,#2)": its keyword in `text`, its parameters the items. Throws
/// std::runtime_error where it is none.
IfcValue parsed_instance(std::string_view text);

}  // namespace nurbeam
