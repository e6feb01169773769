// Loops over particles on all cores, whose results do not depend on how many cores there are: every particle is
// gathered by one thread, and sums are formed block by block and added in block order.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace curlew {

// Particles a block. Small enough to balance two cores, large enough to amortise a sum.
inline constexpr std::size_t block_size = 256;

inline std::size_t block_number(std::size_t n) { return (n + block_size - 1) / block_size; }

// f(begin, end) for consecutive blocks of [0, n).
template <class F>
void parallel_blocks(std::size_t n, F&& f) {
  const auto blocks = static_cast<std::ptrdiff_t>(block_number(n));
#pragma omp parallel for schedule(dynamic, 4)
  for (std::ptrdiff_t b = 0; b < blocks; ++b) {
    const std::size_t begin = static_cast<std::size_t>(b) * block_size;
    f(begin, std::min(n, begin + block_size));
  }
}

// f(i) for each i in [0, n).
template <class F>
void parallel_for(std::size_t n, F&& f) {
  parallel_blocks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f(i);
  });
}

// The sum over blocks of f(begin, end), which returns a T (a double, or a struct with +=), added in block order.
template <class T, class F>
T ordered_sum(std::size_t n, F&& f) {
  std::vector<T> partial(block_number(n));
  parallel_blocks(n, [&](std::size_t begin, std::size_t end) { partial[begin / block_size] = f(begin, end); });
  T total{};
  for (const T& p : partial) total += p;
  return total;
}

// The sum over particles of the double f(i), added in the same order on any number of threads.
template <class F>
double particle_sum(std::size_t n, F&& f) {
  return ordered_sum<double>(n, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += f(i);
    return sum;
  });
}

// Where a value is largest: the first such particle, on any number of threads. NaN counts as larger than anything, so
// that a guard finds it.
struct Largest {
  double value = -1e300;
  std::size_t index = 0;
};

template <class F>
Largest particle_max(std::size_t n, F&& f) {
  std::vector<Largest> partial(block_number(n));
  parallel_blocks(n, [&](std::size_t begin, std::size_t end) {
    Largest best{f(begin), begin};
    for (std::size_t i = begin + 1; i < end && best.value == best.value; ++i) {
      const double value = f(i);
      if (!(value <= best.value)) best = {value, i};
    }
    partial[begin / block_size] = best;
  });
  Largest best;
  for (const Largest& p : partial) {
    if (best.value == best.value && !(p.value <= best.value)) best = p;
  }
  return best;
}

}  // namespace curlew
