#pragma once

namespace nurbeam {

/// The state of an element of this length, drawn straight and bent a little, so that no term vanishes.
template <class Layout, class State>
State bent_element(double length) {
  State x;
  x.q.setZero();
  x.v.setConstant(0.1);
  x.a.setConstant(0.2);
  for (const int end : {0, 1}) {
    x.q[Layout::r(end)] = end * length;
    x.q[Layout::r(end) + 1] = 0.02 * end * length;
    x.q[Layout::slope(end)] = 1;
    x.q[Layout::slope(end) + 1] = 0.1 * end;
    x.q[Layout::place(end)] = end * length;
  }
  return x;
}

}  // namespace nurbeam
