// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/run_output.h"

#include <fmt/format.h>

#include <cstdio>

#include "deploy/boat/configuration.h"
#include "deploy/boat/voyage.h"
#include "deploy/operator/report/plots.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

[[nodiscard]] std::string metres_or_none(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f} m", *value) : "none";
}

}  // namespace

void print_summary(const RunRecord& record, const fs::path& directory, bool images) {
  const RunResult& r = record.result;
  if (!r.fault.empty()) {
    fmt::print(stderr, "fault: {}\n", r.fault);
  }
  fmt::print("{} ({}{}{}): {} after {:.1f} s, {:.2f} m from the goal\n", r.scenario, r.profile,
             r.profile.empty() ? "" : ", ", r.mode, r.outcome, r.time_s, r.goal_error_m);
  if (r.counted_from == CountedFrom::kEstimate) {
    fmt::print("counted by the boat's own estimate, of itself and of what it tracked\n");
  }
  fmt::print("smallest inoffensive distance {}, hull clearance {}\n",
             metres_or_none(r.min_inoffensive_distance_m), metres_or_none(r.min_hull_clearance_m));
  std::string reasons;
  for (const auto& [reason, count] : r.plan_reasons) {
    reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
  }
  fmt::print("{} plans ({})", r.plans, reasons);
  fmt::print("; side changed {} times", r.side_flips);
  if (r.first_side_flip_s) {
    fmt::print(", first at {:.1f} s", *r.first_side_flip_s);
  }
  if (r.truths_missed > 0 || r.plans_missed > 0) {
    fmt::print("\nheld up: {} states of the world and {} plans are not in the files",
               r.truths_missed, r.plans_missed);
  }
  fmt::print("\nrun directory: {}\n", directory.string());
  if (images) {
    for (const char* picture : {"world", "inoffensive_distance", "heading", "thrust"}) {
      if (const fs::path png = directory / (std::string{picture} + ".png"); fs::exists(png)) {
        fmt::print("  {}\n", png.string());
      }
    }
    fmt::print("  {}\n", (directory / "sonar").string());
  }
}

RunOutputOptions run_output_options(const BoatConfig& config, const Scenario* world, bool quiet,
                                    bool images) {
  return {quiet,
          images,
          {config.simulation.sonar_view_period,
           config.high.planner.replanner.pilot ? ViewLook::kChart : ViewLook::kPaper,
           !voyage_of(config, world).known_scene, config.low.delta_t.mounting}};
}

RunOutput::RunOutput(const Scenario& scenario, const fs::path& directory,
                     const RunOutputOptions& options)
    : files_{directory}, line_{scenario, options.quiet} {
  if (options.images) {
    views_.emplace(directory, scenario.sonar.range_m, options.views);
  }
}

void RunOutput::show(const RunProgress& progress) {
  if (progress.notice && progress.notice->t_s > noticed_s_) {
    noticed_s_ = progress.notice->t_s;
    line_.say(fmt::format("{:.1f} s: {}", noticed_s_, progress.notice->text));
  }
  line_.show(progress);
}

void RunOutput::add(const TrajectoryRow& row) {
  files_.add(row);
  note(files_.fault());
}

void RunOutput::add(const Blackboard& board, const Plan& plan, const SonarPath* path,
                    const PlanRecord& record) {
  files_.add(record);
  note(files_.fault());
  if (views_) {
    views_->save(board, plan, path, record);
    note(views_->fault());
  }
  if (const std::string news = story_.news(record); !news.empty()) {
    line_.say(news);
  }
}

void RunOutput::finish(const fs::path& directory, const RunRecord& record) {
  files_.finish(record.result);
  note(files_.fault());
  if (!views_) {
    return;
  }
  try {
    draw_pictures(directory, record, share_directory() / "deploy" / "pictures");
  } catch (const StartupError& error) {
    note(error.what());
  }
}

void RunOutput::note(const std::string& fault) {
  if (!fault.empty() && !lost_) {
    lost_ = true;
    line_.warn(fault);
  }
}

}  // namespace lodesman::cli
