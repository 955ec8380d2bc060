// SPDX-License-Identifier: Apache-2.0
// lodesman-devices: the bench without a boat. A simulated vessel behind AHRS, satellite receiver,
// sonar and thruster box that are emulated to the byte, on ptys or on serial ports with a cable to
// the boat's computer, and on UDP.
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "deploy/boat/configuration.h"
#include "deploy/boat/device_bench.h"
#include "deploy/boat/exit_status.h"
#include "deploy/boat/log.h"
#include "deploy/boat/process_main.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/runtime/realtime_rights.h"

namespace lodesman {
namespace {

constexpr Duration kStepPeriod = std::chrono::milliseconds{1};

struct DevicesOptions : ProcessOptions {
  DeviceBenchOptions bench;
  std::string box = "maestro";
  std::string control;
  std::optional<std::uint64_t> seed;
};

// Lines that are written to a named pipe, each a fault that begins at once.
class Control {
 public:
  explicit Control(const std::string& path) : path_{path} {
    if (path_.empty()) {
      return;
    }
    // Nothing of somebody's is lost: only such a pipe, left by a bench that was killed, is
    // replaced.
    struct stat found {};
    if (lstat(path_.c_str(), &found) == 0 && S_ISFIFO(found.st_mode)) {
      unlink(path_.c_str());
    }
    if (mkfifo(path_.c_str(), 0600) != 0) {
      throw StartupError(path_ + ": no named pipe can be made there");
    }
    // For writing too, so that it has no end when a writer goes.
    pipe_ = open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;
  ~Control() {
    if (pipe_ >= 0) {
      close(pipe_);
      unlink(path_.c_str());
    }
  }

  void obey(DeviceBench& bench) {
    std::array<char, 1024> piece{};
    const ssize_t count = pipe_ >= 0 ? read(pipe_, piece.data(), piece.size()) : 0;
    if (count > 0) {
      text_.append(piece.data(), static_cast<std::size_t>(count));
    }
    for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      const std::string line = text_.substr(0, end);
      text_.erase(0, end + 1);
      const std::string no = bench.order(line);
      no.empty() ? spdlog::info("{}", line) : spdlog::warn("{}: {}", line, no);
    }
    if (text_.size() > piece.size()) {
      text_.clear();
    }
  }

 private:
  std::string path_;
  int pipe_ = -1;
  std::string text_;
};

// A device keeps its time whatever else the machine does. Above the boat's tasks: it is done in a
// moment, and they would wait for it.
constexpr int kPriority = 80;

int run(DevicesOptions& options) {
  const BoatConfig config = load_configuration(options.profile, options.common);
  if (config.simulation.scenario.empty()) {
    throw StartupError("simulation.scenario: give the scenario of the bench's world");
  }
  Scenario scenario = load_named_scenario(config.simulation.scenario, config.speeds);
  scenario.seed = options.seed.value_or(scenario.seed);
  options.bench.boat_segment = config.segment;
  options.bench.hull = config.simulation.hull;
  options.bench.box =
      options.box == "roboclaw" ? ThrusterBoxKind::kRoboClaw : ThrusterBoxKind::kMaestro;
  const SteadyClock clock;
  // Its satellites tell the machine's UTC.
  options.bench.epoch = std::chrono::system_clock::now().time_since_epoch() -
                        std::chrono::nanoseconds{clock.now().time_since_epoch()};
  DeviceBench bench{options.bench, scenario, clock.now()};
  Control control{options.control};
  std::jthread stepping{[&](const std::stop_token& stop) {
    static_cast<void>(hold_fifo_priority(kPriority));
    Time due = clock.now();
    while (!stop.stop_requested()) {
      bench.step(clock.now());
      control.obey(bench);
      due = std::max(due + kStepPeriod, clock.now());
      std::this_thread::sleep_until(std::chrono::steady_clock::time_point{due.time_since_epoch()});
    }
  }};
  wait_for_stop([] { return false; });
  return kExitDone;
}

}  // namespace
}  // namespace lodesman

int main(int argc, char** argv) {
  lodesman::block_stop_signals();
  lodesman::log_without_blocking();
  CLI::App app{"The bench: a simulated vessel behind devices that are emulated to the byte",
               "lodesman-devices"};
  lodesman::DevicesOptions options;
  lodesman::add_process_options(app, options);
  lodesman::add_seed_option(app, options.seed);
  app.add_option("--ports", options.bench.directory,
                 "Directory of the ptys' names: ahrs, position, thrusters")
      ->required()
      ->type_name("DIR");
  app.add_option("--ahrs-port", options.bench.ahrs_port, "A serial port instead of the first")
      ->type_name("PORT");
  app.add_option("--position-port", options.bench.position_port, "Instead of the second")
      ->type_name("PORT");
  app.add_option("--thruster-port", options.bench.thruster_port, "Instead of the third")
      ->type_name("PORT");
  lodesman::add_port_option(
      app, "--sonar-port", options.bench.sonar_port,
      "UDP port on which the boat listens for the sonar; without it there is none");
  app.add_option("--sonar-host", options.bench.sonar_host, "The boat's address [127.0.0.1]")
      ->type_name("HOST");
  app.add_option("--box", options.box, "maestro or roboclaw")
      ->check(CLI::IsMember({"maestro", "roboclaw"}));
  app.add_flag("--esc", options.bench.has_escs, "Speed controllers behind the servo box");
  app.add_option("--control", options.control, "A named pipe to make: a line a fault, or clear")
      ->type_name("FILE");
  app.footer(
      "Example: lodesman-devices --scenario paper-static --ports ports --sonar-port 4040 --control "
      "control\n"
      "         echo 'ahrs flip rate=0.01 for=5' > control");
  return lodesman::process_main(app, argc, argv, [&] { return lodesman::run(options); });
}
