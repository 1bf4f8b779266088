#pragma once
#include <cstddef>

namespace nurbeam {

/// A child process writes which share of its work it has done, from 0 to 1, behind the request in the memory
/// that its standard input is, where its parent looks it up.
void tell_share(double share);

/// A part of the time that some work takes, from one share of the whole to another.
struct PartOfWork {
  double begin, end;
};

/// That `done` of `all` of a part are done; every thousandth of them is told.
inline void tell_share_of(const PartOfWork& part, std::size_t done, std::size_t all) {
  if (done % (all / 1000 + 1) == 0)
    tell_share(part.begin + (part.end - part.begin) * static_cast<double>(done) / static_cast<double>(all));
}

/// Tells shares from now on, behind a request of this size.
void begin_to_tell_share(std::size_t request_size);

/// The share that was told last behind the request in this memory; 0 where none was.
double told_share(int descriptor, std::size_t request_size);

}  // namespace nurbeam
