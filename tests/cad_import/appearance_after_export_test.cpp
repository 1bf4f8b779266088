// What a CAD program shows of a STEP file before and after a curve was exchanged in it, as OpenCASCADE's XCAF
// reader tells it: places, names, colours and layers.

#include <gtest/gtest.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BezierCurve.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <array>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <set>

#include "cad_import/export_into_step.h"
#include "cad_import/import_curves.h"
#include "cad_import/step/step_instances.h"
#include "tests/cad_import/arch.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_parameter.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

// ------------------------------------------------------------------------------- what XCAF tells of a file

Handle(TDocStd_Document) empty_document() {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  return new TDocStd_Document("BinXCAF");
}

Handle(TDocStd_Document) document_of(const fs::path& file) {
  Handle(TDocStd_Document) document = empty_document();
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetLayerMode(true);
  reader.SetNameMode(true);
  EXPECT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
  EXPECT_TRUE(reader.Transfer(document));
  return document;
}

/// A shape that has a label in the document, at one of its places.
struct Shown {
  std::string path;                    // "rig/harness 1: harness"
  int type;                            // TopAbs_ShapeEnum
  std::array<std::string, 3> colours;  // general, of surfaces, of curves
  std::vector<std::string> layers;
  std::vector<gp_Pnt> points;  // start, middle and end of each of its edges, in the world

  bool looks_like(const Shown& other) const {
    return path == other.path && type == other.type && colours == other.colours && layers == other.layers;
  }
  /// The largest distance from the same point of the other one.
  double distance(const Shown& other) const {
    if (points.size() != other.points.size()) return 1e9;
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      largest = std::max(largest, points[i].Distance(other.points[i]));
    return largest;
  }
};

class Document {
 public:
  explicit Document(const fs::path& file) : document_(document_of(file)) {}

  std::vector<Shown> shown() const {
    std::vector<Shown> all;
    TDF_LabelSequence roots;
    shapes_->GetFreeShapes(roots);
    for (const TDF_Label& root : roots) add(root, name(root), TopLoc_Location(), all);
    return all;
  }

 private:
  static std::string name(const TDF_Label& label) {
    Handle(TDataStd_Name) found;
    if (!label.FindAttribute(TDataStd_Name::GetID(), found)) return "";
    return TCollection_AsciiString(found->Get()).ToCString();
  }
  Shown of(const TDF_Label& label, const std::string& path, const TopLoc_Location& place) const {
    Shown one{path, XCAFDoc_ShapeTool::GetShape(label).ShapeType(), {}, {}, {}};
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorGen, XCAFDoc_ColorSurf, XCAFDoc_ColorCurv}) {
      Quantity_Color colour;
      if (colours_->GetColor(label, type, colour))
        one.colours[type] = Quantity_Color::ColorToHex(colour).ToCString();
    }
    const Handle(TColStd_HSequenceOfExtendedString) layers = layers_->GetLayers(label);
    for (int i = 1; !layers.IsNull() && i <= layers->Length(); ++i)
      one.layers.emplace_back(TCollection_AsciiString(layers->Value(i)).ToCString());
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(XCAFDoc_ShapeTool::GetShape(label), TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i) {
      const BRepAdaptor_Curve curve(TopoDS::Edge(edges(i)));
      const double first = curve.FirstParameter(), last = curve.LastParameter();
      for (const double u : {first, 0.5 * (first + last), last})
        one.points.push_back(curve.Value(u).Transformed(place.Transformation()));
    }
    return one;
  }
  void add(const TDF_Label& label, const std::string& path, const TopLoc_Location& place,
           std::vector<Shown>& all) const {
    all.push_back(of(label, path, place));
    TDF_LabelSequence parts;
    XCAFDoc_ShapeTool::GetComponents(label, parts);
    for (const TDF_Label& part : parts) {
      TDF_Label product;
      XCAFDoc_ShapeTool::GetReferredShape(part, product);
      add(product, path + "/" + name(part) + ": " + name(product),
          place * XCAFDoc_ShapeTool::GetLocation(part), all);
    }
    TDF_LabelSequence details;
    XCAFDoc_ShapeTool::GetSubShapes(label, details);
    for (const TDF_Label& detail : details) all.push_back(of(detail, path + "/" + name(detail), place));
  }

  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
  Handle(XCAFDoc_ColorTool) colours_ = XCAFDoc_DocumentTool::ColorTool(document_->Main());
  Handle(XCAFDoc_LayerTool) layers_ = XCAFDoc_DocumentTool::LayerTool(document_->Main());
};

// --------------------------------------------------------------------------------- an assembly in colours

gp_Trsf placed_curve(double angle) {
  gp_Trsf turn, shift;
  turn.SetRotation(gp_Ax1(gp_Pnt(10, 20, 30), gp_Dir(1, 2, 3)), angle);
  shift.SetTranslation(gp_Vec(1000, -500, 250 * angle));
  return shift * turn;
}

Quantity_Color rgb(double red, double green, double blue) { return {red, green, blue, Quantity_TOC_sRGB}; }

/// "rig": the part "harness", four curves on three layers in four colours, and twice "bracket", a box with
/// one face in another colour.
void write_rig(const fs::path& file) {
  Handle(TDocStd_Document) document = empty_document();
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const auto layers = XCAFDoc_DocumentTool::LayerTool(document->Main());
  const BRep_Builder builder;
  TopoDS_Compound curves;
  builder.MakeCompound(curves);
  struct Drawn {
    const char* name;
    TopoDS_Edge edge;
    const char* layer;
    Quantity_Color colour;
  };
  const std::array<Drawn, 4> drawn{
      {{"cable", arch(50), "cables", rgb(1, 0.5, 0)},
       {"stay", arch(80), "cables", rgb(0, 1, 0)},
       {"hoop", BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(), 70)), "hoops", rgb(0.2, 0.4, 0.6)},
       {"brace", BRepBuilderAPI_MakeEdge(gp_Pnt(), gp_Pnt(10, 20, 30)), "braces", rgb(1, 0, 0.25)}}};
  for (const Drawn& one : drawn) builder.Add(curves, one.edge);
  const TDF_Label harness = shapes->AddShape(curves, false);
  TDataStd_Name::Set(harness, "harness");
  for (const Drawn& one : drawn) {
    const TDF_Label label = shapes->AddSubShape(harness, one.edge);
    TDataStd_Name::Set(label, one.name);
    colours->SetColor(label, one.colour, XCAFDoc_ColorCurv);
    layers->SetLayer(label, one.layer);
  }
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(100, 50, 20).Shape();
  const TDF_Label bracket = shapes->AddShape(box, false);
  TDataStd_Name::Set(bracket, "bracket");
  layers->SetLayer(bracket, "frame");
  colours->SetColor(bracket, rgb(0.8, 0.1, 0.1), XCAFDoc_ColorSurf);
  const TDF_Label face = shapes->AddSubShape(bracket, TopExp_Explorer(box, TopAbs_FACE).Current());
  colours->SetColor(face, rgb(0.9, 0.9, 0), XCAFDoc_ColorSurf);
  const TDF_Label rig = shapes->NewShape();
  TDataStd_Name::Set(rig, "rig");
  const auto place = [&](const TDF_Label& part, const char* name, double angle) {
    TDataStd_Name::Set(shapes->AddComponent(rig, part, TopLoc_Location(placed_curve(angle))), name);
  };
  place(harness, "harness 1", 0.7);
  place(bracket, "bracket left", 1.7);
  place(bracket, "bracket right", 2.7);
  shapes->UpdateAssemblies();
  STEPCAFControl_Writer writer;
  const StepParameter unit("write.step.unit", "INCH"), names("write.stepcaf.subshapes.name", "1");
  ASSERT_TRUE(writer.Transfer(document, STEPControl_AsIs));
  ASSERT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
}

TEST(AppearanceAfterExport, OfAnAssemblyInColoursIsWhatItWasAndOnlyTheCurveHasMoved) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  write_rig(source);
  const std::vector<Shown> before = Document(source).shown();
  // What the writer was told to write is there: the rig, its parts at their places, their details.
  ASSERT_EQ(before.size(), 10u);
  EXPECT_EQ(before[0].path, "rig");
  EXPECT_EQ(before[1].path, "rig/harness 1: harness");
  std::multiset<std::string> colours, layers;
  for (const Shown& one : before) {
    for (const std::string& colour : one.colours) colours.insert(colour);
    layers.insert(one.layers.begin(), one.layers.end());
  }
  for (const char* colour : {"#FF8000", "#00FF00", "#336699", "#FF0040"})
    EXPECT_EQ(colours.count(colour), 1u) << colour;
  EXPECT_EQ(colours.count("#CC1A1A") + colours.count("#E6E600"), 4u);
  EXPECT_EQ(layers, (std::multiset<std::string>{"braces", "cables", "cables", "frame", "frame", "hoops"}));

  const ImportReport drawn = import_curves(source);
  for (const char* const name : {"cable", "stay", "hoop", "brace"}) {
    SCOPED_TRACE(name);
    std::size_t chosen = 0;
    while (drawn.curves.at(chosen).name != name) ++chosen;
    const ImportedCurve& curve = drawn.curves[chosen];
    ASSERT_TRUE(export_into_step(source, target, {{curve.curve, stretched(curve.curve), name}}).empty());
    const std::vector<Shown> after = Document(target).shown();
    ASSERT_EQ(after.size(), before.size());
    int moved = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_TRUE(after[i].looks_like(before[i])) << after[i].path << " instead of " << before[i].path;
      const bool is_it = before[i].points.size() == 3 && before[i].distance(after[i]) > 1e-9;
      moved += is_it;
      // The rig and the harness hold the curve; all others stay.
      if (!is_it && i > 1) EXPECT_LE(before[i].distance(after[i]), 1e-12) << before[i].path;
      if (is_it) {
        for (const int k : {0, 2}) {
          const KnotVector& knots = curve.curve.knots();
          Eigen::Vector3d there = 1000 * curve.curve.point(k == 0 ? knots.start() : knots.end());
          there.z() *= 1.5;
          EXPECT_LE(after[i].points[k].Distance(gp_Pnt(there.x(), there.y(), there.z())), 1e-9);
        }
      }
    }
    EXPECT_EQ(moved, 1);
    const ImportReport found = import_curves(target);
    ASSERT_EQ(found.curves.size(), drawn.curves.size());
    EXPECT_EQ(found.unit, "inch");
    for (std::size_t i = 0; i < found.curves.size(); ++i) {
      EXPECT_EQ(found.curves[i].name, drawn.curves[i].name);
      EXPECT_EQ(found.curves[i].layer, drawn.curves[i].layer);
      EXPECT_EQ(found.curves[i].colour, drawn.curves[i].colour);
    }
  }
}

// -------------------------------------------------------------- what a style and a layer may be attached to

/// Two neighbours, #100 of which is exchanged; its style #120 and its layer #130 are attached to `styled`.
std::string styled_text(const std::string& curves, int styled) {
  const std::string item = "#" + std::to_string(styled);
  return step_text_of("#100,#110", curves + R"(
#110 = CIRCLE('neighbour',#11,3.);
#120 = STYLED_ITEM('',(#121),)" + item +
                                       R"();
#121 = PRESENTATION_STYLE_ASSIGNMENT((#122));
#122 = CURVE_STYLE('',#123,POSITIVE_LENGTH_MEASURE(0.1),#124);
#123 = DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous');
#124 = COLOUR_RGB('',1.,0.5,0.);
#125 = STYLED_ITEM('',(#126),#110);
#126 = PRESENTATION_STYLE_ASSIGNMENT((#127));
#127 = CURVE_STYLE('',#123,POSITIVE_LENGTH_MEASURE(0.1),#128);
#128 = DRAUGHTING_PRE_DEFINED_COLOUR('green');
#130 = PRESENTATION_LAYER_ASSIGNMENT('cables','',()" +
                                       item + R"());
#131 = PRESENTATION_LAYER_ASSIGNMENT('frame','',(#110));
#132 = MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#120,#125),#26);)");
}

/// Whether `wanted` is among what `start` is made of.
bool is_made_of(const StepInstances& step, int start, int wanted) {
  if (start == wanted) return true;
  const std::vector<int> parts = step.references(start);
  return std::any_of(parts.begin(), parts.end(), [&](int part) { return is_made_of(step, part, wanted); });
}

const std::string trimmed_arc =
    "#100 = TRIMMED_CURVE('arc',#101,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.5)),.T.,.PARAMETER.);\n"
    "#101 = CIRCLE('',#11,2.);";
const std::string brace = R"(#100 = EDGE_CURVE('brace',#102,#103,#101,.T.);
#101 = LINE('',#105,#107);
#102 = VERTEX_POINT('',#105);
#103 = VERTEX_POINT('',#106);
#105 = CARTESIAN_POINT('',(1.,0.,0.));
#106 = CARTESIAN_POINT('',(3.,0.,0.));
#107 = VECTOR('',#14,1.);)";

struct Styled {
  const char* what;
  std::string curves;
  int item;
};

class StyleAfterExport : public ::testing::TestWithParam<Styled> {};

TEST_P(StyleAfterExport, IsStillThatOfTheCurve) {
  const ScratchDirectory scratch;
  std::string text = styled_text(GetParam().curves, GetParam().item);
  if (GetParam().curves == brace) {
    text = with(text, "'neighbour',#11,3.)", "'',#11,3.)");
    text = with(text, "#110 = CIRCLE",
                "#110 = EDGE_CURVE('neighbour',#112,#112,#111,.T.);\n#112 = VERTEX_POINT('',#113);\n"
                "#113 = CARTESIAN_POINT('',(3.,0.,0.));\n#111 = CIRCLE");
    text = with(text, "GEOMETRIC_CURVE_SET('',(#100,#110))",
                "EDGE_BASED_WIREFRAME_MODEL('',(#108));\n#108 = CONNECTED_EDGE_SET('',(#100,#110))");
    text = with(text, "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE", "EDGE_BASED_WIREFRAME_SHAPE");
  }
  const fs::path source = scratch.file("source.step", text), target = scratch.path() / "target.step";
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 2u);
  const ImportedCurve& curve = before.curves[0];
  ASSERT_TRUE(export_into_step(source, target, {{curve.curve, stretched(curve.curve), "it"}}).empty());
  const StepInstances step(content_of(target));
  for (const int presentation : {120, 130}) {
    const std::vector<int> references = step.references(presentation);
    EXPECT_TRUE(is_made_of(step, 15, references.back())) << step.value(presentation);
  }
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.curves[i].name, before.curves[i].name);
    EXPECT_EQ(after.curves[i].colour, before.curves[i].colour);
    EXPECT_EQ(after.curves[i].layer, before.curves[i].layer);
  }
  const std::vector<Shown> shown_before = Document(source).shown(), shown_after = Document(target).shown();
  ASSERT_EQ(shown_after.size(), shown_before.size());
  for (std::size_t i = 0; i < shown_after.size(); ++i)
    EXPECT_TRUE(shown_after[i].looks_like(shown_before[i])) << shown_before[i].path;
}

INSTANTIATE_TEST_SUITE_P(AttachedTo, StyleAfterExport,
                         ::testing::Values(Styled{"Curve", "#100 = CIRCLE('hoop',#11,2.);", 100},
                                           Styled{"TrimmedCurve", trimmed_arc, 100},
                                           Styled{"BasisOfTrimmedCurve", trimmed_arc, 101},
                                           Styled{"Edge", brace, 100}, Styled{"GeometryOfEdge", brace, 101}),
                         [](const auto& test) { return std::string(test.param.what); });

TEST(AppearanceAfterExport, GeometryThatTwoCurvesAreMadeOfStaysThatOfTheOther) {
  const ScratchDirectory scratch;
  const std::string second =
      "#102 = TRIMMED_CURVE('other',#101,(PARAMETER_VALUE(2.)),(PARAMETER_VALUE(3.)),.T.,.PARAMETER.);";
  // Two arcs of one circle; an arc and the whole circle.
  for (const bool arcs : {true, false}) {
    const std::string set = arcs ? "#100,#102" : "#101,#102";
    const fs::path source = scratch.file("source.step", step_text_of(set, trimmed_arc + second));
    const fs::path target = scratch.path() / "target.step";
    const ImportReport before = import_curves(source);
    ASSERT_EQ(before.curves.size(), 2u);
    const ImportedCurve& curve = before.curves[0];
    const auto said = export_into_step(source, target, {{curve.curve, stretched(curve.curve), "it"}});
    const ImportReport after = import_curves(target);
    ASSERT_EQ(after.curves.size(), arcs ? 2u : 3u);
    EXPECT_EQ(after.curves[1].curve.control_points(), before.curves[1].curve.control_points());
    ASSERT_EQ(said.size(), arcs ? 0u : 1u);
    if (arcs) continue;
    EXPECT_NE(said[0].message.find("is made of the same curve"), std::string::npos) << said[0].message;
    EXPECT_EQ(after.curves[0].curve.control_points(), curve.curve.control_points());
  }
}

}  // namespace
}  // namespace nurbeam
