#pragma once
#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace nurbeam {

/// While it lives, work is done by no more than so many threads; without one by as many as the process may
/// run at once. What comes out never depends on it.
class ThreadLimit {
 public:
  /// `most`: at least 1.
  explicit ThreadLimit(int most);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Pieces of work that go on beside their thread, one after another, where a second one is free.
class Alongside {
 public:
  Alongside();
  /// Waits for the piece that is under way, and leaves those that come after it.
  ~Alongside();
  Alongside(const Alongside&) = delete;
  Alongside& operator=(const Alongside&) = delete;

  /// To be done after all that have been added before.
  void add(std::function<void()> work);
  /// Until all are done; throws on what one of them has thrown, behind which the others are left.
  void finish();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Calls work(context, i) for i = 0 .. count - 1, several at a time and in no order.
void side_by_side(int count, void (*work)(const void* context, int i), const void* context);

/// Calls work(i) for i = 0 .. count - 1, several at a time and in no order: the calls write to different
/// places, and an exception of one is thrown on.
template <class Work>
void side_by_side(int count, const Work& work) {
  side_by_side(
      count, [](const void* of, int i) { (*static_cast<const Work*>(of))(i); }, &work);
}

/// Calls both, at a time where a second thread is free: neither looks at what the other writes, and an
/// exception of one is thrown on.
template <class One, class Other>
void both(const One& one, const Other& other) {
  side_by_side(
      2, [&](int i) { i == 0 ? one() : other(); });
}

/// Calls work(first, end) for the pieces of 0 .. size - 1: for all of it at once where it is shorter than two
/// pieces, else for several pieces at a time, as side_by_side does.
template <class Work>
void by_pieces(long size, long piece, const Work& work) {
  if (size < 2 * piece) return work(0L, size);
  const long count = size / piece;
  side_by_side(static_cast<int>(count),
               [&](int i) { work(i * piece, i + 1 < count ? (i + 1) * piece : size); });
}

/// The largest of what work(first, end) returns for such pieces, which is not below 0; not a number where one
/// of them is not.
template <class Work>
double largest_of_pieces(long size, long piece, const Work& work) {
  if (size < 2 * piece) return work(0L, size);
  std::vector<double> of(static_cast<std::size_t>(size / piece));
  by_pieces(size, piece,
            [&](long first, long end) { of[static_cast<std::size_t>(first / piece)] = work(first, end); });
  double largest = 0;
  for (const double each : of) largest = each >= largest || each != each ? each : largest;
  return largest;
}

}  // namespace nurbeam
