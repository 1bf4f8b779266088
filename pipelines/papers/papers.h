#pragma once
#include <filesystem>
#include <iosfwd>

#include "pipelines/papers/papers_page.h"

namespace nurbeam {

struct PendulumMotion;

/// Computes the examples of Ding & Ouyang 2022 and of the subdivision paper and writes what came out beside
/// what the papers have, as DIR/papers.md with its figures; what is being computed goes to `progress`. Throws
/// std::runtime_error (file and reason) when a file cannot be written.
void write_papers(const std::filesystem::path& directory, std::ostream& progress);

namespace papers {

/// The sections of the page.
void write_equations(Page& page);
void write_falling_beam(Page& page, std::ostream& progress);
void write_suspended_beam(Page& page, std::ostream& progress);
void write_cable(Page& page, std::ostream& progress);
void write_semicircle(Page& page, std::ostream& progress);
void write_forms(Page& page, std::ostream& progress);
void write_axial_strain(Page& page, std::ostream& progress);
void write_events(Page& page, std::ostream& progress);
void write_accuracy(Page& page, std::ostream& progress);
void write_pendulum(Page& page, std::ostream& progress);
void write_subdivision(Page& page);
/// The pendulum converged with either curvature.
void write_calculix(Page& page, const PendulumMotion& spatial, const PendulumMotion& material);
void write_grading(Page& page, const PendulumMotion& fine);
/// `fine`: the pendulum with the metric, converged.
void write_printed_pendulum(Page& page, const PendulumMotion& fine);

}  // namespace papers

}  // namespace nurbeam
