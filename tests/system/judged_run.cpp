// SPDX-License-Identifier: Apache-2.0
#include "tests/system/judged_run.h"

#include <array>
#include <cstdio>
#include <map>

#include "deploy/boat/configuration.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/boat/voyage.h"
#include "deploy/operator/run/lockstep_run.h"
#include "tests/system/escape.h"

namespace lodesman::testing {
namespace {

constexpr double kSurvive_s = 10.0;  // beyond the collision

// Looks on at the blackboard, plan by plan.
class Witness {
 public:
  void look(const Blackboard& board) {
    if (!truth_) {
      truth_.emplace(board.world_truth);
      tracks_.emplace(board.tracks);
    }
    while (const auto* truth = truth_->next()) {
      now_ = truth->value;
      if (!hit_ && now_.hull_clearance_m < 0.0) {
        hit_ = now_;
      }
    }
    while (const auto* tracks = tracks_->next()) {
      for (std::uint32_t i = 0; i < tracks->value.count; ++i) {
        first_seen_.try_emplace(tracks->value.tracks[i].id, now_);
      }
    }
  }

  [[nodiscard]] const WorldTruth& now() const { return now_; }
  [[nodiscard]] const std::optional<WorldTruth>& hit() const { return hit_; }
  [[nodiscard]] std::optional<WorldTruth> first_seen(std::uint32_t track) const {
    const auto found = first_seen_.find(track);
    return found == first_seen_.end() ? std::nullopt : std::optional{found->second};
  }

 private:
  std::optional<Reader<WorldTruth>> truth_;
  std::optional<Reader<Tracks>> tracks_;
  WorldTruth now_;
  std::optional<WorldTruth> hit_;
  std::map<std::uint32_t, WorldTruth> first_seen_;
};

[[nodiscard]] VesselState state_of(const WorldTruth& truth) {
  return {{{{truth.x_m, truth.y_m}}, Heading::clockwise_from_y_rad(truth.heading_rad)},
          truth.surge_m_s,
          truth.sway_m_s,
          truth.yaw_rate_rad_s};
}

[[nodiscard]] Collision judge(const Scenario& scenario, const Witness& witness) {
  const Waters waters{
      load_hull("paper-asv"), {0.0, 0.0, scenario.environment.lift}, scenario.obstacles};
  // One in the last tenth of a second, after the last plan, is judged by the last truth seen.
  const WorldTruth hit = witness.hit().value_or(witness.now());
  Collision collision;
  collision.time_s = hit.scenario_time_s;
  collision.obstacle = nearest_obstacle(waters, state_of(hit).pose, hit.scenario_time_s).obstacle;
  // What is seen only after it was hit came from out of sight.
  const auto seen = witness.first_seen(collision.obstacle);
  if (seen && seen->scenario_time_s < hit.scenario_time_s) {
    collision.first_seen_s = seen->scenario_time_s;
    collision.avoidable = find_escape(waters, state_of(*seen), seen->scenario_time_s,
                                      hit.scenario_time_s + kSurvive_s)
                              .has_value();
  }
  return collision;
}

template <class... Values>
[[nodiscard]] std::string format(const char* pattern, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

[[nodiscard]] std::string story_of(const JudgedRun& run) {
  const cli::RunResult& result = run.result;
  if (!run.collision) {
    return format("%s after %.1f s, %.1f m from the goal, at last %s", result.outcome.c_str(),
                  result.time_s, result.goal_error_m, run.last_rung.c_str());
  }
  const Collision& hit = *run.collision;
  return format("collision at %.1f s with obstacle %u, %s, %.2f m deep, could %sbe avoided",
                hit.time_s, hit.obstacle,
                hit.first_seen_s ? format("first seen at %.1f s", *hit.first_seen_s).c_str()
                                 : "not seen before",
                -result.min_hull_clearance_m.value_or(0.0), hit.avoidable ? "" : "not ");
}

[[nodiscard]] std::string replay(const std::string& scenario_name,
                                 const std::vector<std::string>& sets,
                                 std::optional<std::uint64_t> seed) {
  std::string command = "lodesman sim " + scenario_name + " --lockstep";
  if (seed) {
    command += " --seed " + std::to_string(*seed);
  }
  for (const std::string& set : sets) {
    command += " --set " + set;
  }
  return command;
}

}  // namespace

JudgedRun judged_run(const std::string& scenario_name, const std::vector<std::string>& sets,
                     std::optional<std::uint64_t> seed) {
  CommonOptions options;
  options.sets = sets;
  const BoatConfig configuration = load_configuration("default", options);
  Scenario scenario = load_named_scenario(scenario_name, configuration.speeds);
  scenario.seed = seed.value_or(scenario.seed);
  Witness witness;
  const std::function<bool()> never = [] { return false; };
  const std::function<void(const cli::RunProgress&)> silent = [](const cli::RunProgress&) {};
  const cli::RunRecord record = cli::run_lockstep(
      {configuration, scenario, never, silent,
       [&](const Blackboard& board, const Plan& /*plan*/, const SonarPath* /*path*/,
           const cli::PlanRecord& /*record*/) { witness.look(board); }});
  JudgedRun run;
  run.result = record.result;
  run.last_rung = record.plans.empty() ? "without a plan" : record.plans.back().rung;
  run.waiting = record.result.outcome == "held";
  if (record.result.collided) {
    run.collision = judge(scenario, witness);
  }
  run.story =
      scenario_name + ": " + story_of(run) + "; again: " + replay(scenario_name, sets, seed);
  return run;
}

void Outcomes::add(const JudgedRun& run) {
  ++runs;
  if (run.collision) {
    ++(run.collision->avoidable ? avoidable : unavoidable);
  } else if (run.result.outcome == "goal") {
    ++reached;
    return;
  } else {
    ++(run.waiting ? waiting : adrift);
  }
  notable += "\n  " + run.story;
}

std::string Outcomes::table() const {
  return format(
             "%d runs: %d reached, %d held with a reason, %d neither; collisions: %d that "
             "could be avoided, %d that could not",
             runs, reached, waiting, adrift, avoidable, unavoidable) +
         notable;
}

}  // namespace lodesman::testing
