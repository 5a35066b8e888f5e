// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The simulator in C++17: World and Fleet. Link libcairn_sim, too.
#ifndef CAIRN_SIM_HPP
#define CAIRN_SIM_HPP

#include <cairn/cpp/fleet.hpp>
#include <cairn/cpp/world.hpp>

#endif
