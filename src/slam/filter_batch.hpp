// SPDX-License-Identifier: BSD-3-Clause
// What updates of every kind share: a batch, linearised as often as it takes, and committed. `linearise(nullptr)` fills
// the batch at the iterate; linearise(residual) gives its residual there alone; both are false where a row has none.
#pragma once

#include "core/error.hpp"
#include "slam/filter.hpp"

namespace cairn {

// Linearises the batch at the iterate and forms S. Every row has been foreseen by the time it is asked for; a sensor of
// the caller's that refuses it now would leave the batch torn.
template <class Linearise>
void Filter::fill(Linearise&& linearise) {
  if (!linearise(nullptr)) {
    say("update: a sensor refused a landmark that it had seen a moment before");
    throw Error(ErrorCode::numerical,
                "sensor: it refused a landmark that it had seen a moment before; nothing was changed");
  }
  ekf_.compute_innovation();
}

// Gauss-Newton on the batch (iterated EKF), which stands factored at the prediction. It ends where the linearisation
// foresaw the residual; but rows that are not relative have Jacobians that turn with the position, of which a residual
// tells nothing: they are linearised once more in any case.
template <class Linearise>
void Filter::iterate(int iterations, bool relative, Linearise&& linearise) {
  next_report_.nis = ekf_.nis();
  for (int i = 1;; ++i) {
    ekf_.solve();
    next_report_.iterations = i;
    if (i >= iterations) break;
    ekf_.step();
    // A landmark may lose its image on the way: what was linearised last stands.
    if (!linearise(residual_)) break;
    if ((relative || i > 1) && !(ekf_.misfit(residual_) > options_.iteration_tolerance)) break;
    fill(linearise);
    if (!ekf_.factor()) throw_not_definite();
  }
  next_report_.rows = ekf_.batch().rows();
  if (!ekf_.commit()) throw_not_definite();
}

}  // namespace cairn
