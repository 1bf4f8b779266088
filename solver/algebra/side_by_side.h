#pragma once
#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace nurbeam {

/// A limit of the number of threads, while it lives; without one as many work as the process may run at once.
/// Results never depend on it.
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

/// Pieces of work that run beside their thread, one after another, if a second thread is free.
class Alongside {
 public:
  Alongside();
  /// Waits for the piece that is under way, and drops the pieces after it.
  ~Alongside();
  Alongside(const Alongside&) = delete;
  Alongside& operator=(const Alongside&) = delete;

  /// Adds a piece, to be done after all earlier ones.
  void add(std::function<void()> work);
  /// Waits until all pieces are done. Rethrows the exception of a piece; the pieces behind it are dropped.
  void finish();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Calls work(context, i) for i = 0 .. count - 1, several at a time and in no order.
void side_by_side(int count, void (*work)(const void* context, int i), const void* context);

/// Calls work(i) for i = 0 .. count - 1, several at a time and in no order. The calls must write to different
/// places; an exception of one is rethrown.
template <class Work>
void side_by_side(int count, const Work& work) {
  side_by_side(
      count, [](const void* of, int i) { (*static_cast<const Work*>(of))(i); }, &work);
}

/// Calls both functions, at the same time if a second thread is free. Neither may read what the other writes;
/// an exception of one is rethrown.
template <class One, class Other>
void both(const One& one, const Other& other) {
  side_by_side(
      2, [&](int i) { i == 0 ? one() : other(); });
}

/// Calls work(first, end) for pieces of 0 .. size - 1: once for all if shorter than two pieces, else for
/// several pieces at a time, as side_by_side does.
template <class Work>
void by_pieces(long size, long piece, const Work& work) {
  if (size < 2 * piece) return work(0L, size);
  const long count = size / piece;
  side_by_side(static_cast<int>(count),
               [&](int i) { work(i * piece, i + 1 < count ? (i + 1) * piece : size); });
}

/// The maximum of the results of work(first, end), which are not below 0, over the pieces of by_pieces; not a
/// number if one result is not.
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
