#include "cad_import/report/report_bytes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace nurbeam {
namespace {

class Writer {
 public:
  template <class Number>
  void number(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }
  void count(std::size_t value) { number(static_cast<std::uint64_t>(value)); }
  void text(const std::string& value) {
    count(value.size());
    bytes_ += value;
  }
  std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Every read is checked: the sender may have been damaged by the file it read.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  template <class Number>
  Number number() {
    require(sizeof(Number));
    Number value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  // A number of things that take at least `size_of_one` bytes each.
  std::size_t count(std::size_t size_of_one) {
    const auto value = number<std::uint64_t>();
    if (value > (bytes_.size() - at_) / size_of_one) fail();
    return value;
  }
  std::string text() {
    const std::size_t size = count(1);
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  bool at_end() const { return at_ == bytes_.size(); }
  [[noreturn]] static void fail() { throw std::runtime_error("damaged report"); }

 private:
  void require(std::size_t size) const {
    if (size > bytes_.size() - at_) fail();
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

void write(Writer& out, const NurbsCurve& curve) {
  out.number(curve.degree());
  out.count(curve.knots().knots().size());
  for (double knot : curve.knots().knots()) out.number(knot);
  out.count(static_cast<std::size_t>(curve.control_points().size()));
  for (double value : curve.control_points().reshaped()) out.number(value);
}

NurbsCurve read_nurbs_curve(Reader& in) {
  const int degree = in.number<int>();
  std::vector<double> knots(in.count(sizeof(double)));
  for (double& knot : knots) knot = in.number<double>();
  const std::size_t size = in.count(sizeof(double));
  if (size % 4 != 0) Reader::fail();
  Eigen::Matrix4Xd points(4, static_cast<Eigen::Index>(size / 4));
  for (double& value : points.reshaped()) value = in.number<double>();
  return NurbsCurve(KnotVector(degree, std::move(knots)), std::move(points));
}

void write(Writer& out, const ImportedCurve& curve) {
  for (const std::string& text : {curve.name, curve.entity, curve.layer, curve.colour}) out.text(text);
  out.number(curve.free);
  out.number(curve.exact);
  for (double number : {curve.deviation, curve.pipe_radius, curve.bore_radius}) out.number(number);
  write(out, curve.curve);
}

ImportedCurve read_imported_curve(Reader& in) {
  std::array<std::string, 4> texts;
  for (std::string& text : texts) text = in.text();
  const bool free = in.number<char>() != 0;
  const bool exact = in.number<char>() != 0;
  std::array<double, 3> numbers{};
  for (double& number : numbers) number = in.number<double>();
  return {.name = texts[0],
          .entity = texts[1],
          .layer = texts[2],
          .colour = texts[3],
          .free = free,
          .exact = exact,
          .deviation = numbers[0],
          .pipe_radius = numbers[1],
          .bore_radius = numbers[2],
          .curve = read_nurbs_curve(in)};
}

void write(Writer& out, const Diagnostic& diagnostic) {
  out.number(static_cast<int>(diagnostic.severity));
  out.text(diagnostic.where);
  out.text(diagnostic.message);
}

Diagnostic read_diagnostic(Reader& in) {
  const int severity = in.number<int>();
  if (severity < static_cast<int>(Severity::note) || severity > static_cast<int>(Severity::error))
    Reader::fail();
  std::string where = in.text();
  return {static_cast<Severity>(severity), std::move(where), in.text()};
}

}  // namespace

std::string to_bytes(const ImportReport& report) {
  Writer out;
  out.text(report.file);
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
  Reader in(bytes);
  ImportReport report;
  report.file = in.text();
  report.unit = in.text();
  report.unit_in_metres = in.number<double>();
  report.resolution = in.number<double>();
  const std::size_t curves = in.count(1);
  for (std::size_t i = 0; i < curves; ++i) report.curves.push_back(read_imported_curve(in));
  const std::size_t diagnostics = in.count(1);
  for (std::size_t i = 0; i < diagnostics; ++i) report.diagnostics.push_back(read_diagnostic(in));
  if (!in.at_end()) Reader::fail();
  return report;
}

}  // namespace nurbeam
