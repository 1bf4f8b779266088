#include "pipelines/diagnostics/terminal_width.h"

#include <sys/ioctl.h>
#include <unistd.h>

namespace nurbeam {

std::optional<int> terminal_width(int file) {
  winsize size{};
  if (isatty(file) == 0 || ioctl(file, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return {};
  return size.ws_col;
}

}  // namespace nurbeam
