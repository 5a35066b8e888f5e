// SPDX-License-Identifier: BSD-3-Clause
// What updates of every kind share: a batch, linearised as often as it takes, and committed. `linearise(nullptr)` fills
// the batch at the iterate; linearise(residual) gives its residual there alone; both are false where a row has none.
#pragma once

#include "core/error.hpp"
#include "ekf/ekf.hpp"
#include "sensor/absolute_fix.hpp"

namespace cairn {

[[noreturn]] inline void throw_not_definite() {
  throw Error(ErrorCode::numerical,
              "update: the covariance would not stay positive definite; nothing was changed. Is the noise realistic?");
}

// Linearises the batch at the iterate and forms S. Every row has been foreseen by the time it is asked for; a sensor of
// the caller's that refuses it now would leave the batch torn.
template <class Pose, class Linearise>
void fill_batch(Ekf<Pose>& ekf, Linearise&& linearise) {
  if (!linearise(nullptr))
    throw Error(ErrorCode::numerical,
                "sensor: it refused a landmark that it had seen a moment before; nothing was changed");
  ekf.compute_innovation();
}

// When an iterated update ends.
struct Iterations {
  int most = 3;
  double tolerance = 0.1;  // of Ekf::misfit()
  bool relative = true;    // all rows see points R^T (l - p) alone
};

// Gauss-Newton on the batch (iterated EKF), which stands factored at the prediction, and the commit; returns how often
// it was linearised. It ends where the linearisation foresaw the residual; but rows that are not relative have
// Jacobians that turn with the position, of which a residual tells nothing: they are linearised once more in any case.
// `residual` is room for the batch's rows.
template <class Pose, class Linearise>
int iterate_and_commit(Ekf<Pose>& ekf, const Iterations& end, double* residual, Linearise&& linearise) {
  int i = 1;
  for (;; ++i) {
    ekf.solve();
    if (i >= end.most) break;
    ekf.step();
    // A landmark may lose its image on the way: what was linearised last stands.
    if (!linearise(residual)) break;
    if ((end.relative || i > 1) && !(ekf.misfit(residual) > end.tolerance)) break;
    fill_batch(ekf, linearise);
    if (!ekf.factor()) throw_not_definite();
  }
  if (!ekf.commit()) throw_not_definite();
  return i;
}

// The batch of an absolute fix, for the functions above; the window holds the pose alone.
template <class Pose>
bool linearise_fix(Ekf<Pose>& ekf, const AbsoluteFix<Pose>& fix, double* residual_only) {
  const Pose T = ekf.iterate_pose();
  if (!fix.defined(T)) return false;
  const Vector3 residual = fix.residual(T);
  const Index rows = fix.rows();
  std::copy_n(residual.data(), rows, residual_only != nullptr ? residual_only : ekf.batch().residual());
  if (residual_only != nullptr) return true;
  ekf.batch().clear();
  const Index row = ekf.batch().add_rows(rows);
  ekf.add_pose_block(row, rows, fix.jacobian(T), false);
  double* noise = ekf.batch().add_noise(row, rows);
  for (Index c = 0; c < rows; ++c)
    for (Index r = 0; r < rows; ++r) noise[c * rows + r] = fix.covariance()(r, c);
  return true;
}

// Squared Mahalanobis distance of up to 3 values against the lower triangle of their covariance; negative where that is
// not positive definite.
inline double squared_distance(const double* residual, const double* covariance, Index ld, Index rows) {
  double L[9], x[3];
  for (Index c = 0; c < rows; ++c) {
    x[c] = residual[c];
    for (Index r = c; r < rows; ++r) L[c * 3 + r] = covariance[c * ld + r];
  }
  if (!cholesky(L, 3, rows)) return -1.0;
  solve_lower(L, 3, rows, x);
  double sum = 0.0;
  for (Index r = 0; r < rows; ++r) sum += x[r] * x[r];
  return sum;
}

// While the distance of a batch of `count` blocks of `rows` rows exceeds `bound(rows left)`, the block goes without
// which it falls most, and `refuse(block, distance before, bound)` hears of it. Leaving block i out takes u_i^T
// (S^-1)_ii^-1 u_i off the distance. Given are the full S^-1, u = S^-1 r and r^T u; `workspace` as leave_out() wants
// it. Returns how many are left.
template <class Bound, class Refused, class Refuse>
Index gate_by_inverse(double* inverse, Index count, Index rows, double* u, double distance, double* workspace,
                      Bound&& bound, Refused&& refused, Refuse&& refuse) {
  const Index m = count * rows;
  Index left = count;
  while (left > 0 && distance > bound(left * rows)) {
    Index worst = -1;
    double largest = -1.0;
    for (Index a = 0; a < count; ++a) {
      if (refused(a)) continue;
      const double fall = squared_distance(u + a * rows, inverse + a * rows * (m + 1), m, rows);
      if (fall > largest) largest = fall, worst = a;
    }
    if (worst < 0) throw_not_definite();
    leave_out(inverse, m, worst * rows, rows, u, workspace);
    refuse(worst, distance, bound(left * rows));
    distance -= largest;
    --left;
  }
  return left;
}

// The same for a batch of the filter whose S is formed. S is spoilt unless all blocks are left: then it stands
// factored. `u` is room for the rows.
template <class Pose, class Bound, class Refused, class Refuse>
Index gate_jointly(Ekf<Pose>& ekf, Index count, Index rows, double* u, Bound&& bound, Refused&& refused,
                   Refuse&& refuse) {
  if (!ekf.factor()) throw_not_definite();
  if (ekf.nis() <= bound(count * rows)) return count;
  ekf.form_innovation();  // the factor stands where it was
  double* inverse = ekf.inverse_innovation();
  if (inverse == nullptr) throw_not_definite();
  const double distance = ekf.distance_by_inverse(u);
  return gate_by_inverse(inverse, count, rows, u, distance, ekf.scratch(), bound, refused, refuse);
}

}  // namespace cairn
