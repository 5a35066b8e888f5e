// SPDX-License-Identifier: BSD-3-Clause
// Several doubles that are computed with lane by lane, for compilers without vector types (core/compiler.hpp). The
// operations and their order are those of the vector types.
#pragma once

#include <cstddef>

namespace cairn {

template <std::ptrdiff_t count>
struct Lanes {
  double value[count];

  double operator[](std::ptrdiff_t i) const { return value[i]; }
  Lanes& operator+=(const Lanes& other) {
    return apply(other, [](double a, double b) { return a + b; });
  }
  Lanes& operator-=(const Lanes& other) {
    return apply(other, [](double a, double b) { return a - b; });
  }
  Lanes& operator*=(const Lanes& other) {
    return apply(other, [](double a, double b) { return a * b; });
  }
  Lanes& operator*=(double factor) { return *this *= all(factor); }
  friend Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
  friend Lanes operator*(Lanes a, const Lanes& b) { return a *= b; }
  friend Lanes operator*(const Lanes& a, double factor) { return Lanes(a) *= factor; }
  friend Lanes operator*(double factor, const Lanes& b) { return all(factor) *= b; }
  friend Lanes operator-(double minuend, const Lanes& b) { return all(minuend) -= b; }

 private:
  static Lanes all(double x) {
    Lanes lanes;
    for (double& lane : lanes.value) lane = x;
    return lanes;
  }
  template <class Operation>
  Lanes& apply(const Lanes& other, Operation operation) {
    for (std::ptrdiff_t i = 0; i < count; ++i) value[i] = operation(value[i], other.value[i]);
    return *this;
  }
};

}  // namespace cairn
