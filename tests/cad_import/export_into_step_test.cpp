// Long because its tests share what they build.
#include "cad_import/export_into_step.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BezierCurve.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <numbers>
#include <set>
#include <sstream>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "cad_import/step/step_instances.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/arch.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_parameter.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

/// A rational cubic B-spline with two spans, bent by `bend` [m].
NurbsCurve bent(double bend, bool rational) {
  Eigen::Matrix3Xd points(3, 5);
  points << 1, 2, 3, 4, 5, 0, bend, -bend, bend, 2, 3, 3, 3 + bend, 3, 3;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(5);
  if (rational) weights(2) = 1.25;
  return make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 0.5, 1, 1, 1, 1}), points, weights);
}

double difference(const NurbsCurve& a, const NurbsCurve& b) {
  if (a.knots() != b.knots()) return 1e9;
  return (a.control_points() - b.control_points()).cwiseAbs().maxCoeff();
}

TEST(ExportIntoStep, ExchangesOneCurveAndLeavesTheRestOfTheTextAlone) {
  const ScratchDirectory scratch;
  for (const LengthUnit unit : {LengthUnit::metre, LengthUnit::millimetre, LengthUnit::inch})
    for (const bool rational : {false, true}) {
      const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
      ASSERT_TRUE(
          export_curves(source, {{"left", bent(0.1, !rational)}, {"right 'x'", bent(0.2, false)}}, unit)
              .empty());
      const ImportReport before = import_curves(source);
      const NurbsCurve deformed = bent(0.7, rational);
      EXPECT_TRUE(
          export_into_step(source, target, {{before.curves.at(1).curve, deformed, "right 'x'"}}).empty());
      const ImportReport after = import_curves(target);
      ASSERT_EQ(after.curves.size(), 2u);
      EXPECT_TRUE(after.diagnostics.empty());
      EXPECT_EQ(after.unit, before.unit);
      EXPECT_EQ(after.curves[0].name, "left");
      EXPECT_EQ(after.curves[1].name, "right 'x'");
      EXPECT_EQ(difference(after.curves[0].curve, before.curves[0].curve), 0);
      EXPECT_LE(difference(after.curves[1].curve, deformed), 2e-15);
      // All lines of the source but those of the exchanged curve are there.
      std::multiset<std::string> lines;
      std::istringstream stream(content_of(target));
      for (std::string line; std::getline(stream, line);) lines.insert(line);
      std::istringstream old(content_of(source));
      int missing = 0;
      for (std::string line; std::getline(old, line);) missing += !lines.contains(line);
      EXPECT_LE(missing, 8);
      EXPECT_GE(missing, 1);
    }
}

/// An assembly of two copies of a part at different places, and of one part of its own; the part is `shape`.
TopoDS_Compound assembly(const TopoDS_Shape& shape, int copies) {
  const BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (int i = 0; i < copies; ++i) {
    gp_Trsf turn, shift;
    turn.SetRotation(gp_Ax1(gp_Pnt(10, 20, 30), gp_Dir(1, 2, 3)), 0.7 + i);
    shift.SetTranslation(gp_Vec(1000, -500, 250 * i));
    builder.Add(all, shape.Moved(TopLoc_Location(shift * turn)));
  }
  return all;
}

void write_assembly(const fs::path& file, const TopoDS_Shape& shape) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const StepParameter assembly("write.step.assembly", "On"), unit("write.step.unit", "INCH");
  STEPControl_Writer writer;
  ASSERT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
  ASSERT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
}

TEST(ExportIntoStep, APlacedPartGetsTheCurveInItsOwnFrame) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  const BRep_Builder builder;
  TopoDS_Compound part;
  builder.MakeCompound(part);
  builder.Add(part, arch(50));
  builder.Add(part, arch(80));
  write_assembly(source, assembly(part, 1));
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 2u);
  const NurbsCurve deformed = stretched(before.curves[0].curve);
  EXPECT_TRUE(export_into_step(source, target, {{before.curves[0].curve, deformed, "arch"}}).empty());
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 2u);
  EXPECT_EQ(after.unit, "inch");
  EXPECT_LE(difference(after.curves[0].curve, deformed), 1e-14);
  EXPECT_EQ(difference(after.curves[1].curve, before.curves[1].curve), 0);
}

void write_arch_at_two_places(const fs::path& file) {
  const BRep_Builder builder;
  TopoDS_Compound part;
  builder.MakeCompound(part);
  builder.Add(part, arch(50));
  write_assembly(file, assembly(part, 2));
}

TEST(ExportIntoStep, APartAtTwoPlacesChangesAtBothWithAWarning) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  write_arch_at_two_places(source);
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 2u);
  const NurbsCurve deformed = stretched(before.curves[1].curve);
  const auto warnings = export_into_step(source, target, {{before.curves[1].curve, deformed, "arch"}});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("2 places"), std::string::npos) << warnings[0].message;
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 2u);
  EXPECT_LE(difference(after.curves[1].curve, deformed), 1e-14);
  EXPECT_GT(difference(after.curves[0].curve, before.curves[0].curve), 1e-3);
}

TEST(ExportIntoStep, TwoBeamsOnTwoPlacesOfAPartAreBothInTheFile) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  write_arch_at_two_places(source);
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 2u);
  std::vector<DeformedCurve> wanted;
  for (const ImportedCurve& curve : before.curves)
    wanted.push_back({curve.curve, stretched(curve.curve), "arch " + std::to_string(wanted.size() + 1)});
  const auto warnings = export_into_step(source, target, wanted);
  ASSERT_EQ(warnings.size(), 2u);
  for (const auto& warning : warnings)
    EXPECT_NE(warning.message.find("other beams deform the same curve"), std::string::npos)
        << warning.message;
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 4u);
  for (const DeformedCurve& each : wanted)
    EXPECT_TRUE(std::any_of(after.curves.begin(), after.curves.end(), [&](const ImportedCurve& curve) {
      return curve.name == each.name && difference(curve.curve, each.deformed) <= 1e-14;
    })) << each.name;
  for (const ImportedCurve& curve : before.curves)
    EXPECT_TRUE(std::any_of(after.curves.begin(), after.curves.end(), [&](const ImportedCurve& kept) {
      return difference(curve.curve, kept.curve) == 0;
    }));
}

TEST(ExportIntoStep, WhatIsMadeOfTheCurveStaysAndTheCurveIsAddedBesideIt) {
  const ScratchDirectory scratch;
  const std::string line =
      "#100 = B_SPLINE_CURVE_WITH_KNOTS('line',1,(#200,#201),.UNSPECIFIED.,.F.,.F.,(2,2),(0.,1.),.UNSPECIFIED.);\n"
      "#200 = CARTESIAN_POINT('',(0.,0.,0.));\n#201 = CARTESIAN_POINT('',(3.,0.,0.));\n"
      "#202 = CARTESIAN_POINT('',(3.,4.,0.));\n";
  const std::string replica =
      "#101 = CURVE_REPLICA('other',#100,#102);\n"
      "#102 = CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',$,#14,#103,#202,1.,#13);\n"
      "#103 = DIRECTION('',(0.,1.,0.));\n";
  const std::string composite =
      "#101 = COMPOSITE_CURVE('other',(#102,#103),.F.);\n"
      "#102 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#100);\n"
      "#103 = COMPOSITE_CURVE_SEGMENT(.DISCONTINUOUS.,.T.,#104);\n#104 = POLYLINE('',(#201,#202));\n";
  for (const std::string& made_of_it : {replica, composite}) {
    const fs::path source = scratch.file("source.step", step_text_of("#100,#101", line + made_of_it));
    const fs::path target = scratch.path() / "target.step";
    const ImportReport before = import_curves(source);
    ASSERT_GE(before.curves.size(), 2u);
    ASSERT_EQ(before.curves[0].name, "line");
    const auto warnings =
        export_into_step(source, target, {{before.curves[0].curve, bent(0.3, true), "line"}});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].message.find("is made of the same curve"), std::string::npos)
        << warnings[0].message;
    const ImportReport after = import_curves(target);
    ASSERT_EQ(after.curves.size(), before.curves.size() + 1);
    for (std::size_t i = 0; i < before.curves.size(); ++i)
      EXPECT_EQ(difference(after.curves[i].curve, before.curves[i].curve), 0) << i;
    EXPECT_LE(difference(after.curves.back().curve, bent(0.3, true)), 2e-15);
  }
}

TEST(ExportIntoStep, ACurveThatIsMappedMirroredAtTwiceItsSizeGetsItsShapeInItsOwnCoordinates) {
  const ScratchDirectory scratch;
  const std::string part = step_text_of(
      "#100",
      "#100 = B_SPLINE_CURVE_WITH_KNOTS('wire',1,(#101,#102),.UNSPECIFIED.,.F.,.F.,(2,2),(0.,1.),.UNSPECIFIED.);\n"
      "#101 = CARTESIAN_POINT('',(1.,2.,3.));\n#102 = CARTESIAN_POINT('',(4.,6.,3.));\n"
      "#110 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#15),#26);\n"
      "#111 = REPRESENTATION_MAP(#11,#110);\n#112 = MAPPED_ITEM('',#111,#113);\n"
      "#113 = CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',$,#14,#115,#114,2.,#13);\n"
      "#114 = CARTESIAN_POINT('',(100.,0.,0.));\n#115 = DIRECTION('',(0.,-1.,0.));\n");
  const fs::path source =
      scratch.file("source.step",
                   with(part, "#10 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#15),#26);",
                        "#10 = SHAPE_REPRESENTATION('',(#11,#112),#26);"));
  const fs::path target = scratch.path() / "target.step";
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 1u);
  EXPECT_LE((1e3 * before.curves[0].curve.point(1) - Eigen::Vector3d(108, -12, 6)).norm(), 1e-12);
  const NurbsCurve deformed = bent(0.7, true);
  EXPECT_TRUE(export_into_step(source, target, {{before.curves[0].curve, deformed, "wire"}}).empty());
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 1u);
  EXPECT_LE(difference(after.curves[0].curve, deformed), 1e-14);
}

TEST(ExportIntoStep, AnEdgeOfASolidStaysAndTheCurveIsAddedBesideIt) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  write_assembly(source, assembly(BRepPrimAPI_MakeBox(100, 50, 20).Shape(), 1));
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 12u);
  const NurbsCurve deformed = bent(0.3, true);
  const auto warnings = export_into_step(source, target, {{before.curves[3].curve, deformed, "cable"}});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].severity, Severity::warning);
  EXPECT_NE(warnings[0].message.find("bounds faces"), std::string::npos) << warnings[0].message;
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 13u);
  const auto added = std::find_if(after.curves.begin(), after.curves.end(),
                                  [](const ImportedCurve& curve) { return curve.free; });
  ASSERT_NE(added, after.curves.end());
  EXPECT_EQ(added->name, "cable");
  EXPECT_LE(difference(added->curve, deformed), 1e-14);
  STEPControl_Reader reader;
  ASSERT_EQ(reader.ReadFile(target.c_str()), IFSelect_RetDone);
  reader.TransferRoots();
  EXPECT_TRUE(BRepCheck_Analyzer(reader.OneShape()).IsValid());
}

TEST(ExportIntoStep, AChainIsAddedBesideItsFirstCurve) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  ASSERT_TRUE(export_curves(source, {{"one", bent(0.1, false)}}, LengthUnit::metre).empty());
  const NurbsCurve drawn = import_curves(source).curves.at(0).curve;
  const auto warnings = export_into_step(source, target, {{drawn, bent(0.4, false), "one", true}});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("chain"), std::string::npos) << warnings[0].message;
  EXPECT_EQ(import_curves(target).curves.size(), 2u);
  // In the set of curves of its part, which a CAD system shows as one object.
  const auto sets_in = [](const fs::path& file) {
    const std::string text = content_of(file), keyword = "GEOMETRIC_CURVE_SET(";
    int count = 0;
    for (std::size_t at = text.find(keyword); at != std::string::npos; at = text.find(keyword, at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(sets_in(target), sets_in(source));
}

TEST(ExportIntoStep, APieceOfACompositeCurveStaysAndTheCurveIsAddedBesideIt) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.file(
      "source.step",
      step_text_of("#100",
                   "#100 = COMPOSITE_CURVE('run',(#101,#102),.F.);\n"
                   "#101 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#103);\n"
                   "#102 = COMPOSITE_CURVE_SEGMENT(.DISCONTINUOUS.,.F.,#104);\n"
                   "#103 = POLYLINE('',(#200,#201));\n#104 = POLYLINE('',(#202,#201));\n"
                   "#200 = CARTESIAN_POINT('',(0.,0.,0.));\n#201 = CARTESIAN_POINT('',(3.,0.,0.));\n"
                   "#202 = CARTESIAN_POINT('',(7.,0.,0.));"));
  const fs::path target = scratch.path() / "target.step";
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 2U);
  for (const bool chain : {false, true}) {
    const auto warnings = export_into_step(
        source, target,
        {{.drawn = before.curves[1].curve, .deformed = bent(0.3, true), .name = "run", .beside = chain}});
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].message.find("#100 'run'"), std::string::npos) << warnings[0].message;
    EXPECT_NE(warnings[0].message.find(chain ? "chain of several" : "piece of this composite"),
              std::string::npos)
        << warnings[0].message;
    const ImportReport after = import_curves(target);
    ASSERT_EQ(after.curves.size(), 3U);
    EXPECT_LE(difference(after.curves[2].curve, bent(0.3, true)), 2e-15);
    EXPECT_EQ(after.curves[2].name, "run");
  }
}

TEST(ExportIntoStep, ConicsAndLinesOfTheSourceBecomeSplines) {
  const ScratchDirectory scratch;
  const fs::path target = scratch.path() / "target.step";
  const fs::path source = scratch.file("source.step", step_text_of("#100", "#100 = CIRCLE('hoop',#11,2.);"));
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 1u);
  EXPECT_TRUE(export_into_step(source, target, {{before.curves[0].curve, bent(0.1, true), "hoop"}}).empty());
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 1u);
  EXPECT_EQ(after.curves[0].name, "hoop");
  EXPECT_LE(difference(after.curves[0].curve, bent(0.1, true)), 2e-15);
}

TEST(ExportIntoStep, AFreeEdgeWithVerticesGetsNewOnes) {
  const ScratchDirectory scratch;
  std::string text = step_text_of("#100", R"(#100 = CONNECTED_EDGE_SET('',(#101));
#101 = EDGE_CURVE('brace',#102,#103,#104,.F.);
#102 = VERTEX_POINT('',#105);
#103 = VERTEX_POINT('',#106);
#104 = LINE('',#106,#107);
#105 = CARTESIAN_POINT('',(3.,0.,0.));
#106 = CARTESIAN_POINT('',(1.,0.,0.));
#107 = VECTOR('',#14,1.);)");
  text = with(text, "GEOMETRIC_CURVE_SET", "EDGE_BASED_WIREFRAME_MODEL");
  text = with(text, "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE", "EDGE_BASED_WIREFRAME_SHAPE");
  const fs::path source = scratch.file("source.step", text), target = scratch.path() / "target.step";
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 1u);
  EXPECT_TRUE(export_into_step(source, target, {{before.curves[0].curve, bent(0.1, true), "brace"}}).empty());
  EXPECT_NE(content_of(target).find("EDGE_CURVE('brace',#"), std::string::npos);
  EXPECT_EQ(content_of(target).find("'brace',#102"), std::string::npos);
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 1u);
  EXPECT_EQ(after.curves[0].name, "brace");
  EXPECT_LE(difference(after.curves[0].curve, bent(0.1, true)), 2e-15);
}

TEST(ExportIntoStep, AnEdgeOfAWireframeRunsFromItsFirstVertexToItsLastBeforeAndAfter) {
  const ScratchDirectory scratch;
  // From (0, 5) to (5, 0): along the circle the long way round, against it the short one.
  std::string text = step_text_of(
      "#100",
      "#100 = VERTEX_POINT('',#200);\n#101 = VERTEX_POINT('',#201);\n#102 = CIRCLE('',#11,5.);\n"
      "#103 = EDGE_CURVE('bow',#101,#100,#102,.T.);\n#104 = EDGE_CURVE('arc',#101,#100,#102,.F.);\n"
      "#105 = CONNECTED_EDGE_SET('',(#103,#104));\n"
      "#200 = CARTESIAN_POINT('',(5.,0.,0.));\n#201 = CARTESIAN_POINT('',(0.,5.,0.));");
  text = with(text, "GEOMETRIC_CURVE_SET('',(#100))", "EDGE_BASED_WIREFRAME_MODEL('',(#105))");
  text = with(text, "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE", "EDGE_BASED_WIREFRAME_SHAPE");
  const fs::path source = scratch.file("source.step", text), target = scratch.path() / "target.step";
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 2U);
  for (const auto& [edge, length_over_pi] : {std::pair{0, 7.5e-3}, {1, 2.5e-3}}) {
    const ImportedCurve& read = before.curves[edge];
    ASSERT_EQ(read.name, edge == 0 ? "bow" : "arc");
    EXPECT_LE((start_of(read.curve) - Eigen::Vector3d(0, 5e-3, 0)).norm(), 1e-16);
    EXPECT_LE((end_of(read.curve) - Eigen::Vector3d(5e-3, 0, 0)).norm(), 1e-16);
    EXPECT_NEAR(length(read.curve) / std::numbers::pi, length_over_pi, 1e-15);
    EXPECT_TRUE(export_into_step(source, target, {{read.curve, bent(0.2, false), read.name}}).empty());
    const ImportReport after = import_curves(target);
    ASSERT_EQ(after.curves.size(), 2U);
    for (const ImportedCurve& curve : after.curves)
      if (curve.name == read.name)
        EXPECT_LE(difference(curve.curve, bent(0.2, false)), 2e-15);
      else
        EXPECT_LE((start_of(curve.curve) - start_of(read.curve)).norm(), 1e-16) << curve.name;
  }
}

TEST(ExportIntoStep, AClosedCurveStaysAClosedEdgeWithOneVertex) {
  const ScratchDirectory scratch;
  std::string edge = step_text_of("#100", R"(#100 = CONNECTED_EDGE_SET('',(#101));
#101 = EDGE_CURVE('hoop',#102,#102,#103,.T.);
#102 = VERTEX_POINT('',#104);
#103 = CIRCLE('',#11,200.);
#104 = CARTESIAN_POINT('',(200.,0.,0.));)");
  edge = with(edge, "GEOMETRIC_CURVE_SET", "EDGE_BASED_WIREFRAME_MODEL");
  edge = with(edge, "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE", "EDGE_BASED_WIREFRAME_SHAPE");
  for (const std::string& text : {edge, step_text_of("#100", "#100 = CIRCLE('hoop',#11,200.);")}) {
    const fs::path source = scratch.file("source.step", text), target = scratch.path() / "target.step";
    const NurbsCurve drawn = import_curves(source).curves.at(0).curve;
    Eigen::Matrix4Xd points = drawn.control_points();
    points.row(0) *= 0.7;
    const NurbsCurve oval(drawn.knots(), points);
    ASSERT_TRUE(export_into_step(source, target, {{drawn, oval, "hoop"}}).empty());
    STEPControl_Reader reader;
    ASSERT_EQ(reader.ReadFile(target.c_str()), IFSelect_RetDone);
    reader.TransferRoots();
    const TopExp_Explorer edges(reader.OneShape(), TopAbs_EDGE);
    ASSERT_TRUE(edges.More());
    const TopoDS_Edge& hoop = TopoDS::Edge(edges.Current());
    EXPECT_TRUE(BRepCheck_Analyzer(hoop).IsValid());
    EXPECT_TRUE(TopExp::FirstVertex(hoop).IsSame(TopExp::LastVertex(hoop)));
    EXPECT_LE(difference(import_curves(target).curves.at(0).curve, oval), 1e-15);
  }
}

TEST(ExportIntoStep, EveryFreeCurveOfTheCorpusCanBeExchanged) {
  const ScratchDirectory scratch;
  const fs::path target = scratch.path() / "target.step";
  int exchanged = 0;
  for (const auto& entry : fs::directory_iterator(corpus_file(""))) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".step" && extension != ".stp") continue;
    const ImportReport before = import_curves(entry.path());
    // The first curve, whatever it is: exchanged if free, else a curve more.
    const NurbsCurve deformed = stretched(before.curves.at(0).curve);
    const auto diagnostics =
        export_into_step(entry.path(), target, {{before.curves[0].curve, deformed, "deformed"}});
    for (const Diagnostic& diagnostic : diagnostics)
      EXPECT_EQ(diagnostic.severity, Severity::warning) << diagnostic.message;
    const ImportReport after = import_curves(target);
    EXPECT_EQ(after.curves.size(), before.curves.size() + (before.curves[0].free ? 0 : 1)) << entry.path();
    EXPECT_EQ(after.unit, before.unit);
    EXPECT_TRUE(std::any_of(after.curves.begin(), after.curves.end(), [&](const ImportedCurve& curve) {
      return difference(curve.curve, deformed) <= 1e-12 * deformed.control_points().cwiseAbs().maxCoeff();
    })) << entry.path();
    exchanged += before.curves[0].free;
  }
  EXPECT_GE(exchanged, 1);
}

TEST(ExportIntoStep, CurvesThatOpenCascadeDoesNotReadAreExchangedToo) {
  const ScratchDirectory scratch;
  const fs::path target = scratch.path() / "target.step";
  const std::string supplemental =
      "#100 = CIRCLE('hoop',#11,1.);\n#110 = ELLIPSE('rim',#11,3.,1.);\n"
      "#150 = CONSTRUCTIVE_GEOMETRY_REPRESENTATION('supplemental geometry',(#110),#26);\n"
      "#151 = CONSTRUCTIVE_GEOMETRY_REPRESENTATION_RELATIONSHIP('supplemental geometry','',#10,#150);\n";
  const std::string bezier =
      "#100 = CIRCLE('hoop',#11,1.);\n#200 = CARTESIAN_POINT('',(1.,0.,0.));\n"
      "#201 = CARTESIAN_POINT('',(1.,1.,0.));\n#202 = CARTESIAN_POINT('',(0.,1.,0.));\n"
      "#110 = ( BEZIER_CURVE() BOUNDED_CURVE() B_SPLINE_CURVE(2,(#200,#201,#202),.UNSPECIFIED.,.F.,.F.) CURVE() "
      "GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE((1.,0.70710678118654752,1.)) "
      "REPRESENTATION_ITEM('rim') );\n";
  for (const std::string& text : {step_text_of("#100", supplemental), step_text_of("#100,#110", bezier)}) {
    const fs::path source = scratch.file("source.step", text);
    const ImportReport before = import_curves(source);
    ASSERT_EQ(before.curves.size(), 2u);
    ASSERT_EQ(before.curves[1].name, "rim");
    EXPECT_TRUE(export_into_step(source, target, {{before.curves[1].curve, bent(0.1, true), "rim"}}).empty());
    const ImportReport after = import_curves(target);
    ASSERT_EQ(after.curves.size(), 2u);
    const auto rim = std::find_if(after.curves.begin(), after.curves.end(),
                                  [](const ImportedCurve& curve) { return curve.name == "rim"; });
    ASSERT_NE(rim, after.curves.end());
    EXPECT_LE(difference(rim->curve, bent(0.1, true)), 2e-15);
  }
}

TEST(ExportIntoStep, ACurveOfDegreeFourteenIsExchanged) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  Eigen::Matrix3Xd points(3, 15);
  for (int i = 0; i < 15; ++i) points.col(i) << i, i % 3, i % 2;
  std::vector<double> knots(15, 0);
  knots.insert(knots.end(), 15, 1);
  const NurbsCurve steep = make_nurbs_curve(KnotVector(14, knots), points, Eigen::VectorXd::Ones(15));
  ASSERT_TRUE(export_curves(source, {{"steep", steep}}, LengthUnit::millimetre).empty());
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 1u);
  ASSERT_EQ(before.curves[0].curve.degree(), 14);
  EXPECT_TRUE(
      export_into_step(source, target, {{before.curves[0].curve, bent(0.1, false), "steep"}}).empty());
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 1u);
  EXPECT_EQ(after.curves[0].name, "steep");
  EXPECT_LE(difference(after.curves[0].curve, bent(0.1, false)), 2e-15);
}

TEST(ExportIntoStep, ATrimmedCurveOfAnEdgeIsExchangedInItsPlace) {
  const ScratchDirectory scratch;
  const fs::path target = scratch.path() / "target.step";
  const fs::path source =
      scratch.file("source.step", step_text_of("#110",
                                               "#100 = CIRCLE('',#11,1.);\n"
                                               "#110 = TRIMMED_CURVE('bow',#100,(PARAMETER_VALUE(0.)),"
                                               "(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);"));
  const ImportReport before = import_curves(source);
  ASSERT_EQ(before.curves.size(), 1u);
  const auto warnings = export_into_step(source, target, {{before.curves[0].curve, bent(0.1, true), "bow"}});
  EXPECT_TRUE(warnings.empty()) << warnings.at(0).message;
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 1u);
  EXPECT_EQ(after.curves[0].name, "bow");
  EXPECT_LE(difference(after.curves[0].curve, bent(0.1, true)), 2e-15);
}

int count_of(const std::string& word, const fs::path& file) {
  const std::string text = content_of(file);
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(ExportIntoStep, WhatIsAddedToAPartComesIntoOneSetOfCurves) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "source.step", target = scratch.path() / "target.step";
  write_assembly(source, assembly(BRepPrimAPI_MakeBox(100, 50, 20).Shape(), 1));
  const ImportReport box = import_curves(source);
  ASSERT_EQ(export_into_step(source, target,
                             {{box.curves[3].curve, bent(0.3, true), "one"},
                              {box.curves[4].curve, bent(0.5, true), "two"}})
                .size(),
            2u);
  EXPECT_EQ(count_of("GEOMETRIC_CURVE_SET(", target), 1);
  EXPECT_EQ(count_of("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION(", target), 1);
  const ImportReport after = import_curves(target);
  EXPECT_EQ(after.curves.size(), 14u);
  EXPECT_TRUE(after.diagnostics.empty());
}

TEST(ExportIntoStep, SaysWhatItCannotReadOrFindAndWritesNothing) {
  const ScratchDirectory scratch;
  const fs::path target = scratch.path() / "target.step";
  const auto error_of = [&](const fs::path& source, const NurbsCurve& drawn) {
    const auto diagnostics = export_into_step(source, target, {{drawn, bent(0.2, false), "cable"}});
    EXPECT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics.at(0).severity, Severity::error);
    EXPECT_EQ(diagnostics.at(0).where, source.string());
    return diagnostics.at(0).message;
  };
  const fs::path source = scratch.path() / "source.step";
  ASSERT_TRUE(export_curves(source, {{"one", bent(0.1, false)}}, LengthUnit::metre).empty());
  EXPECT_NE(error_of(source, bent(0.11, false)).find("cable"), std::string::npos);
  EXPECT_NE(error_of(corpus_file("iges-126-bsplines.igs"), bent(0.1, false)).find("STEP"), std::string::npos);
  EXPECT_NE(error_of(scratch.path() / "missing.step", bent(0.1, false)).find("cannot be read"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(target));
}

TEST(StepInstances, AreReadPastStringsAndComments) {
  const StepInstances step(
      "HEADER;#1=X();ENDSEC;DATA; /* #9=NO(); */ #12 = A_B('it''s; #7=',#3 , (#4));\n"
      "#3=C('x');#4=( D() REPRESENTATION_ITEM('n''m') E(#3) );ENDSEC;\n");
  EXPECT_EQ(step.keyword(12), "A_B");
  EXPECT_EQ(step.references(12), (std::vector<int>{3, 4}));
  EXPECT_EQ(step.encoded_name(12), "it''s; #7=");
  EXPECT_EQ(step.keyword(4), "");
  EXPECT_EQ(step.encoded_name(4), "n''m");
  EXPECT_EQ(step.users(3), (std::vector<int>{4, 12}));
  EXPECT_THROW(step.value(9), std::runtime_error);
  EXPECT_THROW(StepInstances("DATA;#1=A();#1=B();"), std::runtime_error);
  EXPECT_THROW(StepInstances("nothing"), std::runtime_error);
}

TEST(StepInstances, BeginBehindAHeaderWhoseStringsAndCommentsNameTheData) {
  const std::string data = "DATA;\n#1=A('x',#2);\n#2=B('y');\nENDSEC;\n";
  for (const char* name : {"'MYDATA.stp'", "'it''s my DATA'", "'DATA;#3=C();'", "'' /* 'DATA;#3=C(); */"})
    for (const char* section : {"", "REFERENCE;#3=<DATA.stp#1>;ENDSEC;"}) {
      const StepInstances step(std::string("ISO-10303-21;HEADER;FILE_NAME(") + name +
                               ",'2026',(''),(''),'','','');ENDSEC;" + section + data);
      EXPECT_EQ(step.encoded_name(1), "x") << name;
      EXPECT_EQ(step.references(1), std::vector<int>{2}) << name;
      EXPECT_EQ(step.users(2), std::vector<int>{1}) << name;
      EXPECT_THROW(step.value(3), std::runtime_error) << name;
    }
}

TEST(StepInstances, WhatIsNotChangedStays) {
  const std::string text = "ISO;\nDATA;\n#2=A(#1); /* kept */\n#1 = B('x');\nENDSEC;\nEND;\n";
  StepInstances step(text);
  EXPECT_EQ(step.text(), text);
  step.replace(2, "C()");
  EXPECT_EQ(step.add("D()"), 3);
  EXPECT_EQ(step.text(), "ISO;\nDATA;\n#2=C(); /* kept */\n#1 = B('x');\n#3=D();\nENDSEC;\nEND;\n");
}

}  // namespace
}  // namespace nurbeam
