// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/rt_run.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "deploy/boat/named_scenario.h"
#include "deploy/operator/report/output_file.h"
#include "deploy/operator/rt_test/companion.h"
#include "deploy/operator/run/realtime_run.h"
#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

// Under way, before the first look: what happens once has happened, and every task has told of
// itself once.
constexpr Duration kSettle = std::chrono::seconds{3};
constexpr Duration kStopPatience = std::chrono::seconds{3};
constexpr unsigned kStartPatience_s = 60;

[[nodiscard]] std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

[[nodiscard]] std::string processor_name() {
  std::ifstream processors{"/proc/cpuinfo"};
  std::string line;
  while (std::getline(processors, line)) {
    if (const auto colon = line.find(": ");
        line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

[[nodiscard]] RtConditions conditions_of(const RtRunOptions& options) {
  utsname system{};
  uname(&system);
  RtConditions conditions;
  conditions.load = options.load;
  conditions.wanted_s = options.seconds;
  conditions.cores = std::max(1U, std::thread::hardware_concurrency());
  conditions.kernel = system.release;
  conditions.real_time_kernel = text_of("/sys/kernel/realtime").starts_with("1") ||
                                std::string{system.version}.find("PREEMPT_RT") != std::string::npos;
  conditions.processor = processor_name();
  return conditions;
}

// Looks at the boat once it has settled, and again when the time is over. What is to run beside it
// in that time alone begins with the first look.
class Observation {
 public:
  explicit Observation(const RtRunOptions& options)
      : options_{options}, allocations_{options.place} {}

  // Called while the boat runs.
  void progress(MissionState state) {
    const Time now = clock_.now();
    if (last_ || state != MissionState::kUnderWay) {
      return;
    }
    allocations_.leave_environment();
    settles_ = settles_.value_or(now);
    if (!first_ && now >= *settles_ + kSettle) {
      begin();
    } else if (first_) {
      options_.show(to_seconds(now - first_->at));
    }
  }
  // Whether there is nothing more to be seen; asked while the boat still runs.
  [[nodiscard]] bool is_over() {
    const bool interrupted = options_.interrupted();
    if (first_ && !last_ &&
        (interrupted || clock_.now() >= first_->at + from_seconds(options_.seconds))) {
      last_ = look();
      end_cyclictest();
    }
    return interrupted || last_.has_value();
  }

  [[nodiscard]] std::optional<RtReport> report(RtConditions conditions) const {
    if (!first_ || !last_) {
      return std::nullopt;
    }
    conditions.seconds = to_seconds(last_->at - first_->at);
    std::optional<CyclictestFigures> figures;
    if (options_.cyclictest) {
      figures = read_cyclictest(text_of(cyclictest_file()));
    }
    RtReport report = report_of(conditions, *first_, *last_, figures);
    if (options_.cyclictest && !figures) {
      report.cyclictest_why = cyclictest_said_.empty() ? "it said nothing" : cyclictest_said_;
    }
    return report;
  }

 private:
  [[nodiscard]] fs::path cyclictest_file() const { return options_.place / "cyclictest.json"; }

  [[nodiscard]] BoatLook look() {
    return look_at_boat(**board_, low_, high_, allocations_, clock_.now());
  }
  void begin() {
    board_.emplace(
        SharedBlackboard::observe("lodesman-sim-" + std::to_string(getpid()), Duration::zero()));
    low_ = child_named("lodesman-low");
    high_ = child_named("lodesman-high");
    if (options_.cyclictest) {
      cyclictest_.emplace(cyclictest_words(cyclictest_priority(), cyclictest_file()),
                          options_.place);
    }
    first_ = look();
  }
  void end_cyclictest() {
    if (cyclictest_) {
      cyclictest_->stop(kStopPatience);
      cyclictest_said_ = cyclictest_->last_words();
    }
  }

  SteadyClock clock_;
  const RtRunOptions& options_;
  AllocationCounter allocations_;
  std::optional<Time> settles_;
  std::optional<SharedBlackboard> board_;
  pid_t low_ = 0;
  pid_t high_ = 0;
  std::optional<Companion> cyclictest_;
  std::string cyclictest_said_;
  std::optional<BoatLook> first_;
  std::optional<BoatLook> last_;
};

}  // namespace

RtRunOutcome run_rt_test(const RtRunOptions& options) {
  const RtConditions conditions = conditions_of(options);
  const fs::path config_file = options.place / "config.toml";
  const fs::path scenario_file = options.place / "scenario.toml";
  write_whole_file(config_file, options.configuration.to_text());
  write_whole_file(scenario_file, options.scenario_text);
  const Scenario scenario =
      load_named_scenario(scenario_file.string(), options.configuration.speeds);
  std::optional<Companion> load;
  const auto longest_s = static_cast<unsigned>(options.seconds) + kStartPatience_s;
  if (const auto words = load_words(options.load, conditions.cores, longest_s); !words.empty()) {
    load.emplace(words, options.place);
  }
  Observation observation{options};
  const std::function<bool()> is_over = [&] {
    return observation.is_over() || (load && load->ended());
  };
  const std::function<void(const RunProgress&)> show = [&](const RunProgress& progress) {
    observation.progress(progress.state);
  };
  const RunRecord record = run_realtime({config_file,
                                         scenario_file,
                                         options.configuration,
                                         scenario,
                                         std::nullopt,
                                         false,
                                         is_over,
                                         show,
                                         {}});
  RtRunOutcome outcome{observation.report(conditions), record.result.fault};
  if (outcome.fault.empty() && !options.interrupted()) {
    if (load && load->ended()) {
      outcome.fault = "stress-ng ended: " + load->last_words();
    } else if (!outcome.report) {
      outcome.fault = "the boat did not get under way: " + record.result.outcome;
    }
  }
  return outcome;
}

}  // namespace lodesman::cli
