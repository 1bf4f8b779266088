// Conic arcs (104), circular arcs (100) and offset curves (130) of IGES, held to the equations and the ends
// in the file: in any position, unit and direction, under transformations (124) and in composites (102).

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <sstream>

#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/imported_text.h"

namespace nurbeam::restated_iges {
namespace {

constexpr int dependent = 10000;  // the entity is a part of another one

struct Unit {
  std::string text;
  double in_metres;
};
const std::vector<Unit> units{{"2,2HMM", 1e-3}, {"1,4HINCH", 0.0254}};

struct Conic {
  int form;
  std::array<double, 6> equation;  // A to F
  double z;
  Eigen::Vector2d start, end;
  std::function<bool(double, double)> has = [](double, double) { return true; };  // to its digits

  std::string parameters() const {
    std::ostringstream text;
    text << "104";
    for (const double value : equation) text << ',' << value;
    text << ',' << z << ',' << start.x() << ',' << start.y() << ',' << end.x() << ',' << end.y() << ';';
    return text.str();
  }
  double value(double x, double y) const {
    const auto& [a, b, c, d, e, f] = equation;
    return a * x * x + b * x * y + c * y * y + d * x + e * y + f;
  }
};

const std::vector<Conic> conics{
    {1, {25, 0, 9, 0, 0, -225}, 2, {3, 0}, {0, 5}, [](double x, double y) { return x > -1e-9 && y > -1e-9; }},
    {1, {25, 0, 9, 0, 0, -225}, 0, {0, 5}, {3, 0}, [](double x, double y) { return x < 1e-9 || y < 1e-9; }},
    {1, {9, 0, 25, 0, 0, -225}, 0, {0, 3}, {0, -3}, [](double x, double) { return x < 1e-9; }},
    {1, {25, 0, 9, 0, 0, -225}, -1, {3, 0}, {3, 0}},
    {0, {25, 0, 9, -50, -36, -164}, 0, {4, 2}, {-2, 2}, [](double, double y) { return y > 2 - 1e-9; }},
    {1, {5, -6, 5, 0, 0, -4}, 0, {1, 0.2}, {0.2, 1}, [](double x, double y) { return x + y > 1.2 - 1e-9; }},
    {1, {1, 0, 1, 0, 0, -25}, 0, {5, 0}, {-3, 4}, [](double, double y) { return y > -1e-9; }},
    {3, {1, 0, 0, 0, -4, 0}, 0, {-2, 1}, {4, 4}},
    {3, {1, 0, 0, 0, 4, 0}, 0, {-2, -1}, {4, -4}},
    {3, {0.25, 0, 0, 0, -1, 0}, 7, {4, 4}, {-2, 1}},
    {3, {1, 0, 0, -2, -4, 1}, 0, {-1, 1}, {5, 4}},
    {3, {0, 0, 1, 4, 0, 0}, 0, {-4, 4}, {-1, -2}},
    {0, {1, -2, 1, -8, -8, 0}, 0, {8, 0}, {0, 8}},
    {2, {1, 0, -1, 0, 0, -9}, 0, {5, -4}, {3, 0}, [](double x, double) { return x > 0; }},
    {2, {1, 0, -1, 0, 0, -9}, 0, {-5, 4}, {-3, 0}, [](double x, double) { return x < 0; }},
    {2, {1, 0, -1, 0, 0, -9}, 0, {5, 4}, {5, -4}, [](double x, double) { return x > 0; }},
    {2, {-1, 0, 1, 0, 0, -9}, 3, {4, 5}, {-4, 5}, [](double, double y) { return y > 0; }},
    {2, {1, 0, -1, 0, 0, 9}, 0, {-4, -5}, {0, -3}, [](double, double y) { return y < 0; }},
    {0, {0, 1, 0, 0, 0, -6}, 0, {-6, -1}, {-1, -6}, [](double x, double) { return x < 0; }},
};

std::string label_of(std::size_t i) { return "C" + std::to_string(i); }

const ImportedCurve& named(const ImportReport& report, const std::string& name) {
  const auto at = std::find_if(report.curves.begin(), report.curves.end(),
                               [&](const ImportedCurve& curve) { return curve.name == name; });
  if (at == report.curves.end()) throw std::runtime_error("no curve " + name);
  return *at;
}

/// `place`: from the coordinates of the entity into those of the file.
void expect_conic(const NurbsCurve& curve, const Conic& conic, const Eigen::Affine3d& place, double unit) {
  const auto in_plane = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return place.inverse() * (p / unit);
  };
  const Eigen::Vector3d start = in_plane(start_of(curve)), end = in_plane(end_of(curve));
  if (conic.start != conic.end) {
    EXPECT_LE((start - Eigen::Vector3d(conic.start.x(), conic.start.y(), conic.z)).norm(), 1e-13);
    EXPECT_LE((end - Eigen::Vector3d(conic.end.x(), conic.end.y(), conic.z)).norm(), 1e-13);
  } else {
    EXPECT_LE((start - end).norm(), 1e-14);
  }
  for (int i = 0; i <= 64; ++i) {
    const double u = curve.knots().start() + (curve.knots().end() - curve.knots().start()) * i / 64;
    const Eigen::Vector3d p = in_plane(curve.point(u));
    EXPECT_NEAR(conic.value(p.x(), p.y()), 0, 1e-11);
    EXPECT_NEAR(p.z(), conic.z, 1e-13);
    EXPECT_TRUE(conic.has(p.x(), p.y())) << p.transpose();
  }
}

void expect_conics(const std::string& text, const Eigen::Affine3d& place, double unit) {
  const ImportReport report = import_text(text);
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics.at(0).message;
  const std::vector<std::string> kinds{"", "ellipse", "hyperbola", "parabola"};
  for (std::size_t i = 0; i < conics.size(); ++i) {
    SCOPED_TRACE(conics[i].parameters());
    const ImportedCurve& curve = named(report, label_of(i));
    EXPECT_TRUE(curve.exact);
    EXPECT_EQ(curve.curve.degree(), 2);
    if (conics[i].form > 0 && i != 6) EXPECT_EQ(curve.entity, kinds[conics[i].form]);
    expect_conic(curve.curve, conics[i], place, unit);
  }
}

std::vector<IgesEntity> entities_of(int status, int matrix) {
  std::vector<IgesEntity> entities;
  for (std::size_t i = 0; i < conics.size(); ++i)
    entities.push_back({.type = 104,
                        .parameters = conics[i].parameters(),
                        .form = conics[i].form,
                        .label = label_of(i),
                        .status = status,
                        .matrix = matrix});
  return entities;
}

/// About x by 90 degrees, and moved.
const IgesEntity turn{.type = 124, .parameters = "124,1,0,0,5,0,0,-1,6,0,1,0,7;", .status = dependent};
/// Left and right exchanged, then turned about z by 90 degrees.
const IgesEntity mirror{
    .type = 124, .parameters = "124,0,-1,0,1,-1,0,0,2,0,0,1,3;", .form = 1, .status = dependent};

Eigen::Affine3d place_of(const IgesEntity& matrix) {
  std::istringstream text(matrix.parameters.substr(4));
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  for (int i = 0; i < 12; ++i) {
    text >> place(i / 4, i % 4);
    text.ignore();
  }
  return place;
}

int line_of(std::size_t index) { return int(2 * index + 1); }

TEST(RestatedIges, ConicsAreThoseOfTheirEquationsInAnyPosition) {
  for (const Unit& unit : units)
    expect_conics(iges_text_of(entities_of(0, 0), unit.text), Eigen::Affine3d::Identity(), unit.in_metres);
}

TEST(RestatedIges, ConicsLieWhereTheirTransformationPutsThem) {
  for (const Unit& unit : units)
    for (const IgesEntity& matrix : {turn, mirror}) {
      SCOPED_TRACE(matrix.parameters);
      std::vector<IgesEntity> entities = entities_of(0, line_of(conics.size()));
      entities.push_back(matrix);
      expect_conics(iges_text_of(entities, unit.text), place_of(matrix), unit.in_metres);
    }
}

TEST(RestatedIges, ConicsInCompositesLieWhereBothTransformationsPutThem) {
  for (const Unit& unit : units) {
    const std::size_t count = conics.size();
    std::vector<IgesEntity> entities = entities_of(dependent, line_of(count));
    entities.push_back(mirror);
    entities.push_back(turn);
    for (std::size_t i = 0; i < count; ++i)
      entities.push_back({.type = 102,
                          .parameters = "102,1," + std::to_string(line_of(i)) + ";",
                          .label = label_of(i),
                          .matrix = line_of(count + 1)});
    expect_conics(iges_text_of(entities, unit.text), place_of(turn) * place_of(mirror), unit.in_metres);
  }
}

/// Matrices in a chain: the first, in line 3, is followed by the others.
std::vector<IgesEntity> chained(IgesEntity first, const std::vector<IgesEntity>& matrices) {
  first.matrix = 3;
  std::vector<IgesEntity> entities{first};
  for (IgesEntity matrix : matrices) {
    matrix.matrix = entities.size() < matrices.size() ? line_of(entities.size() + 1) : 0;
    entities.push_back(matrix);
  }
  return entities;
}

TEST(RestatedIges, AMatrixActsOnWhatTheOneThatGoesOnToItGives) {
  const IgesEntity line{.type = 110, .parameters = "110,1,2,3,40,50,60;"};
  const ImportReport report = import_text(iges_text_of(chained(line, {mirror, turn, turn})));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_TRUE(report.diagnostics.empty());
  const Eigen::Affine3d place = place_of(turn) * place_of(turn) * place_of(mirror);
  EXPECT_LE((1e3 * start_of(report.curves[0].curve) - place * Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LE((1e3 * end_of(report.curves[0].curve) - place * Eigen::Vector3d(40, 50, 60)).norm(), 1e-12);
  const IgesEntity arc{.type = 100, .parameters = "100,2,0,0,5,0,0,5;"};
  const ImportReport turned = import_text(iges_text_of(chained(arc, {mirror, turn})));
  ASSERT_EQ(turned.curves.size(), 1U);
  expect_conic(
      turned.curves[0].curve,
      {1, {1, 0, 1, 0, 0, -25}, 2, {5, 0}, {0, 5}, [](double x, double y) { return x > -1e-9 && y > -1e-9; }},
      place_of(turn) * place_of(mirror), 1e-3);
}

TEST(RestatedIges, ChainsOfMatricesThatDoNotEndAreNamedAndHarmNothing) {
  const auto expect_left_out = [](const std::vector<IgesEntity>& entities, const std::string& text) {
    std::vector<IgesEntity> all = entities;
    all.push_back({.type = 110, .parameters = "110,0,0,0,1,0,0;", .label = "good"});
    const ImportReport report = import_text(iges_text_of(all));
    ASSERT_EQ(report.curves.size(), 1U);
    EXPECT_EQ(report.curves[0].name, "good");
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_NE(report.diagnostics[0].message.find(text), std::string::npos) << report.diagnostics[0].message;
    EXPECT_NE(report.diagnostics[0].where.find("D3 TransformationMatrix"), std::string::npos)
        << report.diagnostics[0].where;
  };
  const IgesEntity line{.type = 110, .parameters = "110,1,2,3,40,50,60;"};
  std::vector<IgesEntity> circle = chained(line, {turn, mirror});
  circle.back().matrix = 3;
  expect_left_out(circle, "lead in a circle");
  std::vector<IgesEntity> itself = chained(line, {turn});
  itself.back().matrix = 3;
  expect_left_out(itself, "lead in a circle");
  expect_left_out(chained(line, std::vector<IgesEntity>(150, turn)), "more than 100 matrices");
  const ImportReport deep = import_text(iges_text_of(chained(line, std::vector<IgesEntity>(20'000, turn))));
  EXPECT_TRUE(deep.curves.empty());
  EXPECT_FALSE(deep.ok());
}

TEST(RestatedIges, EntitiesWhoseMatrixIsNoneAreReadWithoutAndNamed) {
  const IgesEntity line{.type = 110, .parameters = "110,0,0,0,1,0,0;", .label = "odd", .matrix = 5};
  const ImportReport report =
      import_text(iges_text_of({line, turn, {.type = 116, .parameters = "116,0,0,2,0;"}, line}));
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_EQ(end_of(report.curves[0].curve), Eigen::Vector3d(1e-3, 0, 0));
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].where.find("D1 Line 'odd'"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("no transformation matrix (124)"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("so are 2 entities"), std::string::npos);
  const ImportReport instance =
      import_text(iges_text_of({{.type = 110, .parameters = "110,0,0,0,1,0,0;", .status = dependent},
                                {.type = 308, .parameters = "308,0,3Hsub,1,1;", .status = 20200},
                                {.type = 408, .parameters = "408,3,5.,0.,0.,2.;", .matrix = 1}}));
  ASSERT_EQ(instance.curves.size(), 1U);
  EXPECT_LE((1e3 * end_of(instance.curves[0].curve) - Eigen::Vector3d(7, 0, 0)).norm(), 1e-14);
}

TEST(RestatedIges, CircularArcsUnderAMirrorGoTheRightWay) {
  const ImportReport report =
      import_text(iges_text_of({{.type = 100, .parameters = "100,2,0,0,5,0,0,5;", .matrix = 3}, mirror}));
  ASSERT_EQ(report.curves.size(), 1U);
  const NurbsCurve& arc = report.curves[0].curve;
  expect_conic(
      arc,
      {1, {1, 0, 1, 0, 0, -25}, 2, {5, 0}, {0, 5}, [](double x, double y) { return x > -1e-9 && y > -1e-9; }},
      place_of(mirror), 1e-3);
}

TEST(RestatedIges, EndsOfFewDigitsAreMet) {
  const Conic rounded{1, {25, 0, 9, 0, 0, -225}, 0, {2.121, 3.536}, {-2.121, 3.536}};
  const ImportReport report =
      import_text(iges_text_of({{.type = 104, .parameters = rounded.parameters(), .form = 1}}));
  ASSERT_EQ(report.curves.size(), 1U);
  const NurbsCurve& arc = report.curves[0].curve;
  EXPECT_LE((1e3 * start_of(arc) - Eigen::Vector3d(2.121, 3.536, 0)).norm(), 1e-13);
  EXPECT_LE((1e3 * end_of(arc) - Eigen::Vector3d(-2.121, 3.536, 0)).norm(), 1e-13);
}

/// The entity is not read, with one warning that has this text and names it.
void expect_refused(std::vector<IgesEntity> entities, const std::string& text) {
  SCOPED_TRACE(text);
  entities[0].label = "odd";
  entities.push_back({.type = 110, .parameters = "110,0,0,0,1,0,0;", .label = "good"});
  const ImportReport report = import_text(iges_text_of(entities));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_EQ(report.curves[0].name, "good");
  ASSERT_GE(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].where.find("'odd'"), std::string::npos) << report.diagnostics[0].where;
  EXPECT_NE(report.diagnostics[0].message.find(text), std::string::npos) << report.diagnostics[0].message;
}

TEST(RestatedIges, ConicsThatContradictThemselvesAreNamed) {
  const auto conic = [](int form, const std::string& numbers) {
    return IgesEntity{.type = 104, .parameters = "104," + numbers + ";", .form = form};
  };
  expect_refused({conic(1, "1,0,-1,0,0,-9,0,5,-4,3,0")}, "form number 1 says ellipse");
  expect_refused({conic(2, "1,0,-1,0,0,-9,0,5,-4,-3,0")}, "on two branches");
  expect_refused({conic(1, "25,0,9,0,0,-225,0,3.5,0,0,5")}, "its end (3.5, 0) is");
  expect_refused({conic(1, "25,0,9,0,0,225,0,3,0,0,5")}, "has no ellipse");
  expect_refused({conic(3, "0,0,0,1,1,0,0,3,0,0,5")}, "no term of second degree");
  IgesEntity stretched = conic(1, "25,0,9,0,0,-225,0,3,0,0,5");
  stretched.matrix = 3;
  expect_refused(
      {stretched, {.type = 124, .parameters = "124,2,0,0,0,0,1,0,0,0,0,1,0;", .status = dependent}},
      "stretches");
}

TEST(RestatedIges, ArcsThatEndOffTheirCircleAreNamed) {
  expect_refused({{.type = 100, .parameters = "100,0.,0.,0.,5.,0.,0.,6.;"}},
                 "its start lies 5 from its centre");
  const ImportReport rounded =
      import_text(iges_text_of({{.type = 100, .parameters = "100,0,1,2,6,2,1,7.001;"}}));
  ASSERT_EQ(rounded.diagnostics.size(), 1U);
  EXPECT_EQ(rounded.diagnostics[0].severity, Severity::note);
  EXPECT_EQ(rounded.curves.size(), 1U);
}

TEST(RestatedIges, RaysAndInfiniteLinesAreNamed) {
  expect_refused({{.type = 110, .parameters = "110,0,0,0,10,0,0;", .form = 1}}, "it is a ray (form 1)");
  expect_refused({{.type = 110, .parameters = "110,0,0,0,10,0,0;", .form = 2}},
                 "it is an infinite line (form 2)");
  const ImportReport turned = import_text(
      iges_text_of({{.type = 110, .parameters = "110,0,0,0,0,0,1;", .form = 2, .status = dependent},
                    {.type = 110, .parameters = "110,5,0,0,5,0,9;", .status = dependent},
                    {.type = 120, .parameters = "120,1,3,0.,6.283185307179586;"}}));
  EXPECT_TRUE(turned.diagnostics.empty());
  EXPECT_TRUE(std::any_of(turned.curves.begin(), turned.curves.end(),
                          [](const ImportedCurve& curve) { return curve.is_centre_line(); }));
}

// IGES 5.3, 4.7: forms 1 to 3 are data points, 11 to 13 paths through them.
TEST(RestatedIges, PointsThatNothingConnectsAreNoted) {
  const auto notes_of = [](int form) {
    const std::string coordinates = "0.,0.,0.,5.,0.,0.,5.,7.,0.;";
    const ImportReport report =
        import_text(iges_text_of({{.type = 106, .parameters = "106,2,3," + coordinates, .form = form}}));
    EXPECT_GE(report.curves.size(), 1U);
    return report.diagnostics;
  };
  EXPECT_TRUE(notes_of(12).empty());
  const std::vector<Diagnostic> notes = notes_of(2);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].severity, Severity::note);
  EXPECT_NE(notes[0].message.find("points that nothing connects"), std::string::npos) << notes[0].message;
}

// IGES 5.3, 4.7: forms 20 to 40 are lines of a drawing, form 63 is a shape.
TEST(RestatedIges, LinesOfADrawingAreNotedAsNotRead) {
  const auto read = [](int form, int status) {
    return import_text(iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,100.,0.,0.;"},
                                     {.type = 106,
                                      .parameters = "106,1,4,0.,0.,0.,10.,0.,10.,5.,0.,0.;",
                                      .form = form,
                                      .status = status}}));
  };
  for (const int form : {20, 21, 31, 38, 40}) {
    const ImportReport report = read(form, 0);
    EXPECT_EQ(report.curves.size(), 1U) << form;
    ASSERT_EQ(report.diagnostics.size(), 1U) << form;
    EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
    EXPECT_NE(report.diagnostics[0].message.find("1 entities (106)"), std::string::npos);
    EXPECT_TRUE(read(form, dependent).diagnostics.empty()) << "of a dimension";
  }
  EXPECT_EQ(read(63, 0).curves.size(), 2U);
  EXPECT_TRUE(read(63, 0).diagnostics.empty());
}

TEST(RestatedIges, ReferencesToOtherFilesAreNamed) {
  const ImportReport report =
      import_text(iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,100.,0.,0.;"},
                                {.type = 416, .parameters = "416,9Hother.igs,4Hpart;"},
                                {.type = 416, .parameters = "416,9Hother.igs;", .form = 1}}));
  EXPECT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].message.find("2 entities (416)"), std::string::npos)
      << report.diagnostics[0].message;
}

IgesEntity offset_of(const std::string& range, int matrix = 0) {
  return {.type = 130,
          .parameters = "130,3,1,0,0,1,1.,0.,0.,0.,0.,0.,1.," + range + ";",
          .label = "beside",
          .matrix = matrix};
}

/// The offset of the entity by 1, to the left, has these ends in the coordinates of the entity.
void expect_offset(IgesEntity base, const std::string& range, const Eigen::Vector3d& start,
                   const Eigen::Vector3d& end) {
  base.status = dependent;
  for (const Unit& unit : units)
    for (const bool turned : {false, true}) {
      const ImportReport report =
          import_text(iges_text_of({offset_of(range, turned ? 5 : 0), base, turn}, unit.text));
      ASSERT_EQ(report.curves.size(), 1U);
      const NurbsCurve& curve = report.curves[0].curve;
      const Eigen::Affine3d place = turned ? place_of(turn) : Eigen::Affine3d::Identity();
      const double digits = report.curves[0].exact ? 1e-13 : 1e-7 / unit.in_metres;
      EXPECT_LE((start_of(curve) / unit.in_metres - place * start).norm(), digits) << base.parameters;
      EXPECT_LE((end_of(curve) / unit.in_metres - place * end).norm(), digits) << base.parameters;
    }
}

TEST(RestatedIges, OffsetCurvesHaveTheirDistanceAndParametersInTheUnitOfTheFile) {
  const IgesEntity line{.type = 110, .parameters = "110,1,0,2,21,0,2;"};
  expect_offset(line, "0,1", {1, 1, 2}, {21, 1, 2});
  expect_offset(line, "0.25,0.75", {6, 1, 2}, {16, 1, 2});
  const double half = 5 * std::sqrt(0.5);
  expect_offset({.type = 100, .parameters = "100,2,0,0,6,0,0,6;"}, "0,0.78539816339744831", {5, 0, 2},
                {half, half, 2});
  expect_offset({.type = 104, .parameters = "104,25,0,9,0,0,-225,2,3,0,0,5;", .form = 1},
                "0,1.5707963267948966", {2, 0, 2}, {0, 4, 2});
  expect_offset({.type = 104, .parameters = "104,1,0,0,0,-4,0,0,-2,1,0,0;", .form = 3}, "-2,0",
                {-2 + std::sqrt(0.5), 1 + std::sqrt(0.5), 0}, {0, 1, 0});
}

TEST(RestatedIges, OffsetCurvesThatAreNotReadAreNamed) {
  const auto refused = [](IgesEntity base, const std::string& range, const std::string& text) {
    base.status = dependent;
    expect_refused({offset_of(range), base}, text);
  };
  refused({.type = 104, .parameters = "104,25,0,9,0,0,-225,2,3,0,0,5;", .form = 1}, "0,1", "0 to 1; only");
  refused({.type = 104, .parameters = "104,1,0,-1,0,0,-9,0,5,-4,3,0;", .form = 2}, "0,1", "hyperbola");
  refused({.type = 110, .parameters = "110,1,0,2,21,0,2;"}, "1,0", "1 to 0; the first");
}

// OpenCASCADE makes one curve of it, without a control point.
TEST(RestatedIges, SplinesWithGapsArePiecesByThemselves) {
  const auto line_of = [](const std::string& third, int matrix = 0) {
    return import_text(iges_text_of(
        {{.type = 126,
          .parameters = "126,3,1,0,0,1,0,0,0,1,1,2,2,1,1,1,1,0,0,0,3,2,0," + third + ",7,7,0,0,2;",
          .matrix = matrix},
         {.type = 124, .parameters = "124,1,0,0,0,0,1,0,0,0,0,1,50;"}}));
  };
  const ImportReport apart = line_of("4,0,0"), together = line_of("3,2,0"), moved = line_of("4,0,0", 3);
  ASSERT_EQ(apart.curves.size(), 2U);
  EXPECT_NEAR(length(apart.curves[0].curve), 1e-3 * std::hypot(3, 2), 1e-12);
  EXPECT_NEAR(length(apart.curves[1].curve), 1e-3 * std::hypot(3, 7), 1e-12);
  ASSERT_EQ(apart.diagnostics.size(), 1U);
  EXPECT_NE(apart.diagnostics[0].where.find("D1 BSplineCurve"), std::string::npos)
      << apart.diagnostics[0].where;
  EXPECT_NE(apart.diagnostics[0].message.find("its knot 1 stands more often than its degree"),
            std::string::npos);
  EXPECT_NE(apart.diagnostics[0].message.find("2.236067977 apart"), std::string::npos)
      << apart.diagnostics[0].message;
  ASSERT_EQ(together.curves.size(), 1U);
  EXPECT_NEAR(length(together.curves[0].curve), 1e-3 * (std::hypot(3, 2) + std::hypot(4, 5)), 1e-12);
  ASSERT_EQ(moved.curves.size(), 2U);
  EXPECT_NEAR(moved.curves[1].curve.point(moved.curves[1].curve.knots().start()).z(), 0.05, 1e-12);
}

// Its range takes half of each piece; the parts of a composite curve that
// holds it stand by themselves.
TEST(RestatedIges, PiecesOfSplinesWithGapsKeepTheirRangeAndLeaveTheirCompositeCurve) {
  const ImportReport report = import_text(
      iges_text_of({{.type = 102, .parameters = "102,2,3,5;"},
                    {.type = 110, .parameters = "110,-5,0,0,0,0,0;", .status = dependent},
                    {.type = 126,
                     .parameters = "126,3,1,0,0,1,0,0,0,2,2,4,4,1,1,1,1,0,0,0,4,0,0,6,0,0,6,8,0,1,3;",
                     .status = dependent}}));
  ASSERT_EQ(report.curves.size(), 3U);
  std::vector<double> lengths;
  for (const ImportedCurve& curve : report.curves) lengths.push_back(1e3 * length(curve.curve));
  std::sort(lengths.begin(), lengths.end());
  EXPECT_NEAR(lengths[0], 2, 1e-9);
  EXPECT_NEAR(lengths[1], 4, 1e-9);
  EXPECT_NEAR(lengths[2], 5, 1e-9);
}

}  // namespace
}  // namespace nurbeam::restated_iges
