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
      "For those who know the papers, and for those who compare programs. This page has every example, "
      "table and figure of both papers beside nurbeam's results. `nurbeam verify papers --out docs` writes "
      "it, numbers in sentences too; wall times are those of its machine.");
  page.paragraph(
      "Sources: **[D]** Ding, Z.; Ouyang, B. A Variable-Length Rational Finite Element Based on the "
      "Absolute Nodal Coordinate Formulation. Machines 2022, 10, 174. **[S]** the paper on the subdivision "
      "of RANCF elements.");
  page.paragraph(
      "Four methods are compared. **Ours** are nurbeam's defaults, except for the papers' pointwise axial "
      "strain: weights follow the material, velocities are projected, energy is conserved. **Paper's rule** "
      "is ALE-RANCF as in the paper: constant weights, Eqs. 29-38, nodal velocities unchanged. **All ones** "
      "is the same with weights 1 after a merge. **ALE-ANCF** is the element with weights 1 throughout.");
  page.paragraph(
      "This program computes all of them. Except in the section on forms all have form V (see "
      "[theory](theory/5-motion.md)), which the paper's equations do not have. The paper prints numbers "
      "only in its Tables 1 and 2; its figures are compared by its text. The references marked in figures "
      "are runs of two other programs. Their errors are 1e-5 m in Example 1, 2e-5 m in Examples 2 and 3 "
      "stress-free in the shape of the file, and 1e-4 m in Example 3 straight.");
  page.paragraph(
      "The table has each item of both papers. *Reproduced*: computed, and as the paper says. *Corrected*: "
      "the paper's version is wrong, which is shown beside nurbeam's. *Not to be had*: the paper's text "
      "does not contain it.");
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
