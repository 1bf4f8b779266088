#include "cad_import/files/tolerant_text.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

#include "cad_import/files/cad_format.h"
#include "cad_import/files/complex_instance.h"
#include "cad_import/files/drawing_letters.h"
#include "cad_import/files/real_text.h"
#include "cad_import/files/simple_operator.h"
#include "cad_import/files/simple_spline.h"
#include "cad_import/files/utf16.h"

namespace nurbeam {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The place after the string or comment that begins at `at`; `at` itself if none does.
std::size_t after_quotation(std::string_view text, std::size_t at) {
  const auto end = [&](std::string_view mark, std::size_t from) {
    const std::size_t found = text.find(mark, from);
    return found == std::string_view::npos ? text.size() : found + mark.size();
  };
  if (text[at] == '\'') return end("'", at + 1);
  if (text.substr(at, 2) == "/*") return end("*/", at + 2);
  return at;
}

/// The statement that begins at `at`, up to its semicolon.
std::string_view statement_at(std::string_view text, std::size_t at) {
  for (std::size_t i = at; i < text.size();) {
    const std::size_t next = after_quotation(text, i);
    if (next == i && text[i] == ';') return text.substr(at, i + 1 - at);
    i = next == i ? i + 1 : next;
  }
  return text.substr(at);
}

/// Its first word, behind blanks and comments.
std::string_view keyword_of(std::string_view statement) {
  std::size_t i = 0;
  while (i < statement.size())
    if (blanks.find(statement[i]) != std::string_view::npos)
      ++i;
    else if (statement.substr(i, 2) == "/*")
      i = after_quotation(statement, i);
    else
      break;
  const std::size_t end = statement.find_first_of(" \t\r\n(;=,/", i);
  return statement.substr(i, end == std::string_view::npos ? end : end - i);
}

/// Without commas before a closing parenthesis, reals as reals.
void append_parameters(std::string_view statement, std::string& out) {
  for (std::size_t i = 0; i < statement.size();) {
    const std::size_t next = after_quotation(statement, i);
    if (next > i) {
      out += statement.substr(i, next - i);
      i = next;
      continue;
    }
    if (const NumberText number = number_text(statement, i, opens_typed_real(out)); number.size > 0) {
      out += number.text;
      i += number.size;
      continue;
    }
    const std::size_t after = statement.find_first_not_of(blanks, i + 1);
    const bool trails = statement[i] == ',' && after != std::string_view::npos && statement[after] == ')';
    if (!trails) out += statement[i];
    ++i;
  }
}

/// The value of an instance, from behind "=" to before ";", as OpenCASCADE wants it; nothing where it does.
std::optional<std::string> rewritten(std::string_view value) {
  for (const auto& simple : {simple_spline(value), simple_operator(value)})
    if (simple) return simple;
  return in_alphabetical_order(value);
}

void append_instance(std::string_view statement, std::string& out) {
  const std::size_t value = statement.find('=') + 1;
  const std::optional<std::string> other =
      value > 0 && statement.ends_with(';') ? rewritten(statement.substr(value, statement.size() - value - 1))
                                            : std::nullopt;
  if (!other) return append_parameters(statement, out);
  out += statement.substr(0, value);
  append_parameters(*other, out);
  out += ';';
}

/// Keywords and enumerations in capitals, as some write them small.
void capitalise(std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t next = after_quotation(text, i);
    if (next == i && text[i] >= 'a' && text[i] <= 'z') text[i] += 'A' - 'a';
    i = next == i ? i + 1 : next;
  }
}

std::string tolerant_step(std::string given) {
  capitalise(given);
  const std::string_view text = given;
  std::string out;
  out.reserve(text.size());
  std::string_view end_of_section;  // written when no other data section follows
  bool skipping = false, has_data = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view statement = statement_at(text, at);
    at += statement.size();
    const std::string_view keyword = keyword_of(statement);
    if (skipping) {
      skipping = keyword != "ENDSEC";
      continue;
    }
    skipping = keyword == "ANCHOR" || keyword == "REFERENCE" || keyword == "SIGNATURE";
    if (skipping) continue;
    const bool is_data = keyword == "DATA", goes_on = is_data && has_data;
    has_data = has_data || is_data;
    if (!goes_on) out += end_of_section;
    end_of_section = keyword == "ENDSEC" ? statement : std::string_view();
    if (goes_on || keyword == "ENDSEC") continue;
    if (is_data)
      (out += statement.substr(0, keyword.data() + keyword.size() - statement.data())) += ';';
    else
      append_instance(statement, out);
  }
  return out += end_of_section;
}

constexpr std::size_t line_length = 80;

// An IGES file whose lines stand one after another: its second one begins as a line does.
bool has_no_line_ends(std::string_view text) {
  return text.size() > line_length && text.size() % line_length == 0 && text[72] == 'S' &&
         text.find_first_of("\r\n") == std::string_view::npos;
}

std::string in_lines(std::string_view text) {
  std::string lines;
  for (std::size_t at = 0; at < text.size(); at += line_length)
    (lines += text.substr(at, line_length)) += '\n';
  return lines;
}

}  // namespace

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const int more = lead < 0x80 ? 0 : lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
    if (lead >= 0x80 && (lead < 0xC2 || lead > 0xF4)) return false;
    for (int k = 0; k < more; ++k, ++i)
      if (i >= text.size() || (text[i] & 0xC0) != 0x80) return false;
  }
  return true;
}

std::string as_utf8(std::string text) {
  if (is_utf8(text)) return text;
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) result += static_cast<char>(0xC0 | (byte >> 6));
    result += byte < 0x80 ? c : static_cast<char>(0x80 | (byte & 0x3F));
  }
  return result;
}

std::string tolerant_text(std::string content) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  content = without_utf16(std::move(content));
  if (content.starts_with(byte_order_mark)) content.erase(0, byte_order_mark.size());
  if (content.find('\n') == std::string::npos) std::replace(content.begin(), content.end(), '\r', '\n');
  if (has_no_line_ends(content)) return in_lines(content);
  const std::optional<CadFormat> format = format_of(content);
  if (format == CadFormat::step || format == CadFormat::ifc)
    return tolerant_step(as_utf8(std::move(content)));
  if (format == CadFormat::dxf) return drawing_in_utf8(std::move(content));
  return content;
}

}  // namespace nurbeam
