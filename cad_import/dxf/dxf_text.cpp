#include "cad_import/dxf/dxf_text.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdio>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

#include "cad_import/dxf/layer_names.h"

namespace nurbeam {
namespace {

struct DxfUnit {
  int insunits, is_metric;
  double per_metre;
};

DxfUnit dxf_unit(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return {6, 1, 1};
    case LengthUnit::millimetre:
      return {4, 1, 1000};
    case LengthUnit::inch:
      return {1, 0, 1 / 0.0254};
  }
  throw std::invalid_argument("unknown length unit");
}

/// Pairs of a group code and a value, and handles, which no two objects share.
class DxfText {
 public:
  void add(int code, std::string_view value) {
    text_ += std::to_string(code) + "\n";
    text_ += value;
    text_ += '\n';
  }
  void add(int code, int value) { add(code, std::to_string(value)); }
  void add(int code, double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    add(code, std::string_view(text));
  }
  void add(int code, const Eigen::Vector3d& point) {
    for (int i = 0; i < 3; ++i) add(code + 10 * i, point(i));
  }
  void classes(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) add(100, name);
  }
  /// The object begun last gets a handle, which is returned, and that of what holds it.
  std::string identify(std::string_view holder, int handle_code = 5) {
    const std::string handle = hexadecimal(next_++);
    add(handle_code, handle);
    add(330, holder);
    return handle;
  }
  /// Above all handles given.
  std::string next_handle() const { return hexadecimal(next_); }
  const std::string& text() const { return text_; }

 private:
  static std::string hexadecimal(unsigned value) {
    char text[16];
    std::snprintf(text, sizeof text, "%X", value);
    return text;
  }
  std::string text_;
  unsigned next_ = 1;
};

constexpr std::string_view nothing = "0";  // the handle of no object

void begin_section(DxfText& out, std::string_view name) {
  out.add(0, "SECTION");
  out.add(2, name);
}

void add_variable(DxfText& out, std::string_view name, int code, std::string_view value) {
  out.add(9, name);
  out.add(code, value);
}

// ------------------------------------------------------------------------------------------------ tables

/// What a symbol table holds: entries of one kind, and the pairs that each of them has.
struct Table {
  std::string_view kind, entry_class;
  std::vector<std::string> names = {};
  std::vector<std::pair<int, std::string>> details = {};
};

/// The handles of its entries.
std::vector<std::string> add_table(DxfText& out, const Table& table) {
  out.add(0, "TABLE");
  out.add(2, table.kind);
  const std::string handle = out.identify(nothing);
  out.add(100, "AcDbSymbolTable");
  out.add(70, static_cast<int>(table.names.size()));
  const bool dimensions = table.kind == "DIMSTYLE";
  if (dimensions) out.add(100, "AcDbDimStyleTable");
  std::vector<std::string> handles;
  for (const std::string& name : table.names) {
    out.add(0, table.kind);
    handles.push_back(out.identify(handle, dimensions ? 105 : 5));
    out.classes({"AcDbSymbolTableRecord", table.entry_class});
    out.add(2, name);
    for (const auto& [code, value] : table.details) out.add(code, value);
  }
  out.add(0, "ENDTAB");
  return handles;
}

/// Those that every drawing has; the handle of the block record of the model space.
std::string add_tables(DxfText& out, const std::vector<std::string>& layers) {
  begin_section(out, "TABLES");
  add_table(out, {"VPORT", "AcDbViewportTableRecord"});
  add_table(out, {"LTYPE",
                  "AcDbLinetypeTableRecord",
                  {"ByBlock", "ByLayer", "Continuous"},
                  {{70, "0"}, {3, ""}, {72, "65"}, {73, "0"}, {40, "0"}}});
  add_table(out, {"LAYER", "AcDbLayerTableRecord", layers, {{70, "0"}, {62, "7"}, {6, "Continuous"}}});
  add_table(out, {"STYLE",
                  "AcDbTextStyleTableRecord",
                  {"Standard"},
                  {{70, "0"}, {40, "0"}, {41, "1"}, {50, "0"}, {71, "0"}, {42, "1"}, {3, "txt"}, {4, ""}}});
  add_table(out, {"VIEW", "AcDbViewTableRecord"});
  add_table(out, {"UCS", "AcDbUCSTableRecord"});
  add_table(out, {"APPID", "AcDbRegAppTableRecord", {"ACAD"}, {{70, "0"}}});
  add_table(out, {"DIMSTYLE", "AcDbDimStyleTableRecord", {"Standard"}, {{70, "0"}}});
  const std::vector<std::string> blocks =
      add_table(out, {"BLOCK_RECORD", "AcDbBlockTableRecord", {"*Model_Space", "*Paper_Space"}});
  out.add(0, "ENDSEC");
  begin_section(out, "BLOCKS");
  for (const std::string& block : blocks) {
    const bool is_paper = block == blocks.back();
    const std::string_view name = is_paper ? "*Paper_Space" : "*Model_Space";
    out.add(0, "BLOCK");
    out.identify(block);
    out.add(100, "AcDbEntity");
    if (is_paper) out.add(67, 1);
    out.add(8, "0");
    out.add(100, "AcDbBlockBegin");
    out.add(2, name);
    out.add(70, 0);
    out.add(10, Eigen::Vector3d(0, 0, 0));
    out.add(3, name);
    out.add(1, "");
    out.add(0, "ENDBLK");
    out.identify(block);
    out.add(100, "AcDbEntity");
    if (is_paper) out.add(67, 1);
    out.add(8, "0");
    out.add(100, "AcDbBlockEnd");
  }
  out.add(0, "ENDSEC");
  return blocks.front();
}

// ---------------------------------------------------------------------------------------------- entities

void add_spline(DxfText& out, const NurbsCurve& curve, const Eigen::Matrix3Xd& points) {
  constexpr int closed = 1, rational = 4;
  const std::vector<double>& knots = curve.knots().knots();
  out.add(100, "AcDbSpline");
  out.add(70, (is_closed(curve, 0) ? closed : 0) + (curve.is_rational() ? rational : 0));
  out.add(71, curve.degree());
  out.add(72, static_cast<int>(knots.size()));
  out.add(73, static_cast<int>(points.cols()));
  out.add(74, 0);
  for (const double knot : knots) out.add(40, knot);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    out.add(10, Eigen::Vector3d(points.col(i)));
    if (curve.is_rational()) out.add(41, curve.control_points()(3, i));
  }
}

void add_line(DxfText& out, const Eigen::Matrix3Xd& points) {
  out.add(100, "AcDbLine");
  out.add(10, Eigen::Vector3d(points.col(0)));
  out.add(11, Eigen::Vector3d(points.col(1)));
}

/// A true colour, and the nearest of the first seven for programs that know only these.
void add_colour(DxfText& out, const std::string& colour) {
  constexpr std::array<int, 8> numbers{7, 1, 3, 2, 5, 6, 4, 7};  // by which of red, green and blue are bright
  const auto [red, green, blue] = parts_of_colour(colour);
  const int bright = red / 128 + 2 * (green / 128) + 4 * (blue / 128);
  out.add(62, numbers[static_cast<std::size_t>(bright)]);
  out.add(420, (red << 16) + (green << 8) + blue);
}

void add_entity(DxfText& out, const NamedCurve& named, const std::string& layer, double per_metre,
                std::string_view model_space) {
  const NurbsCurve& curve = named.curve;
  const Eigen::Matrix3Xd points = per_metre * curve.control_points().colwise().hnormalized();
  const bool is_line = curve.degree() == 1 && points.cols() == 2;
  out.add(0, is_line ? "LINE" : "SPLINE");
  out.identify(model_space);
  out.add(100, "AcDbEntity");
  out.add(8, layer);
  if (is_colour(named.colour)) add_colour(out, named.colour);
  if (is_line)
    add_line(out, points);
  else
    add_spline(out, curve, points);
}

void add_objects(DxfText& out) {
  begin_section(out, "OBJECTS");
  out.add(0, "DICTIONARY");
  const std::string root = out.identify(nothing);
  out.add(100, "AcDbDictionary");
  out.add(281, 1);
  out.add(3, "ACAD_GROUP");
  out.add(350, out.next_handle());
  out.add(0, "DICTIONARY");
  out.identify(root);
  out.add(100, "AcDbDictionary");
  out.add(281, 1);
  out.add(0, "ENDSEC");
}

std::string header(const DxfUnit& unit, const std::string& next_handle) {
  DxfText out;
  out.add(999, "nurbeam");
  begin_section(out, "HEADER");
  add_variable(out, "$ACADVER", 1, "AC1021");
  add_variable(out, "$HANDSEED", 5, next_handle);
  add_variable(out, "$INSUNITS", 70, std::to_string(unit.insunits));
  add_variable(out, "$MEASUREMENT", 70, std::to_string(unit.is_metric));
  out.add(0, "ENDSEC");
  return out.text();
}

}  // namespace

std::string dxf_text(const std::vector<NamedCurve>& curves, LengthUnit unit) {
  const DxfUnit in_file = dxf_unit(unit);
  const std::vector<std::string> layer_of = layer_names(curves);
  std::vector<std::string> layers{"0"};
  std::unordered_set<std::string> known{"0"};
  for (const std::string& layer : layer_of)
    if (known.insert(layer).second) layers.push_back(layer);
  DxfText out;
  begin_section(out, "CLASSES");
  out.add(0, "ENDSEC");
  const std::string model_space = add_tables(out, layers);
  begin_section(out, "ENTITIES");
  for (std::size_t i = 0; i < curves.size(); ++i)
    add_entity(out, curves[i], layer_of[i], in_file.per_metre, model_space);
  out.add(0, "ENDSEC");
  add_objects(out);
  out.add(0, "EOF");
  return header(in_file, out.next_handle()) + out.text();
}

}  // namespace nurbeam
