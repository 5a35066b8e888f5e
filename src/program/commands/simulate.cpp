// SPDX-License-Identifier: BSD-3-Clause
// cairn simulate: a world instead of a log, one run or several, one filter or two.
#include <chrono>
#include <optional>

#include "program/commands/commands.hpp"
#include "program/drives/world_drive.hpp"
#include "program/options/catalogue.hpp"
#include "program/output/compare_table.hpp"
#include "program/output/csv_output.hpp"
#include "program/output/progress.hpp"
#include "program/runners/session.hpp"

namespace cairn::program {
namespace {

// One way to run the filter, and its figures in each run.
struct Way {
  std::string name;  // of its folder; empty: the only one
  FilterChoices filter;
  std::vector<std::vector<Figure>> runs;
};

// The two filters of the paper: standard EKF-SLAM with one linearisation of an update, and the filter with submaps.
std::vector<Way> ways_of(const SimulateOptions& options) {
  if (!options.compare) return {{"", options.filter, {}}};
  FilterChoices standard = options.filter;
  standard.submap_landmarks = 0;
  standard.state_error = CAIRN_STATE_ERROR_STANDARD;
  standard.iterations = options.filter.iterations.value_or(1);
  return {{"standard", standard, {}}, {"submaps", options.filter, {}}};
}

std::vector<Figure> run_world(const SimulateOptions& options, const Way& way, std::uint32_t run,
                              std::optional<Progress>& progress, std::size_t ways) {
  const auto begin = std::chrono::steady_clock::now();
  cairn_world_options world = options.world;
  world.seed = options.common.seed + run;
  WorldDrive drive(world, options.by_wheels, options.filter.systematic.scales_wheels());
  if (!progress) progress.emplace(drive.steps() * options.runs * ways, options.common.quiet);
  Session session;
  // Files are written for the first run only: the others are like it.
  if (run == 0 && options.common.output.wanted()) {
    session.output = options.common.output;
    if (!way.name.empty()) session.output.folder += "/" + way.name;
  }
  session.seconds_before = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  session.on_step = [&] { progress->advance(); };
  return run_drive(drive, way.filter, session);
}

std::vector<Figure> figures_of(const Way& way) {
  return way.runs.size() == 1 ? way.runs.front() : means(way.runs);
}

std::string compared_json(const std::vector<Way>& ways) {
  std::string out = "{";
  for (const Way& way : ways) {
    out += (out.size() > 1 ? ", \"" : "\"") + way.name + "\": " + json(figures_of(way));
  }
  return out + "}\n";
}

}  // namespace

void simulate_command(const std::vector<std::string>& arguments) {
  if (asks_for_usv(arguments)) return simulate_team_command(arguments);
  const SimulateOptions options = parse_simulate_options(arguments);
  if (options.common.help) return write_help();
  std::vector<Way> ways = ways_of(options);
  if (options.compare && options.common.output.wanted()) create_folder(options.common.output.folder);
  {
    std::optional<Progress> progress;
    for (std::uint32_t run = 0; run < options.runs; ++run) {
      for (Way& way : ways) way.runs.push_back(run_world(options, way, run, progress, ways.size()));
    }
  }
  if (!options.compare) {
    const std::vector<Figure> figures = figures_of(ways[0]);
    return write_stdout(options.common.json ? json(figures) + "\n" : "mars\n" + text(figures));
  }
  if (options.common.output.wanted()) {
    OutputFile file(options.common.output.folder, "summary.json");
    file.text(compared_json(ways));
    file.close();
  }
  write_stdout(options.common.json ? compared_json(ways) : compare_table(figures_of(ways[0]), figures_of(ways[1])));
}

}  // namespace cairn::program
