#include "pipelines/results/results_directory.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

using test::TemporaryDirectory;

std::string refusal(const std::filesystem::path& path) {
  try {
    const ResultsDirectory directory(path);
    directory.clear();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

bool directory_holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ResultsDirectory, IsMadeWithItsParentsAndTakenByOneAtATime) {
  const TemporaryDirectory temporary;
  const auto path = temporary.path() / "new" / "results";
  std::optional<ResultsDirectory> first(path);
  EXPECT_TRUE(std::filesystem::is_directory(path));
  EXPECT_TRUE(directory_holds(refusal(path), path.string() + ": another run")) << refusal(path);
  first.reset();
  EXPECT_EQ(refusal(path), "");
  EXPECT_TRUE(std::filesystem::is_empty(path));
}

TEST(ResultsDirectory, IsNotTakenWhereAnInputHasANameOfItsFiles) {
  const TemporaryDirectory temporary;
  const std::filesystem::path &place = temporary.path(), other = place / "other";
  for (const char* name : {"run.json", "deformed.step", "histories.csv", "frames/beams_000000.vtu",
                           "frames/connectors_000000.vtu"}) {
    EXPECT_TRUE(directory_holds(taken_by_input(place, {place / "cable.step", place / name}),
                                (place / name).string() + ": is an input of this run"));
    EXPECT_TRUE(directory_holds(taken_by_input(other / "..", {place / name}), "--out"));
    EXPECT_EQ(taken_by_input(other, {place / name}), "");
  }
  EXPECT_EQ(taken_by_input(place, {place / "case.json", place / "results.csv"}), "");
}

TEST(ResultsDirectory, LosesTheFilesOfAFormerRunAndKeepsAllOthers) {
  const TemporaryDirectory temporary;
  std::filesystem::create_directory(temporary.path() / "frames");
  for (const char* name : {"histories.csv",
                           "results.nc",
                           "results.nc.part",
                           "results.chunk0001.nc",
                           "restart.nc",
                           "restart.nc.part",
                           "run.json",
                           "run.log",
                           "report.html",
                           "frames.pvd",
                           "frames/beams_000000.vtu",
                           "frames/bodies_000012.vtu",
                           "frames/reactions_000000.vtu",
                           "frames/connectors_000000.vtu",
                           "frames/mode_3_beams_000001.vtu",
                           "frames/connectors_000001.vtu.part",
                           "deformed.step",
                           "deformed_t0.5.igs",
                           "deformed_t1e-05.step",
                           "deformed_0012.igs",
                           "deformed_t0.5_solid.step",
                           "deformed_t0_source.step",
                           "deformed_t0.5.dxf",
                           "deformed_0012.brep",
                           "deformed.step.part",
                           "deformed_t0.5_section_lines.step.part"})
    temporary.write(name, "");
  const std::vector<std::string> others = {"deformed_tip.step", "notes.txt",      "my_histories.csv",
                                           "deformed_t0.5.pdf", "results.nc.bak", "notes.txt.part"};
  for (const std::string& name : others) temporary.write(name, "");
  EXPECT_EQ(refusal(temporary.path()), "");
  for (const std::string& name : others)
    EXPECT_TRUE(std::filesystem::exists(temporary.path() / name)) << name;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(temporary.path()), {}),
            static_cast<std::ptrdiff_t>(others.size()));
}

TEST(ResultsDirectory, KeepsWhatElseLiesAmongTheFrames) {
  const TemporaryDirectory temporary;
  std::filesystem::create_directory(temporary.path() / "frames");
  temporary.write("frames/beams_000000.vtu", "");
  temporary.write("frames/camera.pvcc", "");
  ResultsDirectory(temporary.path()).clear();
  EXPECT_FALSE(std::filesystem::exists(temporary.path() / "frames/beams_000000.vtu"));
  EXPECT_TRUE(std::filesystem::exists(temporary.path() / "frames/camera.pvcc"));
}

TEST(ResultsDirectory, NamesTheFilesOfItsRunInOrder) {
  const TemporaryDirectory temporary;
  for (const char* name : {"run.log", "histories.csv", "notes.txt", "deformed_t0.igs"})
    temporary.write(name, "");
  EXPECT_EQ(ResultsDirectory(temporary.path()).files(),
            (std::vector<std::filesystem::path>{"deformed_t0.igs", "histories.csv", "run.log"}));
}

TEST(ResultsDirectory, SaysWhatStandsInItsWay) {
  const TemporaryDirectory temporary;
  const auto file = temporary.write("file", "");
  EXPECT_TRUE(directory_holds(refusal(file), file.string() + ": is a file; expected a directory"))
      << refusal(file);
  EXPECT_TRUE(directory_holds(refusal(file / "below"), "Not a directory")) << refusal(file / "below");
  EXPECT_TRUE(directory_holds(refusal("/proc/no"), "/proc/no: cannot be made")) << refusal("/proc/no");
  std::filesystem::create_directory(temporary.path() / "histories.csv");
  EXPECT_TRUE(directory_holds(refusal(temporary.path()), "histories.csv: is a directory"))
      << refusal(temporary.path());
}

}  // namespace
}  // namespace nurbeam
