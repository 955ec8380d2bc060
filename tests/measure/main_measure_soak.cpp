// SPDX-License-Identifier: Apache-2.0
// Both levels in lock-step on real drivers, whose devices are emulated to the byte, for a day: one
// boat, whose tasks are never begun anew, sails mission after mission between obstacles that come
// and go, while its devices fail in every way that there is. Prints what came of the missions and
// what the program holds; status 1 where it ever stood still without saying why, grew, or counted
// too far.
//   measure_soak [MINUTES [SEED [ROWS]]]
// MINUTES: of the boat's time. ROWS: a file that keeps a line for each mission; where it holds some
// of this seed already, they are sailed again without a word and must come out the same.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/stop_signals.h"
#include "deploy/boat/voyage.h"
#include "deploy/operator/report/output_file.h"
#include "mid_level/base/stopwatch.h"
#include "mid_level/runtime/run_lockstep.h"
#include "tests/measure/soak_judge.h"
#include "tests/measure/soak_voyage.h"

namespace lodesman::measure {
namespace {

namespace fs = std::filesystem;

constexpr Duration kLookPeriod = std::chrono::milliseconds{20};
constexpr double kOrderAgain_s = 2.0;  // a start that was refused is given again
constexpr double kSettled_s = 3600.0;  // or half the soak

[[nodiscard]] double resident_kib() {
  std::ifstream file{"/proc/self/statm"};
  std::uint64_t mapped = 0;
  std::uint64_t resident = 0;
  file >> mapped >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024.0;
}

[[nodiscard]] std::ptrdiff_t open_descriptors() {
  return std::distance(fs::directory_iterator{"/proc/self/fd"}, fs::directory_iterator{}) - 1;
}

[[nodiscard]] BoatConfig looped_configuration() {
  CommonOptions options;
  options.sets = {R"(devices.heading="loop:nav440")", R"(devices.thrusters="loop:maestro")",
                  R"(devices.position="loop:nmea?baud=38400&latency_s=0.04")",
                  R"(devices.sonar="loop:delta_t")"};
  return load_configuration("default", options);
}

// The first words of a refusal, without what differs from time to time.
[[nodiscard]] std::string kind_of(const std::string& reply) {
  const auto document = nlohmann::json::parse(reply, nullptr, false);
  std::string text = document.is_object() ? document.value("error", reply) : reply;
  text.resize(std::min(text.find(';'), text.size()));
  text.resize(std::min(text.find(" for "), text.size()));
  return text;
}

class Boat {
 public:
  Boat(const BoatConfig& configuration, const SoakVoyage& voyage)
      : legs_{voyage.legs},
        boat_{*board_, configuration, &voyage.scenario},
        high_{*board_, Role::kHigh,
              high_level_options(configuration, voyage_of(configuration, &voyage.scenario))},
        judge_{*board_} {
    std::vector<TaskEntry> tasks = boat_.tasks();
    for (const TaskEntry& entry : high_.tasks()) {
      tasks.push_back(entry);
    }
    clock_.advance_to(Time{std::chrono::seconds{1}});
    DeskOptions desk = desk_options(configuration, voyage_of(configuration, &voyage.scenario));
    desk.arms_by_itself = true;
    desk_ =
        std::make_unique<OperatorDesk>(*board_, Role::kHigh, desk, [this] { return clock_.now(); });
    runner_ = std::make_unique<LockstepRunner>(tasks, clock_, *board_, LockstepOptions{});
  }

  // The next mission, for the time that it has; empty where it was told to end.
  [[nodiscard]] std::optional<LegOutcome> sail(std::size_t index) {
    const SoakLeg& leg = legs_[index];
    const Time begun = clock_.now();
    judge_.begin_leg(begun);
    refusal_ = "no answer";
    answer_ = {};
    aborts_ = false;
    next_order_ = begun;
    Time next_look = begun;
    while (clock_.now() < end_of(index, begun)) {
      runner_->step();
      if (clock_.now() < next_look) {
        continue;
      }
      next_look = clock_.now() + kLookPeriod;
      if (stop_caught()) {
        return std::nullopt;
      }
      give_orders(leg);
      judge_.look(clock_.now());
    }
    return judge_.end_leg(leg.goal.x_m, leg.goal.y_m, refusal_);
  }

  [[nodiscard]] Time now() const noexcept { return clock_.now(); }
  // The highest number that any channel has come to.
  [[nodiscard]] std::pair<std::uint64_t, std::string> highest_sequence() const {
    std::pair<std::uint64_t, std::string> highest;
    for_each_channel(*board_, [&](const ChannelInfo& info, const auto& channel) {
      highest = std::max(highest, {channel.head.newest.load(), std::string{info.name}});
    });
    return highest;
  }
  [[nodiscard]] unsigned refused() const noexcept { return refused_; }
  [[nodiscard]] std::uint64_t steps() const {
    std::uint64_t steps = 0;
    for (const auto& channel : board_->task_health) {
      Reader<TaskHealth> reader{channel};
      const auto* health = reader.latest();
      steps += health != nullptr ? health->value.steps : 0;
    }
    return steps;
  }

 private:
  // The scenario's time begins with the first start.
  [[nodiscard]] Time end_of(std::size_t index, Time begun) const noexcept {
    return first_start_ == Time{}
               ? begun + from_seconds(kLeg_s)
               : first_start_ + from_seconds(static_cast<double>(index + 1) * kLeg_s);
  }

  // Starts the mission, as often as it takes; after a refusal it does as an operator would: aborts
  // what there is, and starts again.
  void give_orders(const SoakLeg& leg) {
    desk_->look();
    if (refusal_.empty()) {
      return;
    }
    if (!answer_ && clock_.now() >= next_order_) {
      CommandRequest request;
      request.command = aborts_ ? "abort" : "start";
      request.scope = Scope::kCommand;
      request.session = 1;
      if (!aborts_) {
        request.mission = mission_text(leg);
      }
      answer_ = desk_->answer(request);
    }
    if (const auto reply = answer_ ? answer_() : std::nullopt) {
      hear(*reply);
    }
  }
  void hear(const std::string& reply) {
    const bool taken = reply.find("\"ok\":true") != std::string::npos;
    if (!aborts_) {
      refusal_ = taken ? "" : kind_of(reply);
      refused_ += taken ? 0U : 1U;
      first_start_ = taken && first_start_ == Time{} ? clock_.now() : first_start_;
    }
    aborts_ = !aborts_ && !taken;
    answer_ = {};
    next_order_ = clock_.now() + from_seconds(kOrderAgain_s);
  }

  const std::vector<SoakLeg>& legs_;
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  SimClock clock_;
  AssembledBoat boat_;
  HighLevel high_;
  SoakJudge judge_;
  std::unique_ptr<OperatorDesk> desk_;
  std::unique_ptr<LockstepRunner> runner_;
  Answer answer_;
  std::string refusal_;  // of the last start; empty: it was taken
  bool aborts_ = false;  // the next order is an abort
  unsigned refused_ = 0;
  Time next_order_{};
  Time first_start_{};
};

[[nodiscard]] std::string fault_words(const SoakLeg& leg) {
  return leg.fault ? fmt::format("{} {}", name_of(leg.fault->device), name_of(leg.fault->kind))
                   : "-";
}

[[nodiscard]] std::string row_of(std::size_t index, const SoakLeg& leg, const LegOutcome& outcome) {
  return fmt::format("{},{},{},{:.2f},{},{},{},{}", index + 1, fault_words(leg), outcome.what,
                     outcome.to_go_m, outcome.stops, outcome.unsaid, outcome.contacts,
                     outcome.contacts_at_rest);
}

// The rows of an earlier run of the same seed, which this one must repeat, and its own after them.
class RowFile {
 public:
  RowFile(const std::string& path, std::uint64_t seed) {
    const std::string head =
        fmt::format("seed {}: mission,fault,outcome,to_go_m,stops,unsaid,contacts,at_rest", seed);
    if (path.empty()) {
      return;
    }
    std::ifstream file{path};
    std::string line;
    if (std::getline(file, line) && line != head) {
      throw std::runtime_error(path + " is of another run: " + line);
    }
    std::string whole = head + '\n';
    // What was cut off in the middle of a line is no row.
    while (std::getline(file, line) && !file.eof()) {
      kept_.push_back(line);
      whole += line + '\n';
    }
    cli::write_whole_file(path, whole);
    out_.open(path, std::ios::app);
  }
  // Throws where an earlier run had another.
  void add(std::size_t index, const std::string& row) {
    if (index < kept_.size()) {
      if (kept_[index] != row) {
        throw std::runtime_error("not the same again: " + kept_[index] + " / " + row);
      }
    } else if (out_.is_open()) {
      out_ << row << std::endl;
    }
  }
  [[nodiscard]] std::size_t kept() const noexcept { return kept_.size(); }

 private:
  std::vector<std::string> kept_;
  std::ofstream out_;
};

struct Totals {
  std::map<std::string, unsigned> outcomes;
  unsigned missions = 0;
  unsigned faults = 0;
  unsigned stops = 0;
  unsigned unsaid = 0;
  unsigned contacts = 0;
  unsigned contacts_with_fault = 0;
  unsigned contacts_at_rest = 0;

  void add(const SoakLeg& leg, const LegOutcome& outcome) {
    ++missions;
    ++outcomes[outcome.what];
    faults += leg.fault ? 1U : 0U;
    stops += outcome.stops;
    unsaid += outcome.unsaid;
    (leg.fault ? contacts_with_fault : contacts) += outcome.contacts;
    contacts_at_rest += outcome.contacts_at_rest;
  }
};

[[nodiscard]] Held held_now(const Boat& boat) {
  return {to_seconds(boat.now() - Time{}), resident_kib(), open_descriptors()};
}

// `since`: nothing where it was stopped before that.
[[nodiscard]] bool report(const Totals& totals, const Boat& boat, const std::optional<Held>& since,
                          double took_s) {
  const Held last = held_now(boat);
  const Held settled = since.value_or(last);
  const double sailed_s = last.at_s;
  const auto [sequence, channel] = boat.highest_sequence();
  fmt::print("| of {:.1f} simulated hours | |\n|---|---|\n", sailed_s / 3600.0);
  fmt::print("| missions, one after the other | {} |\n", totals.missions);
  for (const auto& [what, count] : totals.outcomes) {
    fmt::print("| - {} | {} |\n", what, count);
  }
  fmt::print("| starts that were refused with a reason, then an abort and another start | {} |\n",
             boat.refused());
  fmt::print("| device faults | {} |\n", totals.faults);
  fmt::print("| stops of half a minute under way, and without a reason said | {}, {} |\n",
             totals.stops, totals.unsaid);
  fmt::print("| contacts under way, without a fault in that mission and with one | {}, {} |\n",
             totals.contacts, totals.contacts_with_fault);
  fmt::print("| contacts while no mission was under way | {} |\n", totals.contacts_at_rest);
  fmt::print("| steps of tasks | {} |\n", boat.steps());
  fmt::print("| highest number of a publication | {} ({}) |\n", sequence, channel);
  fmt::print("| resident KiB after {:.1f} h and at the end | {:.0f}, {:.0f} |\n",
             settled.at_s / 3600.0, settled.resident_kib, last.resident_kib);
  fmt::print("| open descriptors, likewise | {}, {} |\n", settled.descriptors, last.descriptors);
  fmt::print("| times real time | {:.0f} |\n", sailed_s / took_s);
  const auto reasons = objections({totals.unsaid, sequence, settled, last});
  for (const std::string& reason : reasons) {
    fmt::print(stderr, "measure_soak: {}\n", reason);
  }
  return reasons.empty();
}

[[nodiscard]] int run(double minutes, std::uint64_t seed, const std::string& rows_file) {
  const BoatConfig configuration = looped_configuration();
  const auto count = static_cast<std::size_t>(std::max(1.0, minutes * 60.0 / kLeg_s));
  const SoakVoyage voyage = make_soak_voyage(seed, count, configuration.speeds);
  require_sound(configuration, &voyage.scenario);
  RowFile rows{rows_file, seed};
  catch_stop_signals();
  fmt::print(stderr, "seed {}, {} missions, {} obstacles, {} faults; {} kept\n", seed, count,
             voyage.scenario.obstacles.size(), voyage.scenario.faults.size(), rows.kept());
  Boat boat{configuration, voyage};
  Totals totals;
  std::optional<Held> settled;
  const Stopwatch stopwatch;
  for (std::size_t i = 0; i < count; ++i) {
    const auto outcome = boat.sail(i);
    if (!outcome) {
      fmt::print(stderr, "\nstopped: the same seed and rows go on from here\n");
      break;
    }
    totals.add(voyage.legs[i], *outcome);
    rows.add(i, row_of(i, voyage.legs[i], *outcome));
    const double sailed_s = to_seconds(boat.now() - Time{});
    if (!settled && (sailed_s >= kSettled_s || 2 * (i + 1) >= count)) {
      settled = held_now(boat);
    }
    fmt::print(stderr, "\r{} of {} missions, {:.2f} h, {:.0f} times real time ", i + 1, count,
               sailed_s / 3600.0, sailed_s / to_seconds(stopwatch.elapsed()));
  }
  fmt::print(stderr, "\n");
  const bool holds = report(totals, boat, settled, to_seconds(stopwatch.elapsed()));
  return holds ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  const double minutes = argc > 1 ? std::atof(argv[1]) : 1440.0;
  const auto seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  try {
    return lodesman::measure::run(minutes, seed, argc > 3 ? argv[3] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_soak: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
