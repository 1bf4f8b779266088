#include "cad_import/report/report_bytes.h"

#include <array>
#include <utility>

#include "cad_import/report/bytes.h"

namespace nurbeam {
namespace {

void write(ByteWriter& out, const ImportedCurve& curve) {
  for (const std::string& text : {curve.name, curve.entity, curve.layer, curve.colour, curve.part})
    out.text(text);
  out.number(curve.free);
  out.number(curve.hidden);
  out.number(curve.exact);
  for (double number :
       {curve.deviation, curve.pipe_radius, curve.bore_radius, curve.bar.width, curve.bar.height,
        curve.bar.area, curve.bar.second_moments.x(), curve.bar.second_moments.y()})
    out.number(number);
  write(out, curve.curve);
}

ImportedCurve read_imported_curve(ByteReader& in) {
  std::array<std::string, 5> texts;
  for (std::string& text : texts) text = in.text();
  const bool free = in.number<char>() != 0;
  const bool hidden = in.number<char>() != 0;
  const bool exact = in.number<char>() != 0;
  std::array<double, 8> numbers{};
  for (double& number : numbers) number = in.number<double>();
  return {.name = texts[0],
          .entity = texts[1],
          .layer = texts[2],
          .colour = texts[3],
          .part = texts[4],
          .free = free,
          .hidden = hidden,
          .exact = exact,
          .deviation = numbers[0],
          .pipe_radius = numbers[1],
          .bore_radius = numbers[2],
          .bar = {numbers[3], numbers[4], numbers[5], {numbers[6], numbers[7]}},
          .curve = read_nurbs_curve(in)};
}

void write(ByteWriter& out, const Diagnostic& diagnostic) {
  out.number(static_cast<int>(diagnostic.severity));
  out.text(diagnostic.where);
  out.text(diagnostic.message);
}

Diagnostic read_diagnostic(ByteReader& in) {
  const int severity = in.number<int>();
  if (severity < static_cast<int>(Severity::note) || severity > static_cast<int>(Severity::error))
    ByteReader::fail();
  std::string where = in.text();
  return {static_cast<Severity>(severity), std::move(where), in.text()};
}

constexpr int no_format = -1;

std::optional<CadFormat> read_format(ByteReader& in) {
  const int format = in.number<int>();
  if (format < no_format || format > static_cast<int>(last_format)) ByteReader::fail();
  return format == no_format ? std::nullopt : std::optional(static_cast<CadFormat>(format));
}

}  // namespace

std::string to_bytes(const ImportReport& report) {
  ByteWriter out;
  out.text(report.file);
  out.number(report.format ? static_cast<int>(*report.format) : no_format);
  out.text(report.unit);
  out.number(report.unit_in_metres);
  out.number(report.resolution);
  out.count(report.curves.size());
  for (const ImportedCurve& curve : report.curves) write(out, curve);
  out.count(report.diagnostics.size());
  for (const Diagnostic& diagnostic : report.diagnostics) write(out, diagnostic);
  return std::move(out).bytes();
}

ImportReport report_from_bytes(const std::string& bytes) {
  ByteReader in(bytes);
  ImportReport report;
  report.file = in.text();
  report.format = read_format(in);
  report.unit = in.text();
  report.unit_in_metres = in.number<double>();
  report.resolution = in.number<double>();
  const std::size_t curves = in.count(1);
  for (std::size_t i = 0; i < curves; ++i) report.curves.push_back(read_imported_curve(in));
  const std::size_t diagnostics = in.count(1);
  for (std::size_t i = 0; i < diagnostics; ++i) report.diagnostics.push_back(read_diagnostic(in));
  if (!in.at_end()) ByteReader::fail();
  return report;
}

}  // namespace nurbeam
