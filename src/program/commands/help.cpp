// SPDX-License-Identifier: BSD-3-Clause
// The help texts and the version of the program.
#include <cstdio>

#include "program/commands/commands.hpp"
#include "program/options/catalogue.hpp"
#include "program/options/option_text.hpp"
#include "program/usage_error.hpp"

namespace cairn::program {
namespace {

constexpr const char* kUsage =
    "usage: cairn run LOG [options]\n"
    "       cairn simulate mars|usv [options]\n"
    "       cairn --help | --version\n"
    "\n"
    "cairn run drives the filter through a recorded log: a neutral text log, in space or in the plane, a text log of\n"
    "iSAM, or a STARS MATLAB v5 file. With a MRCLAM folder it drives a team of robots.\n"
    "cairn simulate drives the filter through a simulated world. mars: a rover on rolling ground with a stereo head.\n"
    "usv: boats with radar that cooperate.\n";

constexpr const char* kStatus =
    "Exit status: 0 success, 1 the library refused a step, 2 bad usage or a bad file.\n"
    "The manual page, cairn(1), says more about each option, the formats of logs and the figures.\n";

}  // namespace

void write_help() {
  std::string text = kUsage;
  const Catalogue catalogue;
  for (const OptionGroup& group : catalogue.groups()) text += "\n" + help_text(group);
  write_stdout(text + "\n" + kStatus);
}

void write_manual_options() {
  std::string text;
  const Catalogue catalogue;
  for (const OptionGroup& group : catalogue.groups())
    text += ".\\\" options: " + group.key + "\n" + manual_text(group) + ".\\\" end of options\n";
  write_stdout(text);
}

void write_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "cairn: note: %s\n", note.c_str());
}

void write_stdout(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw UsageError("cannot write to stdout");
  }
}

}  // namespace cairn::program
