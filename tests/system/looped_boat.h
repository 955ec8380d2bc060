// SPDX-License-Identifier: Apache-2.0
// Both levels in lock-step with a world of their own, whose mission begins when the test says so
// and not when the devices are ready; and what was published meanwhile, field by field. One thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/voyage.h"
#include "deploy/operator/run/watcher.h"
#include "mid_level/runtime/run_lockstep.h"
#include "tests/support/catch.h"

namespace lodesman::testing {

struct PublishedField {
  const char* name = nullptr;
  std::vector<std::uint8_t> bytes;
};

struct Publication {
  Time stamp{};
  std::vector<PublishedField> fields;
};

// Keeps what a channel publishes, but for wall times that were measured.
template <class T>
class ChannelBook {
 public:
  template <std::size_t kDepth>
  explicit ChannelBook(const Channel<T, kDepth>& channel) : reader_{channel} {}

  void update() {
    while (const auto* published = reader_.next()) {
      Sink sink;
      visit_message(sink, published->value);
      publications_.push_back({published->stamp, std::move(sink.fields)});
    }
  }
  [[nodiscard]] const std::vector<Publication>& publications() const noexcept {
    return publications_;
  }

 private:
  struct Sink {
    static constexpr bool kSkipMeasured = true;
    std::vector<PublishedField> fields;

    template <class V>
    void operator()(const char* name, const V& value) {
      std::vector<std::uint8_t> bytes(sizeof value);
      std::memcpy(bytes.data(), &value, sizeof value);
      fields.push_back({name, std::move(bytes)});
    }
    void operator()(const char* name, const std::uint8_t* data, std::size_t count) {
      fields.push_back({name, {data, data + count}});
    }
  };

  Reader<T> reader_;
  std::vector<Publication> publications_;
};

// Where two books part, in words; empty where they are the same.
[[nodiscard]] inline std::string where_they_part(const std::vector<Publication>& one,
                                                 const std::vector<Publication>& other) {
  const auto at_s = [](const Publication& p) { return to_seconds(p.stamp - Time{}); };
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
    const std::string where =
        "publication " + std::to_string(i) + ", " + std::to_string(at_s(one[i])) + " s: ";
    if (one[i].stamp != other[i].stamp) {
      return where + "the other's stamp is " + std::to_string(at_s(other[i])) + " s";
    }
    if (one[i].fields.size() != other[i].fields.size()) {
      return where + "so many fields";
    }
    for (std::size_t k = 0; k < one[i].fields.size(); ++k) {
      if (one[i].fields[k].bytes != other[i].fields[k].bytes) {
        return where + one[i].fields[k].name;
      }
    }
  }
  return one.size() == other.size()
             ? ""
             : std::to_string(one.size()) + " and " + std::to_string(other.size());
}

class LoopedBoat {
 public:
  LoopedBoat(const std::string& profile, const std::string& scenario,
             const std::vector<std::string>& sets)
      : configuration_{configuration_of(profile, sets)},
        scenario_{load_named_scenario(scenario, configuration_.speeds)},
        high_options_{high_level_options(configuration_, voyage_of(configuration_, &scenario_))},
        boat_{*board_, configuration_, &scenario_},
        high_{*board_, Role::kHigh, high_options_},
        desk_{*board_, Role::kHigh,
              desk_options(configuration_, voyage_of(configuration_, &scenario_)),
              [this] { return clock_.now(); }},
        watcher_{*board_, with_planned_zones(scenario_, high_options_),
                 high_options_.controller.waypoint_radius_m} {
    std::vector<TaskEntry> entries = boat_.tasks();
    for (const TaskEntry& entry : high_.tasks()) {
      entries.push_back(entry);
    }
    clock_.advance_to(Time{std::chrono::seconds{1}});
    runner_ = std::make_unique<LockstepRunner>(
        entries, clock_, *board_,
        LockstepOptions{configuration_.simulation.lockstep_jitter, scenario_.seed});
  }

  // To the end of the mission, which begins at that time; `look` is called after each step of a
  // task. The start must be taken at once.
  template <class Look>
  cli::RunRecord sail(Time start, Look look) {
    const Time end = start + from_seconds(scenario_.time_limit_s);
    Answer answer;
    bool is_answered = false;
    while (!watcher_.mission_ended() && clock_.now() < end) {
      runner_->step();
      look();
      if (clock_.now() >= start && !is_answered) {
        if (!answer) {
          CommandRequest request;
          request.command = "start";
          request.scope = Scope::kCommand;
          request.session = 1;
          answer = desk_.answer(request);
        }
        if (const auto reply = answer()) {
          INFO(*reply);
          REQUIRE(reply->find("\"ok\":true") != std::string::npos);
          is_answered = true;
        }
      }
      if (clock_.now() >= next_look_) {
        next_look_ = clock_.now() + std::chrono::milliseconds{20};
        watcher_.poll();
      }
    }
    REQUIRE(is_answered);
    return watcher_.finish();
  }

  [[nodiscard]] const Blackboard& board() const noexcept { return *board_; }

 private:
  [[nodiscard]] static BoatConfig configuration_of(const std::string& profile,
                                                   const std::vector<std::string>& sets) {
    CommonOptions options;
    options.sets = sets;
    return load_configuration(profile, options);
  }

  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  BoatConfig configuration_;
  Scenario scenario_;
  HighLevelOptions high_options_;
  SimClock clock_;
  AssembledBoat boat_;
  HighLevel high_;
  OperatorDesk desk_;
  cli::RunWatcher watcher_;
  Time next_look_{};
  std::unique_ptr<LockstepRunner> runner_;
};

}  // namespace lodesman::testing
