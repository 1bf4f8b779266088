#include "cad_import/dxf/entity_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

namespace nurbeam {
namespace {

std::string hexadecimal(const std::array<double, 3>& parts) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(parts[0]),
                static_cast<unsigned>(parts[1]), static_cast<unsigned>(parts[2]));
  return text;
}

/// The colour of a number, as AutoCAD shows it: seven by name and two greys; 24 hues 15 degrees apart, from
/// red, in five shades each, of which every second number is half as saturated; greys. "" for what is none.
std::string numbered_colour(int number) {
  constexpr std::array<const char*, 10> named{"",        "#ff0000", "#ffff00", "#00ff00", "#00ffff",
                                              "#0000ff", "#ff00ff", "#ffffff", "#808080", "#c0c0c0"};
  constexpr std::array<const char*, 6> greys{"#333333", "#5b5b5b", "#848484",
                                             "#adadad", "#d6d6d6", "#ffffff"};
  constexpr std::array<double, 5> shades{1, 0.65, 0.5, 0.3, 0.15};
  constexpr int first_hue = 10, first_grey = 250, past_greys = 256;
  if (number < 0 || number >= past_greys) return "";
  if (number < first_hue) return named[static_cast<std::size_t>(number)];
  if (number >= first_grey) return greys[static_cast<std::size_t>(number - first_grey)];
  const int tens = number / 10;
  const double hue = (tens - 1) / 4.0;  // in sixths of a turn
  std::array<double, 3> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {  // full within a sixth of its own hue, gone beyond two
    const double own = 2.0 * static_cast<double>(i);
    const double away = std::abs(std::remainder(hue - own, 6));
    parts[i] = 255 * std::clamp(2 - away, 0.0, 1.0);
    if (number % 2 == 1) parts[i] = (255 + parts[i]) / 2;
    parts[i] *= shades[static_cast<std::size_t>(number % 10 / 2)];
  }
  return hexadecimal(parts);
}

}  // namespace

std::string colour_of(const DxfEntity& entity, const std::string& of_block) {
  if (const double colour = entity.number_of(420, -1); colour >= 0 && colour < 0x1000000) {
    char text[8];
    std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(colour));
    return text;
  }
  const int number = entity.whole_number_of(62, 256);
  if (number == 0) return of_block;
  return numbered_colour(number);
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
