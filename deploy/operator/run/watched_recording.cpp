// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/watched_recording.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "deploy/boat/named_scenario.h"
#include "deploy/operator/run/estimated_truth.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/recording/board_player.h"
#include "mid_level/recording/recording.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

constexpr Duration kLookPeriod = std::chrono::milliseconds{20};  // as a run's own watcher looks
constexpr Duration kToldEvery = std::chrono::seconds{1};         // of the boat's time
constexpr double kRangeWithoutPings_m = 30.0;

// Calls visit(reader, item) for all that is in the files, until it returns false; a line for each
// that is not whole.
template <class Visit>
void read_all(const std::vector<fs::path>& files, BoardPlayer& player,
              std::vector<std::string>& lacks, Visit visit) {
  for (const fs::path& file : files) {
    McapFileSource source{file};
    McapReader reader{source};
    player.begin_file();
    for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
      if (!visit(reader, item)) {
        return;
      }
    }
    if (reader.ending() != McapEnding::kWhole) {
      lacks.push_back(file.string() + ": " + reader.reason());
    }
    if (reader.damaged() > 0) {
      lacks.push_back(file.string() + ": " + std::to_string(reader.damaged()) +
                      " records or chunks failed their checks");
    }
  }
}

[[nodiscard]] Time stamp_of(const McapMessage& message) noexcept {
  return Time{Duration{static_cast<Duration::rep>(message.publish_time_ns)}};
}

// What no clock shows: of a file that is damaged or forged.
[[nodiscard]] bool is_of_no_clock(const McapMessage& message) noexcept {
  constexpr std::uint64_t kLatest_ns = std::uint64_t{1} << 62U;
  return message.publish_time_ns > kLatest_ns;
}

[[nodiscard]] bool is_raw(const McapReader& reader) {
  const McapChannel* channel = reader.channel_by_id(reader.message().channel);
  return channel != nullptr && channel->message_encoding == kRawEncoding;
}

// Publications that the recording names as missing.
[[nodiscard]] std::uint64_t gap_count(const McapReader& reader) {
  const McapMessage& message = reader.message();
  const McapChannel* channel = reader.channel_by_id(message.channel);
  if (channel == nullptr || channel->topic != kGapsTopic) {
    return 0;
  }
  const auto* text = reinterpret_cast<const char*>(message.data.data());
  const auto json = nlohmann::json::parse(text, text + message.data.size(), nullptr, false);
  const auto count = json.is_object() ? json.find("count") : json.end();
  return count != json.end() && count->is_number_unsigned() ? count->get<std::uint64_t>() : 0;
}

// What a first look through a recording gathers.
class Survey {
 public:
  Survey() : board_{std::make_unique<Blackboard>()}, player_{*board_} {}

  void read(const std::vector<fs::path>& files) {
    read_all(files, player_, ignored_, [this](const McapReader& reader, McapItem item) {
      take(reader, item);
      return true;
    });
  }

  std::map<std::string, std::string> about;
  std::map<std::string, std::string> attachments;
  std::vector<RecordedBoat::Mission> missions;
  bool has_truth = false;
  double range_m = 0.0;  // of the last sonar frame

 private:
  void take(const McapReader& reader, McapItem item) {
    player_.take(reader, item);
    if (item == McapItem::kMetadata && reader.metadata().name == kAboutRecord) {
      about.insert(reader.metadata().values.begin(), reader.metadata().values.end());
    } else if (item == McapItem::kAttachment) {
      attachments.try_emplace(reader.attachment().name, reader.attachment().data);
    } else if (item == McapItem::kMessage) {
      look();
    }
  }

  void look() {
    has_truth = has_truth || truth_.latest() != nullptr;
    if (const auto* frame = frames_.latest(); frame != nullptr) {
      range_m = frame->value.range_m;
    }
    while (const auto* definition = definitions_.next()) {
      known_[definition->value.id] = definition->value;
    }
    while (const auto* status = status_.next()) {
      note(status->value);
    }
  }

  // A start that is given again after an end is a mission of its own, of the same definition.
  void note(const MissionStatus& status) {
    const bool had_ended =
        last_state_ == MissionState::kReached || last_state_ == MissionState::kAborted;
    last_state_ = status.state;
    const bool is_new = had_ended || missions.empty() ||
                        missions.back().begun.mission != status.mission ||
                        missions.back().begun.first_started != status.first_started;
    if (status.state != MissionState::kUnderWay || !is_new) {
      return;
    }
    RecordedBoat::Mission mission{{}, status};
    if (const auto found = known_.find(status.mission);
        found != known_.end() && found->second.goal_count > 0) {
      mission.definition = found->second;
    } else {  // of a recording that began later
      mission.definition.goal_count = 1;
      mission.definition.goals[0] = {status.goal_x_m, status.goal_y_m};
    }
    missions.push_back(mission);
  }

  std::unique_ptr<Blackboard> board_;
  BoardPlayer player_;
  Reader<WorldTruth> truth_{board_->world_truth};
  Reader<SonarObstacles> frames_{board_->sonar_obstacles};
  Reader<MissionDefinition> definitions_{board_->mission_definition};
  Reader<MissionStatus> status_{board_->mission_status};
  std::map<std::uint64_t, MissionDefinition> known_;
  MissionState last_state_ = MissionState::kIdle;
  std::vector<std::string> ignored_;
};

[[nodiscard]] std::string value_or(const std::map<std::string, std::string>& values,
                                   const char* key, const char* otherwise) {
  const auto found = values.find(key);
  return found == values.end() ? otherwise : found->second;
}

// The blackboard of a recording, and whoever looks on.
class Showing {
 public:
  Showing(const WatchedRecording& run, const Scenario& scenario)
      : run_{run}, board_{std::make_unique<Blackboard>()}, player_{*board_} {
    const auto& missions = run.boat.missions;
    const MissionStatus& begun = missions[run.mission].begun;
    // The first of a boat's life is shown from before it began, as whoever looked on then saw it.
    begins_ = begun.started == begun.first_started ? Time{} : begun.started;
    ends_ =
        run.mission + 1 < missions.size() ? missions[run.mission + 1].begun.started : Time::max();
    std::optional<Time> times_from;
    if (!run.boat.scenario) {
      times_from = begun.started;
    }
    if (!run.boat.has_truth) {
      estimated_.emplace(*board_, scenario.vehicle_radius_m, scenario.obstacles, times_from);
    }
    watcher_.emplace(*board_, estimated_ ? estimated_->board() : *board_, scenario,
                     run.boat.configuration.high.controller.waypoint_radius_m);
    watcher_->count_from(estimated_ ? CountedFrom::kEstimate : CountedFrom::kTruth);
    if (times_from) {
      watcher_->count_times_from(*times_from);
    }
    if (run.on_plan) {
      watcher_->on_plan = [this](const Plan& plan, const SonarPath* path,
                                 const PlanRecord& record) {
        run_.on_plan(*board_, plan, path, record);
      };
    }
    watcher_->on_row = run.on_row;
  }

  [[nodiscard]] std::vector<std::string> read() {
    std::vector<std::string> lacks;
    read_all(run_.files, player_, lacks,
             [this](const McapReader& reader, McapItem item) { return take(reader, item); });
    look();
    if (gaps_ > 0) {
      lacks.push_back(std::to_string(gaps_) + " publications were missed by the recorder");
    }
    if (const std::uint64_t insane = player_.insane() + of_no_clock_; insane > 0) {
      lacks.push_back(std::to_string(insane) + " publications are no sane values");
    }
    for (const std::string& topic : player_.left_out()) {
      lacks.push_back(topic + " is laid out by another build, and is left out");
    }
    return lacks;
  }

  [[nodiscard]] RunRecord finish() { return watcher_->finish(); }
  [[nodiscard]] std::vector<MovingObstacle> seen() const {
    return estimated_ ? estimated_->seen() : std::vector<MovingObstacle>{};
  }

 private:
  // False where no more is wanted.
  [[nodiscard]] bool take(const McapReader& reader, McapItem item) {
    if (item == McapItem::kMessage && !is_wanted(reader)) {
      return true;
    }
    if (item == McapItem::kMessage) {
      if (stamp_of(reader.message()) >= ends_) {
        return false;
      }
      go_on_to(stamp_of(reader.message()));
    }
    player_.take(reader, item);
    return !watcher_->mission_ended() && !run_.interrupted();
  }

  // What was before the mission is not, but where the world lies, which is told once.
  [[nodiscard]] bool is_wanted(const McapReader& reader) {
    const McapMessage& message = reader.message();
    gaps_ += gap_count(reader);
    of_no_clock_ += is_of_no_clock(message) ? 1U : 0U;
    return is_raw(reader) && !is_of_no_clock(message) &&
           (stamp_of(message) >= begins_ || reader.channel_by_id(message.channel)->topic ==
                                                std::string{kRawTopics} + "world_origin");
  }

  // What is published at one instant is looked at together, as by whoever looked on then.
  void go_on_to(Time stamp) {
    if (stamp <= now_) {
      return;
    }
    if (now_ >= next_look_) {
      next_look_ = now_ + kLookPeriod;
      look();
    }
    now_ = stamp;
  }

  void look() {
    if (estimated_) {
      estimated_->update();
    }
    watcher_->poll();
    if (run_.show && now_ >= next_show_) {
      next_show_ = now_ + kToldEvery;
      run_.show(watcher_->progress());
    }
  }

  const WatchedRecording& run_;
  Time begins_{};
  Time ends_{};
  std::unique_ptr<Blackboard> board_;
  BoardPlayer player_;
  std::optional<EstimatedTruth> estimated_;
  std::optional<RunWatcher> watcher_;
  std::uint64_t gaps_ = 0;
  std::uint64_t of_no_clock_ = 0;
  Time now_{};
  Time next_look_{};
  Time next_show_{};
};

}  // namespace

RecordedBoat recorded_boat(const std::vector<fs::path>& files) {
  const std::string& name = files.front().string();
  Survey survey;
  survey.read(files);
  const auto text = survey.attachments.find("config.toml");
  if (text == survey.attachments.end()) {
    throw StartupError(name + ": is no recording of a boat: it has no config.toml");
  }
  RecordedBoat boat{survey.about,
                    configuration_of(text->second, name + ": config.toml"),
                    {},
                    survey.has_truth,
                    survey.range_m > 0.0 ? survey.range_m : kRangeWithoutPings_m,
                    survey.missions};
  if (const auto scenario = survey.attachments.find("scenario.toml");
      scenario != survey.attachments.end()) {
    boat.scenario =
        read_scenario(TomlDocument::from_text(scenario->second, name + ": scenario.toml"),
                      boat.configuration.speeds);
  }
  return boat;
}

Scenario scenario_of(const RecordedBoat& boat, std::size_t mission) {
  const RecordedBoat::Mission& sailed = boat.missions[mission];
  Scenario scenario;
  if (boat.scenario) {
    scenario = *boat.scenario;
  } else {
    const BoatConfig& config = boat.configuration;
    scenario.name = config.name;
    scenario.mission.start.p_WV = {{sailed.begun.home_x_m, sailed.begun.home_y_m}};
    scenario.speed_m_s = sailed.begun.speed_m_s;
    scenario.vehicle_radius_m =
        config.document.root().table("zones").number("hull_radius_m", Range::between(0.0, 10.0));
    scenario.sonar.range_m = boat.sonar_range_m;
  }
  if (!boat.scenario || mission > 0) {
    scenario.mission.definition = sailed.definition;
  }
  return scenario;
}

WatchedRun watch_recording(const WatchedRecording& run) {
  const HighLevelOptions& options = run.boat.configuration.high;
  Scenario scenario = with_planned_zones(scenario_of(run.boat, run.mission), options);
  Showing showing{run, scenario};
  WatchedRun shown;
  shown.lacks = showing.read();
  shown.record = showing.finish();
  if (scenario.obstacles.empty()) {
    scenario.obstacles = showing.seen();
    shown.record.obstacles = with_planned_zones(scenario, options).obstacles;
  }
  RunResult& result = shown.record.result;
  result.scenario = scenario.name;
  result.seed = static_cast<std::int64_t>(scenario.seed);
  result.profile = value_or(run.boat.about, "profile", "");
  result.mode = value_or(run.boat.about, "mode", "realtime");
  result.version = value_or(run.boat.about, "version", "");
  return shown;
}

}  // namespace lodesman::cli
