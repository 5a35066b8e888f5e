// SPDX-License-Identifier: BSD-3-Clause
#include "ekf/ekf.hpp"

#include "ekf/ekf_companions.hpp"
#include "ekf/ekf_compose.hpp"
#include "ekf/ekf_state.hpp"
#include "ekf/ekf_update.hpp"

namespace cairn {

template class Ekf<SE2>;
template class Ekf<SE3>;

}  // namespace cairn
