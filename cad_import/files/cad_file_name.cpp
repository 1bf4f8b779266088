#include "cad_import/files/cad_file_name.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>

namespace nurbeam {
namespace {

std::string ending_of_name(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

std::optional<CadFormat> format_by_name(const std::filesystem::path& file) {
  static const std::map<std::string, CadFormat> known{{".step", CadFormat::step}, {".stp", CadFormat::step},
                                                      {".igs", CadFormat::iges},  {".iges", CadFormat::iges},
                                                      {".dxf", CadFormat::dxf},   {".brep", CadFormat::brep},
                                                      {".brp", CadFormat::brep},  {".ifc", CadFormat::ifc}};
  const auto at = known.find(ending_of_name(file));
  return at == known.end() ? std::nullopt : std::optional(at->second);
}

bool is_named_as_cad_file(const std::filesystem::path& file) {
  static const std::set<std::string> packed{".stpz", ".zip", ".gz"};
  return format_by_name(file) || packed.contains(ending_of_name(file));
}

}  // namespace nurbeam
