#include "cad_import/occt/end_parameters.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRep_Builder.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS_Vertex.hxx>
#include <random>

namespace nurbeam {
namespace {

Handle(Geom_BSplineCurve) random_cubic(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-50, 50);
  TColgp_Array1OfPnt poles(1, 7);
  for (gp_Pnt& pole : poles) pole = gp_Pnt(place(random), place(random), place(random));
  TColStd_Array1OfReal knots(1, 5);
  TColStd_Array1OfInteger multiplicities(1, 5);
  for (int i = 1; i <= 5; ++i) {
    knots(i) = 0.25 * (i - 1);
    multiplicities(i) = i == 1 || i == 5 ? 4 : 1;
  }
  return new Geom_BSplineCurve(poles, knots, multiplicities, 3);
}

TEST(EndParameters, OfPointsOnATwistedSplineAreTheirs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  for (int i = 0; i < 300; ++i) {
    const Handle(Geom_BSplineCurve) curve = random_cubic(random);
    const double u = place(random);
    EXPECT_LE(curve->Value(closest_parameter(*curve, curve->Value(u))).Distance(curve->Value(u)), 1e-12);
  }
}

TEST(EndParameters, OfAnEdgeAreThoseOfItsVerticesWhereTheseLieOnTheCurve) {
  std::mt19937 random(2);
  const Handle(Geom_BSplineCurve) curve = random_cubic(random);
  const BRep_Builder builder;
  const auto vertex = [&](const gp_Pnt& at) {
    TopoDS_Vertex made;
    builder.MakeVertex(made, at, 100);  // so loosely that the edge is made with other parameters too
    return made;
  };
  const auto ends = [&](const gp_Pnt& start, const gp_Pnt& end) {
    const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(curve, vertex(start), vertex(end), 0.2, 0.9).Edge();
    double first = 0.2, last = 0.9;
    correct_ends(edge, *curve, first, last);
    return std::pair(first, last);
  };
  const auto corrected = ends(curve->Value(0.1), curve->Value(0.95));
  EXPECT_NEAR(corrected.first, 0.1, 1e-12);
  EXPECT_NEAR(corrected.second, 0.95, 1e-12);
  // One that is on the curve nowhere leaves the edge as it is.
  const auto kept = ends(curve->Value(0.2).Translated(gp_Vec(0.1, 0.1, 0.1)), curve->Value(0.9));
  EXPECT_EQ(kept, std::pair(0.2, 0.9));
}

}  // namespace
}  // namespace nurbeam
