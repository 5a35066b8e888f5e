// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cairn in C++17: classes that own the handles of C, exceptions, and arrays of any container. Link libcairn.
#ifndef CAIRN_CAIRN_HPP
#define CAIRN_CAIRN_HPP

#include <cairn/cpp/array.hpp>
#include <cairn/cpp/callback.hpp>
#include <cairn/cpp/error.hpp>
#include <cairn/cpp/filter.hpp>
#include <cairn/cpp/map.hpp>
#include <cairn/cpp/pose.hpp>
#include <cairn/cpp/team.hpp>
#include <cairn/cpp/types.hpp>

#endif
