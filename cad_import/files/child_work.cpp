#include "cad_import/files/child_work.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "cad_import/files/child_message.h"
#include "cad_import/files/child_process.h"
#include "cad_import/files/told_share.h"

namespace nurbeam {
namespace {

void limit(decltype(RLIMIT_CPU) resource, rlim_t soft, rlim_t hard) {
  const rlimit value{soft, hard};
  setrlimit(resource, &value);
}

void apply(const ChildLimits& limits) {
  const auto seconds = static_cast<rlim_t>(std::max<std::chrono::seconds::rep>(limits.time.count(), 1));
  limit(RLIMIT_CPU, seconds, seconds + 1);
  limit(RLIMIT_CORE, 0, 0);
  if (limits.memory_bytes > 0 && can_limit_memory())
    limit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
}

void send(int descriptor, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = write(descriptor, data, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return;
    data += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

void send_message(int descriptor, char status, const char* text, std::uint64_t size) {
  char header[child_message::header_size] = {status};
  std::memcpy(header + 1, &size, sizeof size);
  send(descriptor, header, sizeof header);
  send(descriptor, text, size);
}

std::string all_of(int descriptor) {
  std::string bytes;
  char buffer[1 << 16];
  for (ssize_t count = 1; count != 0;) {
    count = read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno != EINTR) break;
    if (count > 0) bytes.append(buffer, static_cast<std::size_t>(count));
  }
  return bytes;
}

}  // namespace

int serve_one_request(int argc, char** argv, const std::function<std::string(const std::string&)>& work) {
  if (argc != 4) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != std::atoi(argv[1])) return 2;  // it has died already
  apply({std::chrono::seconds(std::atoll(argv[2])), static_cast<std::size_t>(std::atoll(argv[3]))});
  try {
    const std::string request = all_of(STDIN_FILENO);
    begin_to_tell_share(request.size());
    const std::string output = work(request);
    send_message(child_message::descriptor, child_message::done, output.data(), output.size());
  } catch (const std::bad_alloc&) {
    send_message(child_message::descriptor, child_message::out_of_memory, "", 0);
  } catch (const std::exception& e) {
    send_message(child_message::descriptor, child_message::failed, e.what(), std::strlen(e.what()));
  } catch (...) {
    send_message(child_message::descriptor, child_message::failed, "unknown exception", 17);
  }
  _exit(0);  // what a damaged file has left behind is not tidied up
}

}  // namespace nurbeam
