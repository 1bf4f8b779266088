#include "cad_import/report/request.h"

#include "cad_import/report/bytes.h"

namespace nurbeam {
namespace {

void write(ByteWriter& out, const NamedCurve& curve) {
  out.text(curve.name);
  nurbeam::write(out, curve.curve);
  for (const std::string& text : {curve.part, curve.layer, curve.colour}) out.text(text);
}
NamedCurve read_named_curve(ByteReader& in) {
  std::string name = in.text();
  NurbsCurve curve = read_nurbs_curve(in);
  std::string part = in.text(), layer = in.text();
  return {std::move(name), std::move(curve), std::move(part), std::move(layer), in.text()};
}

void write(ByteWriter& out, const NamedPipe& pipe) {
  write(out, pipe.axis);
  out.number(pipe.radius);
  out.number(pipe.bore);
}
NamedPipe read_named_pipe(ByteReader& in) {
  NamedCurve axis = read_named_curve(in);
  const double radius = in.number<double>();
  return {std::move(axis), radius, in.number<double>()};
}

void write(ByteWriter& out, const SweptCubic& cubic) {
  for (const NurbsCurve& rail : cubic.rails) nurbeam::write(out, rail);
  for (const double weight : cubic.weights) out.number(weight);
}
SweptCubic read_swept_cubic(ByteReader& in) {
  NurbsCurve a = read_nurbs_curve(in), b = read_nurbs_curve(in), c = read_nurbs_curve(in),
             d = read_nurbs_curve(in);
  SweptCubic cubic{{std::move(a), std::move(b), std::move(c), std::move(d)}, {}};
  for (double& weight : cubic.weights) weight = in.number<double>();
  return cubic;
}

void write(ByteWriter& out, const DeformedCurve& curve) {
  nurbeam::write(out, curve.drawn);
  nurbeam::write(out, curve.deformed);
  out.text(curve.name);
  out.number(curve.beside);
}
DeformedCurve read_deformed_curve(ByteReader& in) {
  NurbsCurve drawn = read_nurbs_curve(in), deformed = read_nurbs_curve(in);
  std::string name = in.text();
  return {std::move(drawn), std::move(deformed), std::move(name), in.number<char>() != 0};
}

template <class Item>
void write_list(ByteWriter& out, const std::vector<Item>& items) {
  out.count(items.size());
  for (const Item& item : items) write(out, item);
}
template <class Read>
auto read_list(ByteReader& in, Read read) {
  std::vector<decltype(read(in))> items;
  const std::size_t count = in.count(1);
  for (std::size_t i = 0; i < count; ++i) items.push_back(read(in));
  return items;
}

void write(ByteWriter& out, const SweptProfile& profile) {
  out.text(profile.name);
  out.text(profile.part);
  out.count(profile.loops.size());
  for (const std::vector<SweptCubic>& loop : profile.loops) write_list(out, loop);
  out.number(profile.volume);
}
SweptProfile read_swept_profile(ByteReader& in) {
  std::string name = in.text(), part = in.text();
  auto loops = read_list(in, [](ByteReader& from) { return read_list(from, read_swept_cubic); });
  return {std::move(name), std::move(part), std::move(loops), in.number<double>()};
}

void write(ByteWriter& out, const NamedSolid& solid) {
  out.number(static_cast<char>(solid.index()));
  std::visit([&](const auto& of_kind) { write(out, of_kind); }, solid);
}
NamedSolid read_named_solid(ByteReader& in) {
  if (in.number<char>() == 0) return read_named_pipe(in);
  return read_swept_profile(in);
}

void write(ByteWriter& out, const ReadRequest& request) {
  out.text(request.file.string());
  out.number(request.tolerance);
}
void write(ByteWriter& out, const WriteCurvesRequest& request) {
  out.number(static_cast<int>(request.format));
  out.number(static_cast<int>(request.unit));
  out.number(static_cast<int>(request.schema));
  write_list(out, request.curves);
}
void write(ByteWriter& out, const WriteFilesRequest& request) {
  out.count(request.files.size());
  for (const WriteCurvesRequest& file : request.files) write(out, file);
}
void write(ByteWriter& out, const WriteSolidsRequest& request) {
  out.number(static_cast<int>(request.format));
  out.number(static_cast<int>(request.unit));
  out.number(static_cast<int>(request.schema));
  out.count(request.solids.size());
  for (const NamedSolid& solid : request.solids) write(out, solid);
}
void write(ByteWriter& out, const ExchangeRequest& request) {
  out.text(request.source.string());
  write_list(out, request.curves);
}

template <class Choice>
Choice read_choice(ByteReader& in, Choice last) {
  const int choice = in.number<int>();
  if (choice < 0 || choice > static_cast<int>(last)) ByteReader::fail();
  return static_cast<Choice>(choice);
}

WriteCurvesRequest read_write_curves(ByteReader& in) {
  const CadFormat format = read_choice(in, last_format);
  const LengthUnit unit = read_choice(in, LengthUnit::inch);
  const StepSchema schema = read_choice(in, StepSchema::ap242);
  return {format, read_list(in, read_named_curve), unit, schema};
}

}  // namespace

std::string to_bytes(const CadRequest& request) {
  ByteWriter out;
  out.count(request.index());
  std::visit([&](const auto& asked) { write(out, asked); }, request);
  return std::move(out).bytes();
}

CadRequest request_from_bytes(const std::string& bytes) {
  ByteReader in(bytes);
  switch (in.number<std::uint64_t>()) {
    case 0: {
      std::string file = in.text();
      return ReadRequest{std::move(file), in.number<double>()};
    }
    case 1:
      return read_write_curves(in);
    case 2: {
      const CadFormat format = read_choice(in, last_format);
      const LengthUnit unit = read_choice(in, LengthUnit::inch);
      const StepSchema schema = read_choice(in, StepSchema::ap242);
      return WriteSolidsRequest{format, read_list(in, read_named_solid), unit, schema};
    }
    case 3: {
      std::string source = in.text();
      return ExchangeRequest{std::move(source), read_list(in, read_deformed_curve)};
    }
    case 4:
      return WriteFilesRequest{read_list(in, read_write_curves)};
    default:
      ByteReader::fail();
  }
}

std::string to_bytes(const std::vector<std::string>& texts) {
  ByteWriter out;
  out.count(texts.size());
  for (const std::string& text : texts) out.text(text);
  return std::move(out).bytes();
}

std::vector<std::string> texts_from_bytes(const std::string& bytes) {
  ByteReader in(bytes);
  return read_list(in, [](ByteReader& from) { return from.text(); });
}

std::string to_bytes(const Exchanged& exchanged) {
  ByteWriter out;
  out.count(exchanged.warnings.size());
  for (const std::string& warning : exchanged.warnings) out.text(warning);
  out.text(exchanged.text);
  return std::move(out).bytes();
}

Exchanged exchanged_from_bytes(const std::string& bytes) {
  ByteReader in(bytes);
  std::vector<std::string> warnings = read_list(in, [](ByteReader& from) { return from.text(); });
  return {std::move(warnings), in.text()};
}

}  // namespace nurbeam
