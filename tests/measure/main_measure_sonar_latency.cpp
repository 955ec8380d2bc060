// SPDX-License-Identifier: Apache-2.0
// How long a ping takes through the driver of the sonar: from the datagram that leaves the Delta
// T's program to the obstacles of that ping on the blackboard. The boat's two programs; head and
// program are emulated to the byte in this process, which looks every few microseconds. The boat
// lies still 15 m in front of a stone. Prints a table.
//   measure_sonar_latency [PINGS]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "deploy/boat/free_port.h"
#include "drivers/stream/udp_socket.h"
#include "hal_sim/emulators/emulated_sonar.h"
#include "tests/system/boat.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;

constexpr Duration kLook = std::chrono::microseconds{20};
constexpr std::uint32_t kSettling = 20;  // pings before the first that counts

constexpr const char* kStone = R"(
[[obstacle]]
shape = "circle"
centre_m = [0.0, 15.0]
radius_m = 1.0
protection_m = 2.0
[sonar]
scene = "beams"
)";

[[nodiscard]] double percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

class Bench {
 public:
  explicit Bench(const std::string& output) {
    CommonOptions options;
    options.sets = {
        "command_socket.port = 0",
        "devices.sonar=" +
            toml_string("delta_t:127.0.0.1?port=" + std::to_string(port_) + "&output=" + output),
        "devices.position=none", "estimator.position_source=dead_reckoning"};
    const auto config =
        scratch_.file("config.toml", load_configuration("default", options).to_text());
    const std::vector<std::string> arguments{"--segment",     segment_,     "--config",
                                             config.string(), "--scenario", scenario_.string()};
    low_ = std::make_unique<ChildProcess>("lodesman-low", arguments);
    high_ = std::make_unique<ChildProcess>("lodesman-high", arguments);
    board_.emplace(SharedBlackboard::observe(segment_, kPatience));
    obstacles_.emplace((*board_)->sonar_obstacles);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  ~Bench() {
    high_.reset();
    low_.reset();
    remove_dead_segment(segment_);
  }

  // [ms] sorted; those that never came are left out.
  [[nodiscard]] std::vector<double> measure(std::size_t pings) {
    std::vector<double> took_ms;
    const Time deadline = clock_.now() + kPatience + milliseconds{100} * pings;
    while (took_ms.size() < pings) {
      if (clock_.now() > deadline) {
        throw std::runtime_error("no obstacles come of the pings");
      }
      step(took_ms);
      std::this_thread::sleep_for(kLook);
    }
    std::sort(took_ms.begin(), took_ms.end());
    return took_ms;
  }

 private:
  void step(std::vector<double>& took_ms) {
    const Time now = clock_.now();
    const std::uint64_t sent = sonar_.sent();
    sonar_.feel(WorldSample{}, now);
    sonar_.exchange(socket_, now);
    if (sonar_.sent() > sent) {
      left_ = now;
    }
    while (const auto* frame = obstacles_->next()) {
      if (left_ == Time{} || frame->value.count == 0) {
        continue;
      }
      if (++heard_ > kSettling) {
        took_ms.push_back(to_seconds(clock_.now() - left_) * 1e3);
      }
      left_ = Time{};
    }
  }

  SteadyClock clock_;
  Scratch scratch_{"sonar-latency"};
  std::string segment_ = "lodesman-test-sonar-" + std::to_string(getpid());
  std::uint16_t port_ = free_udp_port();
  fs::path scenario_ = scratch_.file("scenario.toml", scenario_text(1900.0, 10'000.0) + kStone);
  EmulatedSonar sonar_{
      emulated_sonar_options(load_scenario(scenario_, load_configuration("default", {}).speeds)),
      {},
      clock_.now()};
  UdpSocket socket_{{"127.0.0.1", port_, 0}};
  std::optional<SharedBlackboard> board_;
  std::optional<Reader<SonarObstacles>> obstacles_;
  std::unique_ptr<ChildProcess> low_;
  std::unique_ptr<ChildProcess> high_;
  Time left_{};  // the last one, until its obstacles come
  std::uint32_t heard_ = 0;
};

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  using namespace lodesman::measure;
  const auto pings = static_cast<std::size_t>(argc > 1 ? std::max(1, std::atoi(argv[1])) : 600);
  try {
    fmt::print("| datagram out to obstacles | pings | median ms | p99 ms | worst ms |\n");
    fmt::print("|---|---|---|---|---|\n");
    for (const char* output : {"83B", "83P"}) {
      const std::vector<double> took_ms = Bench{output}.measure(pings);
      fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", output, took_ms.size(),
                 percentile(took_ms, 0.5), percentile(took_ms, 0.99), took_ms.back());
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_sonar_latency: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
