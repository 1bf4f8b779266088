#include "cad_import/step/step_text.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_GeometricSetSelect.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/closed_spline.h"
#include "cad_import/step/curve_looks.h"
#include "cad_import/step/encoded_text.h"
#include "cad_import/step/local_origin.h"
#include "cad_import/step/spine.h"
#include "cad_import/step/swept_solid.h"

namespace nurbeam {
namespace {

/// No printer of OpenCASCADE writes to stdout while this lives.
class SilentMessenger {
 public:
  SilentMessenger() { Message::DefaultMessenger()->ChangePrinters().Clear(); }
  ~SilentMessenger() { Message::DefaultMessenger()->ChangePrinters() = printers_; }
  SilentMessenger(const SilentMessenger&) = delete;
  SilentMessenger& operator=(const SilentMessenger&) = delete;

 private:
  Message_SequenceOfPrinters printers_ = Message::DefaultMessenger()->Printers();
};

void set(const char* parameter, const char* value) {
  if (!Interface_Static::SetCVal(parameter, value))
    throw std::runtime_error(std::string("OpenCASCADE refuses ") + parameter + " = " + value);
}

const char* step_unit(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return "M";
    case LengthUnit::millimetre:
      return "MM";
    case LengthUnit::inch:
      return "INCH";
  }
  throw std::invalid_argument("unknown length unit");
}

// Global state of OpenCASCADE, which anything in the process may have changed.
void set_parameters(LengthUnit unit, StepSchema schema, bool assembly) {
  STEPControl_Controller::Init();
  set("xstep.cascade.unit", "MM");
  set("write.step.unit", step_unit(unit));
  set("write.step.schema", schema == StepSchema::ap242 ? "AP242DIS" : "AP214IS");
  set("write.step.assembly", assembly ? "On" : "Off");
}

TopoDS_Compound compound(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes) builder.Add(all, shape);
  return all;
}

// One shape for all parts: a part alone, or the assembly of several, or of one that is made elsewhere than
// where it stands.
bool needs_assembly(const std::vector<TopoDS_Shape>& parts) {
  return parts.size() > 1 || !parts[0].Location().IsIdentity();
}

TopoDS_Shape assembled(const std::vector<TopoDS_Shape>& parts) {
  return needs_assembly(parts) ? compound(parts) : parts[0];
}

// The translated curves, in order: OpenCASCADE makes one set of curves of each edge.
std::vector<Handle(StepGeom_Curve)> curves_of(const StepData_StepModel& model) {
  std::vector<Handle(StepGeom_Curve)> curves;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto set_of_curves = Handle(StepShape_GeometricSet)::DownCast(model.Value(i));
    const int count = set_of_curves.IsNull() ? 0 : set_of_curves->NbElements();
    for (int k = 1; k <= count; ++k) curves.push_back(set_of_curves->ElementsValue(k).Curve());
  }
  return curves;
}

// The name on the curve itself and on the trimmed curve that stands for it in the set.
void give_names(const StepData_StepModel& model, const std::vector<NamedCurve>& curves) {
  const std::vector<Handle(StepGeom_Curve)> translated = curves_of(model);
  if (translated.size() != curves.size())
    throw std::runtime_error("OpenCASCADE did not translate all curves to STEP");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Handle(TCollection_HAsciiString) name = new TCollection_HAsciiString(curves[i].name.c_str());
    translated[i]->SetName(name);
    if (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(translated[i]))
      trimmed->BasisCurve()->SetName(name);
  }
}

Handle(TCollection_HAsciiString) ascii(const std::string& text) {
  return new TCollection_HAsciiString(text.c_str());
}

const std::string& part_name(const NamedCurve& curve) { return curve.part.empty() ? curve.name : curve.part; }

// Under their names: the products, that of an assembly first, and where it uses them.
void name_products(const StepData_StepModel& model, const std::vector<std::string>& parts, bool assembly) {
  std::vector<Handle(StepBasic_Product)> products;
  std::vector<Handle(StepRepr_NextAssemblyUsageOccurrence)> uses;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (const auto product = Handle(StepBasic_Product)::DownCast(model.Value(i))) products.push_back(product);
    if (const auto use = Handle(StepRepr_NextAssemblyUsageOccurrence)::DownCast(model.Value(i)))
      uses.push_back(use);
  }
  const std::size_t above = assembly ? 1 : 0;
  if (products.size() != parts.size() + above || uses.size() != above * parts.size())
    throw std::runtime_error("OpenCASCADE did not make one product of each beam");
  for (std::size_t i = 0; i < products.size(); ++i) {
    const Handle(TCollection_HAsciiString) name = ascii(i < above ? "beams" : parts[i - above]);
    products[i]->SetId(name);
    products[i]->SetName(name);
  }
  for (std::size_t i = 0; i < uses.size(); ++i) uses[i]->SetName(ascii(parts[i]));
}

void describe(const Handle(StepData_StepModel) & model, const std::string& name) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(ascii(name));
  header.SetTimeStamp(ascii("1970-01-01T00:00:00"));  // equal runs write equal files
  header.SetAuthorValue(1, ascii(""));
  header.SetOrganizationValue(1, ascii(""));
  header.SetOriginatingSystem(ascii("nurbeam"));
  header.SetPreprocessorVersion(ascii("nurbeam"));
  header.SetDescriptionValue(1, ascii("deformed beams"));
}

// 17 digits, which give a number back; with one more OpenCASCADE overruns its buffer at "-1.2...E-101".
constexpr const char* all_digits_format = "%.16E";

std::string text(STEPControl_Writer& writer, const char* number_format = all_digits_format) {
  unmark_closed_splines(*writer.Model());
  StepData_StepWriter out(writer.Model());
  out.FloatWriter().SetFormat(number_format);
  out.FloatWriter().SetZeroSuppress(Standard_False);
  out.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream stream;
  if (!out.Print(stream)) throw std::runtime_error("OpenCASCADE did not print the STEP model");
  return with_encoded_apostrophes(
      step_encoded(stream.str()));  // names, whose backslashes OpenCASCADE has doubled
}

// The solids of the model stand in the order in which they were transferred.
void give_names(const StepData_StepModel& model, const std::vector<NamedSolid>& solids) {
  std::size_t named = 0;
  for (int i = 1; i <= model.NbEntities() && named < solids.size(); ++i)
    if (const auto solid = Handle(StepShape_ManifoldSolidBrep)::DownCast(model.Value(i)))
      solid->SetName(ascii(names_of(solids[named++]).first));
  if (named != solids.size()) throw std::runtime_error("OpenCASCADE did not translate all solids to STEP");
}

std::string text_of_solids(const std::vector<NamedSolid>& solids,
                           const std::function<TopoDS_Shape(const NamedSolid&)>& shape_of, LengthUnit unit,
                           StepSchema schema, const char* number_format = all_digits_format) {
  std::vector<TopoDS_Shape> parts;
  std::vector<std::string> names;
  for (const NamedSolid& solid : solids) {
    parts.push_back(shape_of(solid));
    const auto [name, part] = names_of(solid);
    names.push_back(part.empty() ? name : part);
  }
  set_parameters(unit, schema, needs_assembly(parts));
  STEPControl_Writer writer;
  if (writer.Transfer(assembled(parts), STEPControl_AsIs) != IFSelect_RetDone)
    throw std::runtime_error("OpenCASCADE cannot translate the solids to STEP");
  give_names(*writer.Model(), solids);
  name_products(*writer.Model(), names, needs_assembly(parts));
  describe(writer.Model(), names[0]);
  return text(writer, number_format);
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

// Whether OpenCASCADE, left alone, reads all of it as valid shapes of this volume [mm^3].
bool is_read_as_valid(const std::string& text, double volume) {
  constexpr double volume_within = 1e-5;
  try {
    std::istringstream stream(text);
    STEPControl_Reader reader;
    if (reader.ReadStream("solids", stream) != IFSelect_RetDone) return false;
    reader.TransferRoots();
    const TopoDS_Shape shape = reader.OneShape();
    return !shape.IsNull() && BRepCheck_Analyzer(shape).IsValid() &&
           std::abs(volume_of(shape) - volume) <= volume_within * volume;
  } catch (const Standard_Failure&) {
    return false;
  }
}

// Of solids far from the origin, the first text of fewer and fewer digits, down to 13,, that is read as
// valid: what readers find apart by more than their own digits they give tolerances. Else they are placed as
// a whole.
std::string text_of_far_solids(const std::vector<NamedSolid>& solids, LengthUnit unit, StepSchema schema) {
  double volume = 0;
  for (const NamedSolid& solid : solids) volume += volume_of(swept_solid(solid));
  for (const char* format : {all_digits_format, "%.13E", "%.12E"}) {
    std::string in_place = text_of_solids(solids, swept_solid_in_place, unit, schema, format);
    if (is_read_as_valid(in_place, volume)) return in_place;
  }
  return text_of_solids(solids, swept_solid, unit, schema);
}

}  // namespace

std::string step_solid_text(const std::vector<NamedSolid>& solids, LengthUnit unit, StepSchema schema) {
  try {
    const SilentMessenger silence;
    const bool far = std::any_of(solids.begin(), solids.end(),
                                 [](const NamedSolid& solid) { return !local_origin(solid).isZero(); });
    return far ? text_of_far_solids(solids, unit, schema) : text_of_solids(solids, swept_solid, unit, schema);
  } catch (const Standard_Failure& e) {
    throw std::runtime_error(std::string("OpenCASCADE cannot sweep a solid (") + e.DynamicType()->Name() +
                             " " + e.GetMessageString() + ")");
  }
}

std::string step_text(const std::vector<NamedCurve>& curves, LengthUnit unit, StepSchema schema) {
  try {
    const SilentMessenger silence;
    std::vector<TopoDS_Shape> parts;
    std::vector<std::string> names;
    for (const NamedCurve& curve : curves) {
      parts.push_back(edge(curve));
      names.push_back(part_name(curve));
    }
    set_parameters(unit, schema, needs_assembly(parts));
    STEPControl_Writer writer;
    if (writer.Transfer(assembled(parts), STEPControl_AsIs) != IFSelect_RetDone)
      throw std::runtime_error("OpenCASCADE cannot translate the curves to STEP");
    give_names(*writer.Model(), curves);
    name_products(*writer.Model(), names, needs_assembly(parts));
    describe(writer.Model(), names[0]);
    std::vector<int> instances;
    for (const Handle(StepGeom_Curve) & curve : curves_of(*writer.Model()))
      instances.push_back(writer.Model()->Number(curve));
    return with_looks(text(writer), instances, curves);
  } catch (const Standard_Failure& e) {
    throw std::runtime_error(std::string("OpenCASCADE cannot write a curve: ") + e.GetMessageString());
  }
}

}  // namespace nurbeam
