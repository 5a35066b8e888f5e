// SPDX-License-Identifier: BSD-3-Clause
// Teams: cairn simulate usv, and cairn run of a MRCLAM folder.
#include <chrono>
#include <cstdio>

#include "program/commands/commands.hpp"
#include "program/commands/usv_compare.hpp"
#include "program/drives/fleet_drive.hpp"
#include "program/drives/turn_gain.hpp"
#include "program/options/team_options.hpp"
#include "program/output/progress.hpp"
#include "program/output/scene_output.hpp"
#include "program/output/team_output.hpp"

namespace cairn::program {
namespace {

using Clock = std::chrono::steady_clock;

// Runs the team in its mode and, if `beside` is given, each vehicle without the others. The run has begun at `begin`.
std::vector<Figure> run_team(TeamDrive& drive, TeamDrive* beside, const TeamChoices& choices, const OutputPlace& place,
                             Progress& progress, Clock::time_point begin) {
  std::optional<TeamOutput> output;
  if (place.wanted()) output.emplace(drive, choices.mode, place);
  TeamRunner runner(drive, choices);
  const TeamResult result = runner.run([&](const TeamStep& step, const std::vector<VehicleEstimate>& estimates) {
    if (output) output->add(step, estimates);
    progress.advance();
  });
  std::optional<TeamResult> alone;
  if (beside != nullptr) {
    TeamChoices mono = choices;
    mono.mode = CAIRN_TEAM_MONO;
    const bool noted = output && choices.mode != CAIRN_TEAM_MONO;  // else the steps are the same
    if (noted) output->begin_alone();
    alone = TeamRunner(*beside, mono).run([&](const TeamStep& step, const std::vector<VehicleEstimate>& estimates) {
      if (noted) output->add_alone(step, estimates);
      progress.advance();
    });
  }
  const std::chrono::duration<double> seconds = Clock::now() - begin;
  const std::vector<Figure> figures = team_figures(drive, result, alone ? &*alone : nullptr, seconds.count());
  if (output) output->finish(runner, figures);
  return figures;
}

std::string title(const std::string& what, const TeamChoices& choices) {
  return what + ", mode " + kModeNames[static_cast<std::size_t>(choices.mode)] + "\n";
}

}  // namespace

void simulate_team_command(const std::vector<std::string>& arguments) {
  const UsvOptions options = parse_usv_options(arguments);
  if (options.common.help) return write_help();
  if (options.compare) {
    const OutputPlace& place = options.common.output;
    if (place.wanted()) create_folder(place.folder);
    std::string table, object, rows;
    StepTable steps;
    {
      Progress progress(compared_runs(options), options.common.quiet);
      compare_modes(
          options, [&] { progress.advance(); }, table, object, rows, steps);
    }
    if (place.wanted()) {
      steps.write(place.folder);
      write_scene(compared_scene(options), place.folder);
      OutputFile file(place.folder, "team_compare.csv");
      file.text(rows);
      file.close();
      OutputFile summary(place.folder, "summary.json");
      summary.text(object + "\n");
      summary.close();
    }
    return write_stdout(options.common.json ? object + "\n" : table);
  }
  std::vector<std::vector<Figure>> runs;
  std::optional<Progress> progress;
  for (std::uint32_t run = 0; run < options.runs; ++run) {
    const auto begin = Clock::now();
    cairn_fleet_options fleet = options.fleet;
    fleet.seed = options.common.seed + run;
    FleetDrive drive(fleet), beside(fleet);
    if (!progress) progress.emplace(2 * drive.steps() * options.runs, options.common.quiet);
    const OutputPlace place = run == 0 ? options.common.output : OutputPlace{};
    runs.push_back(run_team(drive, &beside, options.team, place, *progress, begin));
    if (place.wanted()) write_scene(fleet, place.folder);
  }
  progress.reset();
  const std::vector<Figure> figures = runs.size() == 1 ? runs.front() : means(runs);
  write_stdout(options.common.json ? json(figures) + "\n" : title("usv", options.team) + text(figures));
}

void run_team_command(const std::vector<std::string>& arguments) {
  const MrclamOptions options = parse_mrclam_options(arguments);
  if (options.common.help) return write_help();
  const auto begin = Clock::now();
  logs::MrclamLog log = logs::read_mrclam(options.folder);
  if (options.turns == 0) correct_turns(log);
  MrclamDrive drive(log, options.noise);
  if (!options.common.quiet) {
    write_notes(log.notes);
    write_notes(drive.notes());
  }
  std::vector<Figure> figures;
  {
    Progress progress(drive.steps(), options.common.quiet);
    figures = run_team(drive, nullptr, options.team, options.common.output, progress, begin);
  }
  write_stdout(options.common.json ? json(figures) + "\n"
                                   : title(options.folder + ": " + log.format, options.team) + text(figures));
}

}  // namespace cairn::program
