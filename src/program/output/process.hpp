// SPDX-License-Identifier: BSD-3-Clause
// What the program asks the operating system beyond the C++ library.
#pragma once

namespace cairn::program {

// Whether a person reads the error stream: then a bar of progress may be drawn and erased.
bool stderr_is_terminal();

// The most memory that this process has had resident, in MiB.
double peak_rss_mib();

}  // namespace cairn::program
