#include "cad_import/dxf/layer_names.h"

#include <clocale>
#include <cstddef>
#include <cwctype>
#include <map>
#include <set>
#include <string_view>

namespace nurbeam {
namespace {

bool continues_letter(char c) { return (c & 0xC0) == 0x80; }

/// The first letters of a text in UTF-8.
std::string first_letters(const std::string& text, std::size_t count) {
  std::size_t end = 0;
  for (; end < text.size(); ++end)
    if (!continues_letter(text[end]) && count-- == 0) break;
  return text.substr(0, end);
}

std::wstring in_lower_case(const std::string& utf8) {
  static const locale_t letters = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  std::wstring lower;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i++]);
    wint_t code = lead < 0x80 ? lead : lead & (lead >= 0xF0 ? 0x07U : lead >= 0xE0 ? 0x0FU : 0x1FU);
    for (; i < utf8.size() && continues_letter(utf8[i]); ++i) code = code << 6 | (utf8[i] & 0x3FU);
    lower += static_cast<wchar_t>(letters ? towlower_l(code, letters) : std::towlower(code));
  }
  return lower;
}

std::string without_forbidden_letters(std::string name) {
  constexpr std::string_view forbidden = "<>/\\\":;?*|=,`";
  for (char& c : name)
    if (forbidden.find(c) != std::string_view::npos) c = '_';
  return name;
}

}  // namespace

std::vector<std::string> layer_names(const std::vector<NamedCurve>& curves) {
  constexpr std::size_t most_letters = 255;
  std::map<std::string, std::string> layers{{"", "0"}, {"0", "0"}};  // of the names
  std::set<std::wstring> taken{L"0"};
  std::vector<std::string> layer_of;
  for (const NamedCurve& curve : curves) {
    const std::string& given = curve.layer.empty() ? curve.name : curve.layer;
    const auto [layer, is_new] = layers.try_emplace(given);
    const std::string wanted = without_forbidden_letters(given);
    std::string suffix;
    for (int number = 2; is_new; ++number) {
      layer->second = first_letters(wanted, most_letters - suffix.size()) + suffix;
      if (taken.insert(in_lower_case(layer->second)).second) break;
      suffix = " " + std::to_string(number);
    }
    layer_of.push_back(layer->second);
  }
  return layer_of;
}

}  // namespace nurbeam
