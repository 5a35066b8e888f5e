// SPDX-License-Identifier: BSD-3-Clause
// Guesses of the transform between two maps: each lays a triangle of map b onto a triangle of map a.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"
#include "map/merge/correspondence.hpp"
#include "map/merge/indexed_points.hpp"
#include "map/merge/triangles.hpp"

namespace cairn {

// A triangle of b that lies on a triangle of a: corner b[i] on corner a[i].
struct TriangleHypothesis {
  double score;   // how surprising its support is: sum of log(spacing / tolerance) over the supporting neighbours
  double misfit;  // of the sides, chi-square of 3
  std::array<std::uint32_t, 3> a, b;
};

class TriangleHypotheses {
 public:
  // `gate` bounds the misfit. The points and the options must outlive this object.
  TriangleHypotheses(const IndexedPoints& a, const IndexedPoints& b, const CorrespondenceOptions& options, double gate);

  // Whether both maps have triangles. Without them, propose() may not be called.
  bool possible() const { return !in_a_.triangles.empty() && !in_b_.triangles.empty(); }
  double spacing() const { return in_a_.spacing; }  // median distance between a point of a and its nearest, m

  // Finds the hypotheses and ranks them.
  void propose();
  const std::vector<TriangleHypothesis>& ranked() const { return hypotheses_; }  // the best first
  std::size_t tried() const { return tried_; }                                   // hypotheses whose sides agree
  bool exhausted() const { return exhausted_; }  // there were more hypotheses than the budget

 private:
  void consider(const Triangle& a, const Triangle& b);
  double support(const TriangleHypothesis& h, const SE3& T, double variance, double height) const;

  const IndexedPoints& a_;
  const IndexedPoints& b_;
  const CorrespondenceOptions& options_;
  const double gate_;
  const Triangles in_a_, in_b_;
  std::vector<TriangleHypothesis> hypotheses_;
  std::size_t tried_ = 0;
  bool exhausted_ = false;
};

}  // namespace cairn
