#include "cad_import/iges/iges_text.h"

#include <Geom_BSplineCurve.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESData_BasicEditor.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_LevelListEntity.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESGeom_BSplineCurve.hxx>
#include <IGESGraph_Color.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfXYZ.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace nurbeam {
namespace {

constexpr std::size_t label_length = 8;
constexpr int kVersion5_3 = 11;

struct UnitInFile {
  int flag;
  const char* name;
  double per_metre;
};

UnitInFile iges_unit(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return {6, "M", 1};
    case LengthUnit::millimetre:
      return {2, "MM", 1000};
    case LengthUnit::inch:
      return {1, "INCH", 1 / 0.0254};
  }
  throw std::invalid_argument("unknown length unit");
}

Handle(TCollection_HAsciiString) hollerith(const std::string& text) {
  return new TCollection_HAsciiString(text.c_str());
}

bool is_ascii(const std::string& text) {
  return std::all_of(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x80; });
}

Eigen::Matrix3Xd poles_of(const NurbsCurve& curve, double units_per_metre) {
  const Eigen::Matrix4Xd& points = curve.control_points();
  return (points.topRows<3>().array().rowwise() / points.row(3).array() * units_per_metre).matrix();
}

// What arithmetic leaves between places that are one.
double round_off(const Eigen::Matrix3Xd& poles) {
  const double extent = (poles.colwise() - poles.col(0)).colwise().norm().maxCoeff();
  return std::max(1e-12 * extent, 4e-15 * poles.cwiseAbs().maxCoeff());
}

// The unit normal of the one plane that the poles lie in; nothing where they lie in none, or in a line.
std::optional<Eigen::Vector3d> normal_of(const Eigen::Matrix3Xd& poles) {
  const Eigen::Matrix3Xd from_first = poles.colwise() - poles.col(0);
  Eigen::Index farthest = 0, widest = 0;
  from_first.colwise().squaredNorm().maxCoeff(&farthest);
  const Eigen::Vector3d along = from_first.col(farthest).normalized();
  const Eigen::Matrix3Xd across = from_first - along * (along.transpose() * from_first);
  across.colwise().squaredNorm().maxCoeff(&widest);
  const double near = round_off(poles);
  if (across.col(widest).norm() <= near) return {};
  const Eigen::Vector3d normal = along.cross(across.col(widest)).normalized();
  if ((normal.transpose() * from_first).cwiseAbs().maxCoeff() > near) return {};
  return normal;
}

// The entity itself, made without OpenCASCADE's translator, which takes every shape for one in millimetres.
Handle(IGESGeom_BSplineCurve) entity126(const NurbsCurve& curve, double units_per_metre) {
  const int degree = curve.degree();
  const std::vector<double>& values = curve.knots().knots();
  const int knot_count = static_cast<int>(values.size());
  const Handle(TColStd_HArray1OfReal) knots = new TColStd_HArray1OfReal(-degree, knot_count - degree - 1);
  for (int i = 0; i < knot_count; ++i) knots->SetValue(i - degree, values[i]);
  const Eigen::Matrix3Xd places = poles_of(curve, units_per_metre);
  const int last = static_cast<int>(places.cols()) - 1;
  const Handle(TColStd_HArray1OfReal) weights = new TColStd_HArray1OfReal(0, last);
  const Handle(TColgp_HArray1OfXYZ) poles = new TColgp_HArray1OfXYZ(0, last);
  for (int i = 0; i <= last; ++i) {
    poles->SetValue(i, gp_XYZ(places(0, i), places(1, i), places(2, i)));
    weights->SetValue(i, curve.control_points()(3, i));
  }
  const std::optional<Eigen::Vector3d> normal = normal_of(places);
  const Eigen::Vector3d n = normal.value_or(Eigen::Vector3d::Zero());
  const Handle(IGESGeom_BSplineCurve) entity = new IGESGeom_BSplineCurve;
  entity->Init(last, degree, /*aPlanar=*/normal.has_value(),
               /*aClosed=*/is_closed(curve, round_off(places) / units_per_metre), !curve.is_rational(),
               /*aPeriodic=*/Standard_False, knots, weights, poles, curve.knots().start(),
               curve.knots().end(), gp_XYZ(n.x(), n.y(), n.z()));
  return entity;
}

// Its level, where its layer is the number of one, and its colour.
void add_look(const NamedCurve& named, IGESData_IGESEntity& entity, IGESData_IGESModel& model) {
  if (const int level = level_number(named.layer); level > 0) entity.InitLevel(nullptr, level);
  if (!is_colour(named.colour)) return;
  const auto [red, green, blue] = parts_of_colour(named.colour);
  const Handle(IGESGraph_Color) colour = new IGESGraph_Color;
  constexpr double percent = 100.0 / 255;
  colour->Init(red * percent, green * percent, blue * percent, nullptr);
  model.AddEntity(colour);
  entity.InitColor(colour);
}

void add(const NamedCurve& named, double units_per_metre, IGESData_IGESModel& model) {
  if (const int degree = named.curve.degree(), most = Geom_BSplineCurve::MaxDegree(); degree > most)
    throw std::runtime_error("the curve '" + named.name + "' is of degree " + std::to_string(degree) +
                             ", which few programs read; the highest is " + std::to_string(most));
  const Handle(IGESGeom_BSplineCurve) entity = entity126(named.curve, units_per_metre);
  model.AddEntity(entity);
  add_look(named, *entity, model);
  if (named.name.empty()) return;
  const Handle(IGESBasic_Name) name = new IGESBasic_Name;
  name->Init(1, hollerith(named.name));
  if (is_ascii(named.name)) entity->SetLabel(hollerith(named.name.substr(0, label_length)));
  entity->AddProperty(name);
  model.AddEntity(name);
}

void set_global_section(const UnitInFile& unit, IGESData_IGESModel& model) {
  IGESData_GlobalSection global = model.GlobalSection();
  global.SetUnitFlag(unit.flag);
  global.SetUnitName(hollerith(unit.name));
  global.SetSystemId(hollerith("nurbeam"));
  global.SetSendName(hollerith("curves"));
  global.SetFileName(hollerith("curves"));
  for (const auto set_time : {&IGESData_GlobalSection::SetDate, &IGESData_GlobalSection::SetLastChangeDate})
    (global.*set_time)(hollerith("19700101.000000"));  // equal runs write equal files
  global.SetIGESVersion(kVersion5_3);
  global.SetResolution(1e-9 * unit.per_metre);
  model.SetGlobalSection(global);
}

std::string text(const Handle(IGESData_IGESModel) & model) {
  const Handle(IGESData_Protocol) protocol = IGESSelect_WorkLibrary::DefineProtocol();
  IGESData_BasicEditor(model, protocol).ComputeStatus();
  IGESData_IGESWriter out(model);
  // 17 digits, which give a number back; with one more OpenCASCADE overruns its buffer at "-1.2...E-101".
  out.FloatWriter().SetFormat("%.16E");
  out.FloatWriter().SetZeroSuppress(Standard_False);
  out.SendModel(protocol);
  std::ostringstream stream;
  if (!out.Print(stream)) throw std::runtime_error("OpenCASCADE did not print the IGES model");
  return stream.str();
}

}  // namespace

std::string iges_text(const std::vector<NamedCurve>& curves, LengthUnit unit) {
  try {
    IGESControl_Controller::Init();
    const UnitInFile in_file = iges_unit(unit);
    const Handle(IGESData_IGESModel) model = new IGESData_IGESModel;
    set_global_section(in_file, *model);
    for (const NamedCurve& curve : curves) add(curve, in_file.per_metre, *model);
    return text(model);
  } catch (const Standard_Failure& e) {
    throw std::runtime_error(std::string("OpenCASCADE cannot write a curve: ") + e.GetMessageString());
  }
}

}  // namespace nurbeam
