// SPDX-License-Identifier: Apache-2.0
// Looks on at a blackboard and tells how each channel and task is doing. One thread; it writes
// nothing there, and is handed the time.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/watch/chain_watch.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman::cli {

struct ChannelRow {
  const char* name = "";
  Role writer = Role::kNobody;
  const char* writer_task = "";
  std::optional<double> rate_hz;   // over the last seconds; nothing until there were two looks
  std::optional<double> age_s;     // of the newest value; nothing where there was none
  double max_age_s = 0.0;          // 0: no limit
  bool stale = false;              // its readers act as if its writer were dead
  std::uint64_t publications = 0;  // since the segment was made
  std::uint64_t missed = 0;        // overwritten before they were looked at
  std::uint64_t refused = 0;       // passed over because they were not sane
};

struct TaskRow {
  const char* name = "";
  Role process = Role::kNobody;
  double period_s = 0.0;
  std::optional<TaskHealth> health;  // nothing where it has not run
  std::optional<double> age_s;       // of its health, which is told once a second
  bool silent = false;               // it has run, and tells nothing any more
};

struct DeviceRow {
  DeviceId device = DeviceId::kHeading;
  std::optional<DeviceHealth> health;  // nothing where its task has not told of it
  double for_s = 0.0;                  // it has had that status
  bool wrong = false;                  // not working, though the boat has it
};

struct BoardState {
  std::vector<ChannelRow> channels;
  std::vector<DeviceRow> devices;
  std::vector<TaskRow> tasks;
  std::optional<PingToThrust> chain;  // nothing where no plan was followed yet
};

class BoardWatch {
 public:
  // How far back a rate looks.
  static constexpr Duration kRateWindow = std::chrono::seconds{3};
  // A ring of four pings at 25 Hz lasts 160 ms: so often poll() must be called to miss none.
  static constexpr Duration kPollPeriod = std::chrono::milliseconds{50};

  // `board` must outlive it. Publications from before are not looked at, only counted.
  explicit BoardWatch(const Blackboard& board);

  void poll(Time now);
  // As of the last poll.
  [[nodiscard]] BoardState state() const;

 private:
  struct Look {
    Time at{};
    std::uint64_t sequence = 0;
  };
  // What has been seen of a channel; `drain` takes in what is new, whatever its type.
  struct ChannelSeen {
    ChannelInfo info;
    std::function<void(ChannelSeen&)> drain;
    std::uint64_t sequence = 0;
    Time stamp{};
    std::uint64_t missed = 0;
    std::uint64_t refused = 0;
    std::deque<Look> looks;
  };
  struct TaskSeen {
    ChannelInfo info;
    Reader<TaskHealth> reader;
    std::optional<Stamped<TaskHealth>> newest;
  };

  [[nodiscard]] ChannelRow row_of(const ChannelSeen& seen) const;
  [[nodiscard]] DeviceRow row_of(const std::optional<Stamped<DeviceHealth>>& newest,
                                 std::size_t device) const;
  [[nodiscard]] TaskRow row_of(const TaskSeen& seen, std::size_t task) const;

  std::vector<ChannelSeen> channels_;
  std::vector<Reader<DeviceHealth>> device_readers_;
  std::vector<std::optional<Stamped<DeviceHealth>>> devices_;
  std::vector<TaskSeen> tasks_;
  ChainWatch chain_;
  Time now_{};
};

// Who holds the segment, beside what is in it.
struct SegmentState {
  std::string segment;
  bool low_alive = false;
  bool high_alive = false;
  BoardState board;
};

// Lines no wider than 80 columns, '!' where something is not as it should be; with `colour` such
// lines are red as well. No line end after the last.
[[nodiscard]] std::vector<std::string> table_lines(const SegmentState& state, bool colour);
[[nodiscard]] nlohmann::ordered_json to_json(const SegmentState& state);

}  // namespace lodesman::cli
