#include "pipelines/papers/papers.h"

#include <chrono>
#include <ostream>

namespace nurbeam {

void write_papers(const std::filesystem::path& directory, std::ostream& progress) {
  using namespace papers;
  const auto start = std::chrono::steady_clock::now();
  Page page(directory);
  page.heading("The examples of the papers", 1);
  page.paragraph(
      "Ding, Z.; Ouyang, B. A Variable-Length Rational Finite Element Based on the Absolute Nodal Coordinate "
      "Formulation. Machines 2022, 10, 174. This page is written by `nurbeam verify papers --out docs`, "
      "numbers "
      "in sentences too; wall times are those of the machine it ran on.");
  page.paragraph(
      "**Ours** are nurbeam's defaults, but for the axial strain, which is the papers' pointwise one: weights "
      "that follow the material, velocities projected, energy kept. "
      "**Paper's rule** is ALE-RANCF as the paper has it: constant weights, Eqs. 29-38, nodal velocities "
      "kept. "
      "**All ones** is the same with weights 1 after a merge, **ALE-ANCF** the element with weights 1 "
      "throughout. All are computed by this program; but for the section on forms all are form V (see "
      "[theory](theory.md)), which the paper's equations are not. The paper prints numbers only in its "
      "Tables "
      "1 and 2: its figures are compared by what it says of them. The references marked in figures are runs "
      "of "
      "two other programs with their errors (1e-5 m in Example 1, 2e-5 m in Examples 2 and 3 as drawn, 1e-4 "
      "m "
      "in Example 3 straight).");
  page.paragraph(
      "What became of each item of both papers, [D] the element and [S] the subdivision. *Reproduced*: computed, "
      "and as the paper says. *Corrected*: as the paper has it it is wrong, which is shown beside what nurbeam "
      "does instead. *Not to be had*: the paper's text does not hold it.");
  page.place_status();
  write_equations(page);
  write_falling_beam(page, progress);
  write_suspended_beam(page, progress);
  write_cable(page, progress);
  write_semicircle(page, progress);
  write_forms(page, progress);
  write_axial_strain(page, progress);
  write_events(page, progress);
  write_accuracy(page, progress);
  write_pendulum(page, progress);
  page.write();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  progress << "papers: done in " << number(seconds) << " s: " << (directory / "papers.md").string() << '\n';
}

}  // namespace nurbeam
