#include "cad_import/files/code_page.h"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <map>
#include <memory>
#include <set>

namespace nurbeam {
namespace {

std::string in_capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The name of the page for iconv; "" for one that is not known.
std::string iconv_name(const std::string& page) {
  static const std::map<std::string, std::string> names{
      {"ASCII", "CP1252"},     {"ANSI_874", "CP874"},      {"ANSI_932", "CP932"},
      {"ANSI_936", "GB18030"}, {"ANSI_949", "CP949"},      {"ANSI_950", "BIG5-HKSCS"},
      {"ANSI_1361", "JOHAB"},  {"JOHAB", "JOHAB"},         {"DOS932", "CP932"},
      {"DOS936", "GB18030"},   {"DOS949", "CP949"},        {"DOS950", "BIG5-HKSCS"},
      {"GB2312", "GB18030"},   {"BIG5", "BIG5-HKSCS"},     {"KSC5601", "CP949"},
      {"KOREAN", "CP949"},     {"MACINTOSH", "MACINTOSH"}, {"MAC-ROMAN", "MACINTOSH"},
      {"UTF-8", "UTF-8"},      {"UTF8", "UTF-8"}};
  static const std::set<std::string> numbered{
      "ANSI_1250", "ANSI_1251", "ANSI_1252", "ANSI_1253", "ANSI_1254", "ANSI_1255", "ANSI_1256", "ANSI_1257",
      "ANSI_1258", "DOS437",    "DOS737",    "DOS775",    "DOS850",    "DOS852",    "DOS855",    "DOS857",
      "DOS860",    "DOS861",    "DOS862",    "DOS863",    "DOS864",    "DOS865",    "DOS866",    "DOS869"};
  const std::string name = in_capitals(page);
  if (const auto at = names.find(name); at != names.end()) return at->second;
  if (numbered.contains(name)) return "CP" + name.substr(name.find_first_of("0123456789"));
  for (int part = 1; part <= 16; ++part)
    for (const char* start : {"ISO8859-", "ISO_8859-", "ISO-8859-"})
      if (part != 12 && name == start + std::to_string(part)) return "ISO-8859-" + std::to_string(part);
  return "";
}

struct CloseConversion {
  void operator()(void* conversion) const { iconv_close(conversion); }
};

std::unique_ptr<void, CloseConversion> conversion_from(const std::string& name) {
  const iconv_t conversion = iconv_open("UTF-8", name.c_str());
  const bool failed = conversion == reinterpret_cast<iconv_t>(-1);
  return std::unique_ptr<void, CloseConversion>(failed ? nullptr : conversion);
}

}  // namespace

bool is_known_code_page(const std::string& page) {
  const std::string name = iconv_name(page);
  return !name.empty() && conversion_from(name) != nullptr;
}

bool has_letters_of_two_bytes(const std::string& page) {
  static const std::set<std::string> pages{"CP932", "GB18030", "CP949", "BIG5-HKSCS", "JOHAB"};
  return pages.contains(iconv_name(page));
}

std::string from_code_page(const std::string& text, const std::string& page) {
  const auto conversion = conversion_from(is_known_code_page(page) ? iconv_name(page) : "CP1252");
  if (!conversion) return text;
  std::string result;
  std::array<char, 1 << 14> buffer{};
  char* in = const_cast<char*>(text.data());
  std::size_t left = text.size();
  while (left > 0) {
    char* out = buffer.data();
    std::size_t room = buffer.size();
    const bool stopped = iconv(conversion.get(), &in, &left, &out, &room) == static_cast<std::size_t>(-1);
    const bool no_letter = stopped && errno != E2BIG;
    result.append(buffer.data(), buffer.size() - room);
    if (!no_letter) continue;
    result += "\uFFFD";
    ++in;
    --left;
  }
  return result;
}

}  // namespace nurbeam
