// SPDX-License-Identifier: BSD-3-Clause
// Stands in for stars_log.cpp in a build without libmatio.
#include "program/logs/log.hpp"

namespace cairn::program::logs {

Log read_stars_log(const std::string& path, const std::string&, const NoiseOverride&) {
  throw LogError(path + ": a MATLAB file, which this build of cairn cannot read: it was configured with CAIRN_MATIO=OFF");
}

}  // namespace cairn::program::logs
