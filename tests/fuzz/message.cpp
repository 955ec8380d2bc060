// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "deploy/boat/configuration.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/boat/voyage.h"
#include "high_level/tasks/high_level.h"
#include "low_level/tasks/path_finder.h"
#include "low_level/tasks/thruster.h"
#include "mid_level/recording/recording_hash.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"
#include "tests/support/forgery.h"

namespace lodesman::fuzz {
namespace {

constexpr Time kNow{std::chrono::seconds{100}};

// A box that must never be handed what it did not ask for: it asks for nothing.
class AnyThrusters final : public ThrusterPair {
 public:
  [[nodiscard]] CommandStatus command(ThrustCommand /*command*/, Time /*now*/) noexcept override {
    return CommandStatus::kTaken;
  }
};

// Puts a value in the ring as its first publication, whoever its writer is.
template <class T, std::size_t kDepth>
void lay(Channel<T, kDepth>& channel, const T& value) {
  auto& slot = channel.slots[1 % kDepth];
  testing::put_words(slot, value);
  slot.stamp_ns = kNow.time_since_epoch().count();
  slot.bytes = used_bytes(value);
  slot.version = 2;
  channel.head.newest = 1;
}

// A boat under way past one stone.
void lay_good_values(Blackboard& board) {
  VehicleState state;
  state.valid_at = kNow;
  lay(board.vehicle_state, state);
  Attitude attitude;
  attitude.measured = kNow;
  lay(board.attitude, attitude);
  const auto tracks = std::make_unique<Tracks>();
  tracks->frame = 1;
  tracks->captured = kNow;
  tracks->count = 1;
  tracks->tracks[0].id = 1;
  tracks->tracks[0].last_seen = kNow;
  tracks->tracks[0].shape.centre_y_m = 8.0;
  tracks->tracks[0].shape.semi_axis_first_m = 0.5;
  tracks->tracks[0].shape.semi_axis_second_m = 0.5;
  lay(board.tracks, *tracks);
  const auto seen = std::make_unique<SonarObstacles>();
  seen->frame = 1;
  seen->captured = kNow;
  lay(board.sonar_obstacles, *seen);
}

// The input over the bytes of the value that stands in the channel, by exclusive or, and the first
// eight of it over the number of bytes and the stamp.
template <class T, std::size_t kDepth>
void overlay(Channel<T, kDepth>& channel, std::string_view input) {
  auto& slot = channel.slots[1 % kDepth];
  const auto value = std::make_unique<T>();
  if (channel.head.newest == 0) {
    lay(channel, *value);
  }
  std::uint64_t changes = 0;
  std::memcpy(&changes, input.data(), std::min(input.size(), sizeof changes));
  input.remove_prefix(std::min(input.size(), sizeof changes));
  testing::get_words(slot, *value);
  auto* bytes = reinterpret_cast<unsigned char*>(value.get());
  for (std::size_t i = 0; i < std::min(input.size(), sizeof(T)); ++i) {
    bytes[i] = static_cast<unsigned char>(bytes[i] ^ static_cast<unsigned char>(input[i]));
  }
  testing::put_words(slot, *value);
  const bool whole = (changes & 1) == 0;
  slot.bytes = whole && sane(*value) ? used_bytes(*value) : slot.bytes ^ (changes >> 32);
  slot.stamp_ns = slot.stamp_ns ^ static_cast<std::int64_t>(changes >> 1 << 33);
}

[[nodiscard]] const HighLevelOptions& high_options(bool in_world) {
  static const auto make = [](const char* profile) {
    const BoatConfig config = load_configuration(profile, {});
    const Scenario scenario = load_named_scenario("paper-moving", config.speeds);
    return high_level_options(config, voyage_of(config, &scenario));
  };
  static const HighLevelOptions kWorld = make("default");
  static const HighLevelOptions kView = make("paper");
  return in_world ? kWorld : kView;
}

}  // namespace

void message(std::string_view input) {
  const std::size_t chosen = input.empty() ? 0 : static_cast<unsigned char>(input[0]);
  input.remove_prefix(std::min<std::size_t>(input.size(), 1));
  const auto board = std::make_unique<Blackboard>();
  AnyThrusters box;
  HighLevel high{*board, Role::kHigh, high_options(chosen % 2 == 0)};
  PathFinderTask path_finder{*board, Role::kLow};
  ThrusterTask thruster{*board, Role::kLow, &box};
  RecordingHash onlooker{*board};
  lay_good_values(*board);
  const std::size_t channel_count = testing::channels_of(*board);
  std::size_t index = 0;
  for_each_channel(*board, [&](const ChannelInfo& /*info*/, auto& channel) {
    if (index++ == chosen / 2 % channel_count) {
      overlay(channel, input);
    }
  });
  for (int step = 0; step < 3; ++step) {
    const Time now = kNow + step * std::chrono::milliseconds{60};
    for (const TaskEntry& entry : high.tasks()) {
      entry.task->step(now);
    }
    path_finder.step(now);
    thruster.step(now);
    onlooker.update();
  }
  Reader<HelmCommand> helm{board->helm_command};
  const auto* last = helm.latest();
  require(last == nullptr || std::abs(last->value.surge_ref) <= 100, "the helm is out of range");
}

}  // namespace lodesman::fuzz
