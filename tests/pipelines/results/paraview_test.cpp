#include "pipelines/results/paraview.h"

#include <gtest/gtest.h>

#include "pipelines/results/base64.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

TEST(Paraview, RationalCoefficientsTakeTheSamplesAtThirds) {
  const Eigen::Vector4d samples(1.5, -2, 7, 0.25), weights(1, 0.4, 2, 0.8);
  const Eigen::Vector4d c = rational_coefficients(samples, weights);
  for (int i = 0; i < 4; ++i) {
    const double u = i / 3.0, v = 1 - u;
    const Eigen::Vector4d b(v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u);
    EXPECT_NEAR(b.cwiseProduct(weights).dot(c) / b.dot(weights), samples[i], 1e-14);
  }
}

TEST(Paraview, AConstantFieldHasConstantCoefficients) {
  const Eigen::Vector4d c = rational_coefficients(Eigen::Vector4d::Constant(3), {1, 0.4, 2, 0.8});
  EXPECT_NEAR((c.array() - 3).abs().maxCoeff(), 0, 1e-14);
}

// VTK itself reads the series in tests/paraview; here is what does not need it.
TEST(Paraview, AResumedSeriesKeepsTheFramesBeforeIt) {
  const test::TemporaryDirectory directory;
  Snapshot frame;
  frame.beams.resize(1);
  const auto index = [&] {
    std::ifstream stream(directory.path() / "frames.pvd");
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  ParaviewSeries whole(directory.path(), {{}, {}, {"beam"}});
  for (const double time : {0.0, 0.1, 0.2}) {
    frame.time = time;
    whole.write(frame);
  }
  whole.write_index();
  const std::string expected = index();
  ParaviewSeries rest(directory.path(), {{}, {}, {"beam"}}, {0.0, 0.1});
  rest.write(frame);
  rest.write_index();
  EXPECT_EQ(index(), expected);
  EXPECT_NE(expected.find("timestep=\"0.2\" part=\"0\" name=\"beams\" file=\"frames/beams_000002.vtu\""),
            std::string::npos);
}

// Half a turn about z.
TEST(Paraview, RigidBodiesAreBoxesThatTurn) {
  const test::TemporaryDirectory directory;
  Snapshot frame;
  frame.beams.resize(1);
  frame.bodies.resize(2);
  frame.bodies[1].point.position = {10, 20, 30};
  frame.bodies[1].turn = TurnRecord{{0, 0, 0, 1}, Eigen::Vector3d::Zero()};
  ParaviewSeries series(directory.path(), {.bodies = {"point", "box"}, .beams = {"beam"}}, {}, "",
                        {Eigen::Matrix3d::Zero(), Eigen::Vector3d(1, 2, 3).asDiagonal()});
  series.write(frame);
  series.write_index();
  const auto text = [&](const char* name) {
    std::ifstream stream(directory.path() / name);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_NE(text("frames.pvd").find("name=\"boxes\" file=\"frames/boxes_000000.vtu\""), std::string::npos);
  const std::string grid = text("frames/boxes_000000.vtu");
  EXPECT_NE(grid.find("NumberOfPoints=\"8\" NumberOfCells=\"1\""), std::string::npos);
  const double corners[] = {11, 22, 27, 9, 22, 27, 9, 18, 27, 11, 18, 27,
                            11, 22, 33, 9, 22, 33, 9, 18, 33, 11, 18, 33};
  std::string bytes(8, '\0');
  bytes[0] = static_cast<char>(sizeof corners);
  bytes.append(reinterpret_cast<const char*>(corners), sizeof corners);
  EXPECT_NE(grid.find(base64(bytes.data(), bytes.size())), std::string::npos);
}

TEST(Paraview, ConnectorsAreLinesBetweenTheirEnds) {
  const test::TemporaryDirectory directory;
  Snapshot frame;
  frame.beams.resize(1);
  frame.connectors = {{.length = 5, .force = 7, .from = {1, 2, 3}, .to = {4, 2, 7}}};
  ParaviewSeries series(directory.path(), {.beams = {"beam"}, .connectors = {"dropper"}});
  series.write(frame);
  series.write_index();
  const auto text = [&](const char* name) {
    std::ifstream stream(directory.path() / name);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_NE(text("frames.pvd").find("name=\"connectors\" file=\"frames/connectors_000000.vtu\""),
            std::string::npos);
  const std::string grid = text("frames/connectors_000000.vtu");
  EXPECT_NE(grid.find("NumberOfPoints=\"2\" NumberOfCells=\"1\""), std::string::npos);
  const double ends[] = {1, 2, 3, 4, 2, 7};
  std::string bytes(8, '\0');
  bytes[0] = sizeof ends;
  bytes.append(reinterpret_cast<const char*>(ends), sizeof ends);
  EXPECT_NE(grid.find(base64(bytes.data(), bytes.size())), std::string::npos);
}

}  // namespace
}  // namespace nurbeam
