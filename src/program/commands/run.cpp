// SPDX-License-Identifier: BSD-3-Clause
// cairn run: a recorded log.
#include <chrono>

#include "program/commands/commands.hpp"
#include "program/drives/log_drive.hpp"
#include "program/options/catalogue.hpp"
#include "program/output/progress.hpp"
#include "program/runners/session.hpp"

namespace cairn::program {

void run_command(const std::vector<std::string>& arguments) {
  if (!mrclam_folder(arguments).empty()) return run_team_command(arguments);
  const RunOptions options = parse_run_options(arguments);
  if (options.common.help) return write_help();
  const auto begin = std::chrono::steady_clock::now();
  const logs::Log log = logs::read_log(options.log, options.noise);
  check_log(options, log);
  if (!options.common.quiet) write_notes(log.notes);
  LogDrive drive(log, options.camera);
  std::vector<Figure> figures;
  {
    Progress progress(drive.steps(), options.common.quiet);
    Session session;
    session.output = options.common.output;
    session.seconds_before = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    session.on_step = [&] { progress.advance(); };
    figures = run_drive(drive, options.filter, session);
  }
  write_stdout(options.common.json ? json(figures) + "\n" : options.log + ": " + log.format + "\n" + text(figures));
}

}  // namespace cairn::program
