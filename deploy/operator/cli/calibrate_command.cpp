// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/calibrate_command.h"

#include <fmt/format.h>

#include <memory>
#include <thread>

#include "deploy/boat/configuration.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/calibrate/walk.h"
#include "deploy/operator/cli/boat_session.h"
#include "deploy/operator/cli/number_options.h"
#include "deploy/operator/watch/find_segment.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

constexpr Duration kWordPeriod = std::chrono::milliseconds{100};
constexpr Duration kSegmentPatience = std::chrono::milliseconds{200};
constexpr Duration kFirstFix = std::chrono::seconds{5};

struct CalibrateOptions : OperatorOptions {
  std::string segment;
  WalkOptions walk;
};

// The boat by its stick and its published channels. Armed by this where it was not, and then
// disarmed again, whatever happens meanwhile.
class WalkedBoat {
 public:
  WalkedBoat(const Boat& boat, const std::string& segment)
      : boat_{boat}, board_{SharedBlackboard::observe(segment, kSegmentPatience)} {}
  WalkedBoat(const WalkedBoat&) = delete;
  WalkedBoat& operator=(const WalkedBoat&) = delete;
  ~WalkedBoat() { leave(); }

  // Why it cannot be walked; nothing where it can.
  [[nodiscard]] std::string take() {
    if (!wait_for_sight(clock_.now() + kFirstFix)) {
      return "no heading, or no position fix: speeds over ground are measured by a receiver "
             "(devices.position)";
    }
    const auto status = ask({{"command", "status"}});
    const std::string mission = status.value("state", "");
    if (mission == "under_way" || mission == "holding") {
      return "a mission is under way";
    }
    const std::string state = status.value("/thrust/state"_json_pointer, "");
    if (state != "armed" && state != "manual") {
      std::string no = refusal(ask({{"command", "arm"}}));
      armed_ = no.empty();
      return no;
    }
    return {};
  }

  [[nodiscard]] std::optional<Sighting> steer(Stick stick) {
    if (stop_caught()) {
      why_ = "stopped";
      return std::nullopt;
    }
    const Time now = clock_.now();
    why_ =
        refusal(ask({{"command", "manual"}, {"surge", stick.surge_ref}, {"head", stick.head_ref}}));
    if (why_.empty()) {
      std::this_thread::sleep_for(std::max(Duration{}, now + kWordPeriod - clock_.now()));
    }
    return why_.empty() ? sight() : std::nullopt;
  }

  [[nodiscard]] const std::string& why() const noexcept { return why_; }

  // Neutral, and as armed as it was. False where the boat did not say so.
  bool leave() noexcept {
    if (left_) {
      return true;
    }
    left_ = true;
    try {
      const bool neutral = refusal(ask({{"command", "manual"}, {"surge", 0}, {"head", 0}})).empty();
      return (!armed_ || refusal(ask({{"command", "disarm"}})).empty()) && neutral;
    } catch (const std::exception&) {
      return false;  // it is neutral by itself 0.5 s after the last word
    }
  }

 private:
  [[nodiscard]] nlohmann::ordered_json ask(const nlohmann::json& request) {
    const std::string line = session_.ask(request);
    if (line.empty()) {
      throw no_answer(boat_);
    }
    return nlohmann::ordered_json::parse(line, nullptr, false);
  }
  [[nodiscard]] static std::string refusal(const nlohmann::ordered_json& reply) {
    if (reply_status("manual", reply) == kExitDone) {
      return {};
    }
    return reply.is_object() ? reply.value("error", "no proper answer") : "no proper answer";
  }

  [[nodiscard]] bool wait_for_sight(Time until) {
    while (!sight()) {
      if (stop_caught() || clock_.now() > until) {
        return false;
      }
      std::this_thread::sleep_for(kWordPeriod);
    }
    return true;
  }

  [[nodiscard]] std::optional<Sighting> sight() {
    const Time now = clock_.now();
    const auto* attitude = attitude_.fresh(now, max_age::kAttitude);
    const auto* fix = fix_.fresh(now, max_age::kPositionFix);
    if (attitude == nullptr || fix == nullptr) {
      why_ = attitude == nullptr ? "the heading is silent" : "the position is silent";
      return std::nullopt;
    }
    const GeoPoint place{fix->value.latitude_deg, fix->value.longitude_deg};
    if (!frame_) {
      frame_.emplace(place);
    }
    const WorldPoint p_W = frame_->to_world(place);
    return Sighting{to_seconds(now.time_since_epoch()), attitude->value.heading_rad, p_W.xy_m.x(),
                    p_W.xy_m.y(), to_seconds(fix->value.measured.time_since_epoch())};
  }

  const Boat& boat_;
  BoatSession session_{boat_};
  SharedBlackboard board_;
  Reader<Attitude> attitude_{board_->attitude};
  Reader<PositionFix> fix_{board_->position_fix};
  SteadyClock clock_;
  std::optional<LocalFrame> frame_;
  std::string why_;
  bool armed_ = false;
  bool left_ = false;
};

void print_result(const WalkResult& result, const CalibrateOptions& options, bool has_mounting) {
  if (!options.common.json) {
    fmt::print("# {}\n{}", result.wiring ? described(*result.wiring) : "",
               to_toml(result.calibration, has_mounting));
    return;
  }
  nlohmann::ordered_json speeds = nlohmann::ordered_json::array();
  for (const PairOfRuns& pair : result.calibration.pairs) {
    speeds.push_back({{"surge_ref", pair.surge_ref},
                      {"speed_m_s", pair.speed_m_s},
                      {"current_m_s", {pair.current_x_m_s, pair.current_y_m_s}}});
  }
  const Wiring wiring = result.wiring.value_or(Wiring{});
  const nlohmann::ordered_json document{
      {"wiring",
       {{"found", result.wiring.has_value()},
        {"swapped", wiring.swapped},
        {"left_reversed", wiring.left_reversed},
        {"right_reversed", wiring.right_reversed}}},
      {"speeds", speeds},
      {"heading_offset_deg", to_deg(result.calibration.heading_offset_rad)},
      {"toml", to_toml(result.calibration, has_mounting)},
      {"fault", result.fault.empty() ? nlohmann::ordered_json(nullptr)
                                     : nlohmann::ordered_json(result.fault)}};
  fmt::print("{}\n", document.dump());
}

[[nodiscard]] int calibrate(const CalibrateOptions& options) {
  const BoatConfig config = load_configuration("default", options.common);
  const Boat boat = find_boat(options);
  catch_stop_signals();
  WalkedBoat walked{boat, options.segment.empty() ? config.segment : options.segment};
  if (const std::string no = walked.take(); !no.empty()) {
    fmt::print(stderr, "calibrate: {}\n", no);
    return kExitNoGoal;
  }
  Walk walk{options.walk, [&](Stick stick) { return walked.steer(stick); },
            [&](const std::string& news) {
              if (!options.common.quiet) {
                fmt::print(stderr, "{}\n", news);
              }
            }};
  WalkResult result = walk.sail();
  if (!walked.why().empty()) {
    result.fault = walked.why();
  }
  if (!walked.leave()) {
    result.fault += std::string{result.fault.empty() ? "" : "; "} +
                    "the boat did not confirm that it is neutral and disarmed";
  }
  if (!result.calibration.pairs.empty() || options.common.json) {
    print_result(result, options, config.document.root().has("mounting"));
  }
  if (!result.fault.empty()) {
    fmt::print(stderr, "calibrate: {}\n", result.fault);
    return kExitNoGoal;
  }
  return kExitDone;
}

}  // namespace

void add_calibrate_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = root.add_subcommand(
      "calibrate", "Walk a boat by the stick to find its wiring, speeds and heading offset");
  command->add_option("--surge", options->walk.surge_refs, "SurgeRefs to run at, there and back")
      ->delimiter(',')
      ->check(number_from(5, 100))
      ->type_name("N,N...");
  command->add_option("--room", options->walk.room_m, "Clear water round the boat")
      ->check(number_from(5, 1000))
      ->type_name("M");
  command->add_option("--leg", options->walk.leg_s, "Longest run")
      ->check(number_from(13, 300))
      ->type_name("S");
  command->add_option("--time-limit", options->walk.time_limit_s, "Of it all")
      ->check(number_from(30, 7200))
      ->type_name("S");
  command->add_option("--segment", options->segment, "Instead of the configuration's")
      ->type_name("NAME");
  add_boat_options(*command, *options);
  command->footer(
      "Example: lodesman calibrate --surge 20,40,80 --room 25\n\nThe boat moves! It is armed, and "
      "disarmed again; Ctrl-C stops it.");
  command->callback([options, &exit_status] {
    exit_status = or_say_why("calibrate", [&] { return calibrate(*options); });
  });
}

}  // namespace lodesman::cli
