#include "cad_import/files/told_share.h"

#include <unistd.h>

#include <optional>

namespace nurbeam {
namespace {

std::optional<off_t>& place_of_share() {
  static std::optional<off_t> place;
  return place;
}

}  // namespace

void tell_share(double share) {
  if (!place_of_share()) return;
  [[maybe_unused]] const ssize_t written = pwrite(STDIN_FILENO, &share, sizeof share, *place_of_share());
}

void begin_to_tell_share(std::size_t request_size) { place_of_share() = static_cast<off_t>(request_size); }

double told_share(int descriptor, std::size_t request_size) {
  double share = 0;
  const ssize_t count = pread(descriptor, &share, sizeof share, static_cast<off_t>(request_size));
  return count == sizeof share && share >= 0 && share <= 1 ? share : 0;
}

}  // namespace nurbeam
