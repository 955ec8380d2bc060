// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/rt_test_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/device_catalogue.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/cli/number_options.h"
#include "deploy/operator/rt_test/companion.h"
#include "deploy/operator/rt_test/round_trips.h"
#include "deploy/operator/rt_test/rt_run.h"
#include "deploy/operator/watch/find_segment.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kShortest_s = 5.0;  // tasks tell of themselves once a second

struct RtTestOptions {
  CommonOptions common;
  std::string load = to_string(LoadKind::kIdle);
  double seconds = 60.0;
  bool cyclictest = false;
};

// A directory for the files of one run, gone with this.
class Place {
 public:
  Place() {
    std::string pattern = (fs::temp_directory_path() / "lodesman-rt-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw StartupError("no directory can be made in " + fs::temp_directory_path().string());
    }
    path_ = pattern;
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

void require_programs(const RtTestOptions& options) {
  const auto require = [](bool wanted, const char* option, const char* program,
                          const char* package) {
    if (wanted && find_program(program).empty()) {
      throw StartupError(fmt::format("{}: {} is not installed: sudo apt-get install {}", option,
                                     program, package));
    }
  };
  require(load_named(options.load) != LoadKind::kIdle, "--load", "stress-ng", "stress-ng");
  require(options.cyclictest, "--cyclictest", "cyclictest", "rt-tests");
}

[[nodiscard]] BoatConfig simulated(const CommonOptions& given, const fs::path& scenario) {
  CommonOptions common = given;
  common.sets.push_back("simulation.scenario=" + toml_string(scenario.string()));
  common.sets.emplace_back("command_socket.port=0");  // nobody is to command it
  BoatConfig configuration = load_configuration("default", common);
  if (const char* real = real_device(configuration.devices); real != nullptr) {
    configuration.document.root().table("devices").refuse(
        real, "is real, and rt-test sails by itself: leave it out");
  }
  return configuration;
}

void print(const RtReport& report, bool quiet) {
  if (!quiet) {
    for (const std::string& line : table_lines(report)) {
      fmt::print("{}\n", line);
    }
  }
  const auto reasons = objections(report);
  for (const std::string& reason : reasons) {
    fmt::print("{}\n", reason);
  }
  fmt::print("verdict: {}\n", reasons.empty() ? "pass" : "fail");
}

[[nodiscard]] int rt_test(const RtTestOptions& options) {
  require_programs(options);
  const Place place;
  const BoatConfig configuration = simulated(options.common, place.path() / "scenario.toml");
  catch_stop_signals();
  remove_dead_runs();
  const bool shows = !options.common.quiet && isatty(STDERR_FILENO) == 1;
  const std::function<bool()> interrupted = stop_caught;
  const std::function<void(double)> show = [&](double over_s) {
    if (shows) {
      fmt::print(stderr, "\r{:.0f} of {:.0f} s ", over_s, options.seconds);
    }
  };
  const RtRunOutcome outcome = run_rt_test(
      {configuration, round_trips_scenario(options.seconds), place.path(),
       *load_named(options.load), options.seconds, options.cyclictest, interrupted, show});
  if (shows) {
    fmt::print(stderr, "\r\x1b[K");
  }
  if (!outcome.fault.empty()) {
    fmt::print(stderr, "fault: {}\n", outcome.fault);
  }
  if (!outcome.report) {
    if (outcome.fault.empty()) {
      fmt::print(stderr, "ended before there was anything to look at\n");
    }
    return outcome.fault.empty() ? kExitNoGoal : kExitFault;
  }
  if (options.common.json) {
    fmt::print("{}\n", to_json(*outcome.report)
                           .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else {
    print(*outcome.report, options.common.quiet);
  }
  return !outcome.fault.empty()                ? kExitFault
         : objections(*outcome.report).empty() ? kExitDone
                                               : kExitNoGoal;
}

}  // namespace

void add_rt_test_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<RtTestOptions>();
  CLI::App* command = root.add_subcommand(
      "rt-test", "The task set on this machine under load, beside what the machine itself can do");
  command
      ->add_option("--load", options->load,
                   "idle; cpu: every core computes; all: memory, files, sockets, pipes too")
      ->check(CLI::IsMember({"idle", "cpu", "all"}));
  command->add_option("--seconds", options->seconds, "How long it is looked at [60]")
      ->type_name("S")
      ->check(number_from(kShortest_s, kLongestRoundTrips_s));
  command->add_flag("--cyclictest", options->cyclictest,
                    "Beside it rt-tests' cyclictest, at the priority of the thruster task");
  add_common_options(*command, options->common);
  command->footer(
      "Example: lodesman rt-test --load all --seconds 300 --cyclictest\n\nExit status 1 where the "
      "task table is not kept.");
  command->callback([options, &exit_status] { exit_status = rt_test(*options); });
}

}  // namespace lodesman::cli
