#include "cad_import/dxf/entity_look.h"

#include <array>
#include <cstdio>
#include <set>

namespace nurbeam {

std::string colour_of(const DxfEntity& entity, const std::string& of_block) {
  constexpr std::array<const char*, 8> numbered{"",        "#ff0000", "#ffff00", "#00ff00",
                                                "#00ffff", "#0000ff", "#ff00ff", "#ffffff"};
  if (const double colour = entity.number_of(420, -1); colour >= 0 && colour < 0x1000000) {
    char text[8];
    std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(colour));
    return text;
  }
  const int number = entity.whole_number_of(62, 256);
  if (number == 0) return of_block;
  return number > 0 && number < 8 ? numbered[number] : "";
}

std::string name_key(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

bool is_in_paper_space(const DxfEntity& entity) { return entity.number_of(67, 0) == 1; }

bool is_invisible(const DxfEntity& entity) { return entity.number_of(60, 0) == 1; }

bool is_hidden_layer(const DxfEntity& layer) {
  constexpr int frozen = 1;
  return (layer.whole_number_of(70, 0) & frozen) || layer.number_of(62, 7) < 0;
}

bool draws_no_curves(std::string_view type) {
  static const std::set<std::string_view> kinds{
      "VERTEX",       "SEQEND",    "TEXT",           "MTEXT",       "ATTRIB",
      "ATTDEF",       "RTEXT",     "ARCALIGNEDTEXT", "POINT",       "VIEWPORT",
      "IMAGE",        "WIPEOUT",   "LIGHT",          "SUN",         "CAMERA",
      "OLEFRAME",     "OLE2FRAME", "PDFUNDERLAY",    "DWFUNDERLAY", "DGNUNDERLAY",
      "SECTIONOBJECT"};
  return kinds.contains(type);
}

}  // namespace nurbeam
