// SPDX-License-Identifier: Apache-2.0
// Aborts under a storm of orders: 20,000 a second over 1,000 connections to a running boat. Says
// how many were confirmed, and how long after an abort was sent the thrusters were neutral, by the
// stamps of what was applied. Fails where one was not confirmed or took longer than the safety
// bound.
//   measure_abort_storm [COUNT]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>

#include "high_level/mission/token_file.h"
#include "tests/support/command_crowd.h"
#include "tests/system/boat.h"
#include "tests/system/listening_port.h"

namespace lodesman::testing {
namespace {

constexpr int kConnections = 1000;
constexpr int kOrdersPerS = 20000;
constexpr double kBound_s = 0.5;

// Far enough not to be reached while it is stopped and started.
constexpr const char* kScenario =
    "name = \"storm\"\nseed = 1\ntime_limit_s = 10000.0\n[mission]\nstart_m = [0.0, 0.0]\n"
    "start_heading_deg = 0.0\ngoal_m = [0.0, 1500.0]\ngoal_radius_m = 0.5\n[vehicle]\n"
    "speed_m_s = 0.74\nradius_m = 0.5\n";

// A directory with the files of a boat, gone with it.
class Files {
 public:
  Files() {
    std::string pattern = (fs::temp_directory_path() / "lodesman-storm-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw std::runtime_error("no directory can be made");
    }
    directory_ = pattern;
    CommonOptions options;
    options.sets = {"command_socket.port = 0"};
    std::ofstream{directory_ / "c.toml"} << load_configuration("default", options).to_text();
    std::ofstream{directory_ / "s.toml"} << kScenario;
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  ~Files() {
    std::error_code ignored;
    fs::remove_all(directory_, ignored);
  }
  [[nodiscard]] std::vector<std::string> arguments(const std::string& segment) const {
    return {"--segment",  segment,
            "--config",   (directory_ / "c.toml").string(),
            "--scenario", (directory_ / "s.toml").string()};
  }

 private:
  fs::path directory_;
};

class Commanded {
 public:
  explicit Commanded(const Files& files)
      : segment_{"lodesman-storm-" + std::to_string(getpid())},
        low_{"lodesman-low", files.arguments(segment_)},
        high_{"lodesman-high", files.arguments(segment_)} {
    const bool found = eventually([&] {
      port_ = static_cast<std::uint16_t>(listening_port(high_.pid()));
      return port_ != 0 && find_token_file(port_).has_value();
    });
    if (!found) {
      throw std::runtime_error("the boat does not come up");
    }
    token_ = read_token(*find_token_file(port_));
  }
  [[nodiscard]] const std::string& segment() const noexcept { return segment_; }
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
  [[nodiscard]] std::string text(const std::string& command) const {
    return command_text(command, token_);
  }
  // Asks again where a crowd has pushed it out, as `lodesman abort` does.
  [[nodiscard]] bool tell(const std::string& command) const {
    std::string reply;
    return eventually([&] { return !(reply = ask_boat(port_, text(command))).empty(); }) &&
           reply.find("\"ok\":true") != std::string::npos;
  }

 private:
  std::string segment_;
  ChildProcess low_;
  ChildProcess high_;
  std::uint16_t port_ = 0;
  std::string token_;
};

[[nodiscard]] bool neutral(const ThrustApplied& thrust) {
  return (thrust.left == 127 || thrust.left == 128) && (thrust.right == 127 || thrust.right == 128);
}

// From sending the abort; nothing where it was not confirmed.
[[nodiscard]] std::optional<double> neutral_after_s(const Commanded& commanded,
                                                    Reader<ThrustApplied>& thrust) {
  const SteadyClock clock;
  const Time sent = clock.now();
  if (!commanded.tell("abort")) {
    return std::nullopt;
  }
  std::optional<double> after_s;
  const bool found = eventually([&] {
    const auto* applied = thrust.next();
    if (applied != nullptr && applied->stamp >= sent && neutral(applied->value)) {
      after_s = to_seconds(applied->stamp - sent);
    }
    return after_s.has_value();
  });
  return found ? after_s : std::nullopt;
}

int storm(int count) {
  const Files files;
  const Commanded commanded{files};
  const auto board = SharedBlackboard::observe(commanded.segment(), kPatience);
  Reader<ThrustApplied> thrust{board->thrust_applied};
  const SteadyClock clock;
  const CommandCrowd crowd{{commanded.port(), kConnections, kOrdersPerS, commanded.text("resume")}};
  const bool crowded = eventually([&] { return crowd.connected() >= kConnections; });
  const Time began = clock.now();
  const std::uint64_t sent = crowd.sent();
  const std::uint64_t answered = crowd.answered();
  std::vector<double> times_s;
  int unconfirmed = 0;
  std::mt19937 random{1};
  for (int i = 0; i < count; ++i) {
    const bool under_way =
        commanded.tell("start") && eventually([&] { return drives(thrust.latest()); });
    std::this_thread::sleep_for(milliseconds{random() % 100});  // any phase of the tasks
    const auto after_s = under_way ? neutral_after_s(commanded, thrust) : std::nullopt;
    if (after_s) {
      times_s.push_back(*after_s);
    } else {
      ++unconfirmed;
    }
  }
  const double took_s = to_seconds(clock.now() - began);
  std::sort(times_s.begin(), times_s.end());
  const double median_s = times_s.empty() ? 0.0 : times_s[times_s.size() / 2];
  const double worst_s = times_s.empty() ? 0.0 : times_s.back();
  std::printf("%-34s %10s\n", "aborts under a storm", "");
  std::printf("%-34s %10d\n", "connections kept up", kConnections);
  std::printf("%-34s %10llu\n", "connections made in all",
              static_cast<unsigned long long>(crowd.connected()));
  std::printf("%-34s %10.0f\n", "orders sent per s",
              static_cast<double>(crowd.sent() - sent) / took_s);
  std::printf("%-34s %10.0f\n", "orders answered per s",
              static_cast<double>(crowd.answered() - answered) / took_s);
  std::printf("%-34s %10d\n", "aborts", count);
  std::printf("%-34s %10zu\n", "confirmed, then neutral", times_s.size());
  std::printf("%-34s %10.1f\n", "median time to neutral, ms", median_s * 1e3);
  std::printf("%-34s %10.1f\n", "worst time to neutral, ms", worst_s * 1e3);
  return crowded && unconfirmed == 0 && worst_s <= kBound_s ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace lodesman::testing

int main(int argc, char** argv) {
  try {
    const int count = argc > 1 ? std::atoi(argv[1]) : 1000;
    return count > 0 ? lodesman::testing::storm(count) : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measure_abort_storm: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
