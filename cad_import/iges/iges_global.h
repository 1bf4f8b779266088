#pragma once
#include <string>

namespace nurbeam {

/// What the Global section of an IGES file says about lengths.
struct IgesGlobal {
  int unit_flag = 1;          ///< parameter 14
  std::string unit_name;      ///< parameter 15
  double unit_in_metres = 0;  ///< what they mean together
  double scale = 1;           ///< parameter 13: model space over real space
  char parameter_delimiter = ',', record_delimiter = ';';
};

/// The Global section of an IGES file with this content (IGES 5.3, 2.2.4.3), read independently of
/// OpenCASCADE. Throws std::runtime_error naming the parameter when a Hollerith count does not lead to a
/// delimiter, when a number is none, when flag and name give no known unit or name two different ones.
IgesGlobal parse_iges_global(const std::string& content);

}  // namespace nurbeam
