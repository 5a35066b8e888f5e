// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "cli/commands.hpp"
#include "cli/option_table.hpp"

namespace cairn::cli {

const char* const kHelp =
    "usage: cairn run LOG [options]\n"
    "       cairn simulate mars|usv [options]\n"
    "       cairn --help | --version\n"
    "\n"
    "run drives the filter through a recorded log: a neutral text log or a STARS MATLAB v5 file; or a team of robots\n"
    "through a MRCLAM folder.\n"
    "simulate drives it through a world: mars, a rover on rolling ground with a stereo head; or usv, boats with radar\n"
    "that cooperate.\n"
    "\n"
    "  --summary json          print the figures as one JSON object\n"
    "  --output DIR            write trajectory, landmarks, submaps, innovations and timing as CSV files\n"
    "  --quiet                 no progress and no notes on stderr\n"
    "  --seed N                of a simulated world; a log leaves nothing to chance\n"
    "\n"
    "The filter:\n"
    "  --single-map            keep one map, instead of submaps\n"
    "  --submap-landmarks N    close a submap once it holds N landmarks (default 60, in a log at\n"
    "                          least two of its largest frames); 0: --single-map\n"
    "  --submap-distance M     ... or once the vehicle has driven that far in it; 0: no matter (default)\n"
    "  --submap-extent M       ... or once a landmark stands that far from its origin; 0: no matter (default)\n"
    "  --submap-sigma M        ... or once the position in it is known no better; 0: no matter (default)\n"
    "  --join WAY              how submaps enter the map: auto (default), dense or sparse\n"
    "  --association HOW       whose landmark an observation is of: known (default) by the drive's ids; nearest or\n"
    "                          joint without them, which then only score the result\n"
    "  --error KIND            error of the state: invariant (default) or standard\n"
    "  --forget-after N        remove landmarks not observed for N frames; 0: never (default)\n"
    "  --gate P                chi-square gate of one observation, a probability; 1: none (default of simulate)\n"
    "  --batch-gate P          chi-square gate of a whole frame, a probability; 1: none (default of simulate)\n"
    "  --iterations N          linearisations of an update, 1 to 50\n"
    "  --max-landmarks N       capacity of the map (default: what the drive needs)\n"
    "\n"
    "run alone:\n"
    "  --min-disparity PX      place a landmark only from at least this disparity (stereo camera)\n"
    "  --min-disparity-sigmas N  and of at least so many of its standard deviations; 0: no bound\n"
    "  --pixel-noise PX        noise of the stereo camera, instead of the file's or 2\n"
    "  --velocity-noise M_S    noise of the body velocity, instead of the file's or 0.1\n"
    "  --rate-noise RAD_S      noise of the body rate, instead of the file's or 0.01\n"
    "\n"
    "simulate alone:\n"
    "  --compare               run standard EKF-SLAM and submaps, and print the Mars paper's Table 2 beside both\n"
    "  --runs N                that many worlds, by seeds from --seed on; prints means, and _std beside\n"
    "  --preset NAME           paper (default: Table 1 as printed), row1, row2, row3 or row4 (worlds to measure by)\n"
    "  --course NAME           circle (default), laps or traverse; --closed: a traverse that comes home\n"
    "  --landmarks N           default 200; laps and traverse get as long as they ask for\n"
    "  --speed M_S, --laps N, --radius M, --start-azimuth RAD, --round-length M\n"
    "  --terrain NAME          rolling (default; --max-slope RAD), waves or flat\n"
    "  --contact NAME          wheels (default: four of them) or point\n"
    "  --drive NAME            what moves the filter: twist (default), wheels-gyro or wheels\n"
    "  --accelerometer NAME    its noise is of the velocity (default) or of the acceleration\n"
    "  --stick NAME            its noise is per-observation (default) or per-frame\n"
    "  --velocity-noise, --rate-noise, --wheel-noise, --wheel-slip, --range-noise, --azimuth-noise, --stick-noise\n"
    "                          standard deviations, SI units, radians\n"
    "  --near-range M, --far-range M, --half-azimuth RAD, --pan-scan RAD, --stick-scan RAD\n"
    "                          field of view, and how far the head scans to both sides\n"
    "  --imu-period S, --motion-period S, --frame-period S\n"
    "\n"
    "Teams (usv, and a MRCLAM folder):\n"
    "  --mode MODE             mono, eo_diagonal, eo_full, joint (default) or submaps\n"
    "  --velocity-noise, --rate-noise, --range-noise, --bearing-noise\n"
    "                          usv: standard deviations, m/s, rad/s, m, rad; MRCLAM: of the odometry a square root of\n"
    "                          Hz, of the range in proportion to it, of the bearing rad\n"
    "usv alone:\n"
    "  --compare               all modes for 6, 10 and 40 features beside the cooperative paper's figures\n"
    "  --vehicles N, --features N, --layout uniform|coast, --separation M, --duration S, --period S, --far-range M,\n"
    "  --runs N\n"
    "\n"
    "Exit status: 0 success, 1 the library refused a step, 2 bad usage or a bad file.\n";

void write_stdout(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw UsageError("can't write to stdout");
  }
}

}  // namespace cairn::cli
