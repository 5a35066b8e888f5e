// SPDX-License-Identifier: BSD-3-Clause
#include "program/runners/session.hpp"

#include <chrono>
#include <optional>

#include "program/output/csv_output.hpp"
#include "program/output/summary.hpp"
#include "program/output/systematic_csv.hpp"
#include "program/output/tool_files.hpp"
#include "program/output/trajectories.hpp"
#include "program/runners/runner.hpp"

namespace cairn::program {

std::vector<Figure> run_drive(Drive& drive, const FilterChoices& choices, const Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  std::optional<CsvOutput> output;
  if (session.output.wanted()) output.emplace(drive, session.output.folder);
  std::optional<SystematicCsv> systematic;
  if (output) systematic.emplace(session.output.folder);
  Runner runner(drive, choices);
  Summary summary(drive, choices.names_known());
  Trajectories trajectories;
  runner.run([&](const cairn_filter* filter, const DriveStep& step, const StepResult& result) {
    const std::optional<PoseScore> score = score_pose(filter, step, result.pose);
    summary.add(step, result, score);
    trajectories.add(step.time, step.number, result.pose, step.truth);
    if (output) output->add(step, result, score);
    if (systematic) systematic->add(filter, step);
    session.on_step();
  });
  const std::optional<cairn_closing_report> last_closing = runner.finish();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  trajectories.finish(runner.filter());
  summary.finish(runner.filter(), last_closing, trajectories.corrected_rmse(),
                 session.seconds_before + seconds.count());
  if (output) {
    output->finish(runner.filter(), last_closing, summary);
    write_tool_files(session.output, "", map_landmarks(runner.filter()), trajectories);
    systematic->finish();
  }
  return summary.figures();
}

}  // namespace cairn::program
