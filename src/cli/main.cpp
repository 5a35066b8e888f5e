// SPDX-License-Identifier: BSD-3-Clause
// The program: runs recorded logs through the library and says how well it did.
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "cli/csv_output.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/runner.hpp"
#include "cli/summary.hpp"
#include "io/log.hpp"

namespace {

using namespace cairn;

constexpr int kSuccess = 0;
constexpr int kFailure = 1;  // the library refused something on the way
constexpr int kUsage = 2;    // a bad command line, or a bad file

constexpr const char* kHelp =
    "usage: cairn run LOG [options]\n"
    "       cairn --help | --version\n"
    "\n"
    "Runs a recorded log through the filter. LOG is a neutral text log or a STARS MATLAB v5 file.\n"
    "\n"
    "  --summary json          print the figures as one JSON object\n"
    "  --output DIR            write trajectory, landmarks, innovations and timing as CSV files\n"
    "  --quiet                 no progress and no notes on stderr\n"
    "  --single-map            keep one map (the only way of this version)\n"
    "  --error KIND            error of the state: invariant (default) or standard\n"
    "  --forget-after N        remove landmarks not observed for N frames; 0: never (default)\n"
    "  --gate P                chi-square gate of one observation, a probability; 1: none\n"
    "  --batch-gate P          chi-square gate of a whole frame, a probability; 1: none\n"
    "  --iterations N          linearisations of an update, 1 to 50\n"
    "  --max-landmarks N       capacity of the map (default: what the log needs)\n"
    "  --min-disparity PX      place a landmark only from at least this disparity (stereo camera)\n"
    "  --min-disparity-sigmas N  and of at least so many of its standard deviations; 0: no bound\n"
    "  --pixel-noise PX        noise of the stereo camera, instead of the file's or 2\n"
    "  --velocity-noise M_S    noise of the body velocity, instead of the file's or 0.1\n"
    "  --rate-noise RAD_S      noise of the body rate, instead of the file's or 0.01\n"
    "  --seed N                accepted; a log leaves nothing to chance\n"
    "\n"
    "Exit status: 0 success, 1 the library refused a step, 2 bad usage or a bad file.\n";

void write_stdout(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw cli::UsageError("can't write to stdout");
  }
}

int run(const std::vector<std::string>& arguments) {
  const cli::RunOptions options = cli::parse_run_options(arguments);
  if (options.help) {
    write_stdout(kHelp);
    return kSuccess;
  }
  const auto begin = std::chrono::steady_clock::now();
  const io::Log log = io::read_log(options.log, options.noise);
  if (!options.quiet) {
    for (const std::string& note : log.notes) std::fprintf(stderr, "cairn: note: %s\n", note.c_str());
  }
  std::optional<cli::CsvOutput> output;
  if (!options.output.empty()) output.emplace(log, options.output);

  cli::Runner runner(log, options);
  cli::Summary summary(log);
  {
    cli::Progress progress(log.steps.size(), options.quiet);
    runner.run([&](const cairn_filter* filter, const cli::StepResult& result) {
      const std::optional<cli::PoseScore> score = cli::score_pose(filter, log.steps[result.index], result.pose);
      summary.add(result, score);
      if (output) output->add(result, score);
      progress.show(result.index + 1);
    });
  }
  summary.finish(runner.filter(), std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  if (output) output->finish(runner.filter(), summary);
  write_stdout(options.json ? summary.json() : options.log + ": " + log.format + "\n" + summary.text());
  return kSuccess;
}

int dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw cli::UsageError("no command given (usage: cairn run LOG [options])");
  const std::string& command = arguments[0];
  if (command == "--help" || command == "-h") {
    write_stdout(kHelp);
    return kSuccess;
  }
  if (command == "--version") {
    write_stdout("cairn " + std::string(cairn_version()) + " (" + cairn_build() + ")\n");
    return kSuccess;
  }
  if (command == "run") return run({arguments.begin() + 1, arguments.end()});
  const char* kind = command[0] == '-' ? "option" : "command";
  throw cli::UsageError("unknown " + std::string(kind) + " '" + command + "' (see cairn --help)");
}

int fail(const char* message, int status) {
  std::fprintf(stderr, "cairn: %s\n", message);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return dispatch({argv + 1, argv + argc});
  } catch (const cli::UsageError& error) {
    return fail(error.what(), kUsage);
  } catch (const io::LogError& error) {
    return fail(error.what(), kUsage);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailure);
  }
}
