#pragma once
#include <algorithm>
#include <ctime>
#include <vector>

namespace bench {

/// Processor time of this thread: what other programs do on the machine does not count.
inline double seconds() {
  std::timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Medians of two candidates that take turns, so that a slow moment of the machine meets both.
struct Pair {
  double a, b;
};
template <class A, class B>
Pair alternate(int repeats, A a, B b) {
  std::vector<double> of_a, of_b;
  for (int k = 0; k < repeats; ++k) {
    double start = seconds();
    a();
    of_a.push_back(seconds() - start);
    start = seconds();
    b();
    of_b.push_back(seconds() - start);
  }
  return {median(of_a), median(of_b)};
}

}  // namespace bench
