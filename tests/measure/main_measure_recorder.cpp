// SPDX-License-Identifier: Apache-2.0
// The black box at full rate, on two processes in real time: what it misses, what it costs, and
// whether the boat's own chain from ping to thrust notices it: in one run the recorder is there for
// 10 s, and not there for 10 s, in turn. Then images that are all noise. Then it is killed at
// random moments: how much of the last seconds is not in the file. Prints three tables; status 1
// where a publication was missed, or more than a second lost.
//   measure_recorder [SECONDS [KILLS]]
// SECONDS: of each row, recorded and not.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/recording.h"
#include "tests/system/boat.h"

namespace lodesman::measure {
namespace {

using namespace lodesman::testing;

constexpr Duration kTurn = seconds{10};
constexpr Duration kPingPeriod = milliseconds{100};
constexpr double kMayBeLost_s = 1.0;
constexpr int kEnoughKills = 10;

struct Pings {
  std::uint32_t beams;
  std::uint32_t bins;
};

// Hours away, among a few obstacles that a sonar hears.
[[nodiscard]] std::string voyage(const Pings& pings) {
  return scenario_text(1900.0, 10'000.0) +
         fmt::format(
             "[[obstacle]]\nshape = \"circle\"\ncentre_m = [1.0, 15.0]\nradius_m = "
             "0.5\nprotection_m = 2.0\n"
             "[[obstacle]]\nshape = \"circle\"\ncentre_m = [-2.0, 40.0]\nradius_m = "
             "0.7\nprotection_m = 2.0\n"
             "[sonar]\nscene = \"beams\"\nbeams = {}\nbins = {}\n"
             "ping_hz = 10.0\n",
             pings.beams, pings.bins);
}

// Of this process and its threads so far.
[[nodiscard]] double processor_s(pid_t pid) {
  std::string text;
  std::getline(std::ifstream{"/proc/" + std::to_string(pid) + "/stat"}, text);
  std::istringstream fields{text.substr(text.rfind(')') + 1)};
  std::string skipped;
  for (int i = 0; i < 11; ++i) {
    fields >> skipped;
  }
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// The most that was ever resident.
[[nodiscard]] double peak_MB(pid_t pid) {
  std::ifstream status{"/proc/" + std::to_string(pid) + "/status"};
  for (std::string word; status >> word;) {
    if (word == "VmHWM:") {
      double kilobytes = 0.0;
      status >> kilobytes;
      return 1.024e-3 * kilobytes;
    }
  }
  return 0.0;
}

struct Recorded {
  std::uint64_t publications = 0;
  std::uint64_t missed = 0;
  std::uint64_t bytes = 0;
  Time newest{};  // of the AHRS, which speaks most often

  void add(const Recorded& other) {
    publications += other.publications;
    missed += other.missed;
    bytes += other.bytes;
  }
};

[[nodiscard]] Recorded look_into(const fs::path& file) {
  McapFileSource source{file};
  McapReader reader{source};
  Recorded recorded;
  std::map<std::uint16_t, std::uint32_t> last;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item != McapItem::kMessage) {
      continue;
    }
    const McapMessage& message = reader.message();
    const std::string& topic = reader.channel_by_id(message.channel)->topic;
    if (!topic.starts_with(kRawTopics)) {
      recorded.missed += topic == kGapsTopic ? 1U : 0U;
      continue;
    }
    const auto before = last.find(message.channel);
    recorded.missed += before == last.end() ? 0U : message.sequence - before->second - 1U;
    last[message.channel] = message.sequence;
    ++recorded.publications;
    if (topic == std::string{kRawTopics} + "attitude") {
      recorded.newest = Time{Duration{static_cast<std::int64_t>(message.publish_time_ns)}};
    }
  }
  recorded.bytes = source.size_bytes();
  return recorded;
}

// From the capture of what a plan was made from to the thrust that first follows it.
class PingToThrust {
 public:
  explicit PingToThrust(const SharedBlackboard& board) : thrust_{board->thrust_applied} {}

  void poll(std::vector<double>& ms) {
    while (const auto* applied = thrust_.next()) {
      const ThrustApplied& thrust = applied->value;
      if (thrust.reason == ThrustReason::kCommanded && thrust.plan_id > followed_) {
        followed_ = thrust.plan_id;
        ms.push_back(1e3 * to_seconds(applied->stamp - thrust.plan_captured));
      }
    }
  }

 private:
  Reader<ThrustApplied> thrust_;
  std::uint64_t followed_ = 0;
};

[[nodiscard]] double percentile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

[[nodiscard]] std::unique_ptr<ChildProcess> start_recorder(const Boat& boat, const fs::path& file) {
  auto arguments = boat.arguments;
  arguments.insert(arguments.end(), {"--out", file.string()});
  return std::make_unique<ChildProcess>("lodesman-recorder", arguments);
}

struct Row {
  Recorded recorded;
  double recorded_s = 0.0;
  double processor_s = 0.0;
  double peak_MB = 0.0;
  std::vector<double> with_ms;
  std::vector<double> without_ms;
};

void wait(Duration span, PingToThrust& chain, std::vector<double>& ms) {
  const SteadyClock clock;
  const Time until = clock.now() + span;
  while (clock.now() < until) {
    std::this_thread::sleep_for(milliseconds{5});
    chain.poll(ms);
  }
}

[[nodiscard]] Row measure(const Pings& pings, Duration span) {
  const Scratch scratch{"measure-recorder"};
  const Boat boat{scratch, "default", voyage(pings)};
  const auto board = SharedBlackboard::observe(boat.segment, seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  if (!eventually([&] { return drives(thrust.latest()); })) {
    throw std::runtime_error("the boat does not sail");
  }
  PingToThrust chain{board};
  Row row;
  std::vector<double> begin;
  chain.poll(begin);
  int turn = 0;
  for (Duration done{}; done < span; done += kTurn) {
    wait(kTurn, chain, row.without_ms);
    const fs::path file = scratch.file(std::to_string(++turn) + ".mcap");
    auto recorder = start_recorder(boat, file);
    wait(kTurn, chain, row.with_ms);
    row.processor_s += processor_s(recorder->pid());
    row.peak_MB = std::max(row.peak_MB, peak_MB(recorder->pid()));
    row.recorded_s += to_seconds(kTurn);
    recorder->stop(seconds{20});
    row.recorded.add(look_into(file));
    fs::remove(file);
  }
  return row;
}

void print(const Pings& pings, const Row& row) {
  fmt::print(
      "| {} x {} | {:.0f} | {} | {} | {:.1f} % | {:.0f} | {:.2f} | {}: {:.1f}, {:.1f} | {}: "
      "{:.1f}, "
      "{:.1f} |\n",
      pings.beams, pings.bins, row.recorded_s, row.recorded.publications, row.recorded.missed,
      100.0 * row.processor_s / row.recorded_s, row.peak_MB,
      1e-6 * static_cast<double>(row.recorded.bytes) / row.recorded_s, row.without_ms.size(),
      percentile(row.without_ms, 0.5), percentile(row.without_ms, 0.99), row.with_ms.size(),
      percentile(row.with_ms, 0.5), percentile(row.with_ms, 0.99));
}

// What is simulated is nearly all silence, which takes no room; real echoes may be all noise.
// Nobody sails here: this program is the sonar.
[[nodiscard]] std::uint64_t record_noise(const Pings& pings, Duration span) {
  const Scratch scratch{"measure-recorder"};
  const std::string segment = "lodesman-measure-" + std::to_string(getpid());
  SharedBlackboard board = SharedBlackboard::create(segment);
  auto sonar = writer_of(board.writable(), board.writable().sonar_ping, Role::kLow);
  const auto ping = std::make_unique<SonarPing>();
  ping->range_m = 30.0;
  ping->make_image(pings.beams, pings.bins, 2.0);
  std::mt19937_64 random{1};
  const fs::path file = scratch.file("noise.mcap");
  ChildProcess recorder{"lodesman-recorder", {"--segment", segment, "--out", file.string()}};
  const SteadyClock clock;
  const Time begun = clock.now() + seconds{2};  // by then the recorder looks
  for (Time due = begun; due < begun + span; due += kPingPeriod) {
    std::this_thread::sleep_for(due - clock.now());
    ++ping->number;
    std::generate_n(ping->echo.begin(), ping->echo_count,
                    [&] { return static_cast<std::uint8_t>(random()); });
    sonar.publish(*ping, clock.now());
  }
  const double spent_s = processor_s(recorder.pid());
  const double memory_MB = peak_MB(recorder.pid());
  recorder.stop(seconds{20});
  const Recorded recorded = look_into(file);
  const std::uint64_t missed = sonar.sequence() - recorded.publications;
  fmt::print("| {} x {} | {:.0f} | {} | {} | {:.1f} % | {:.0f} | {:.2f} |\n", pings.beams,
             pings.bins, to_seconds(span), recorded.publications, missed,
             100.0 * spent_s / to_seconds(span), memory_MB,
             1e-6 * static_cast<double>(recorded.bytes) / to_seconds(span));
  return missed;
}

// How old what is missing at the end of a file is at most, when its recorder was killed.
[[nodiscard]] double kill_some(int kills) {
  const Scratch scratch{"measure-recorder"};
  const Boat boat{scratch, "default", voyage({120, 500})};
  const auto board = SharedBlackboard::observe(boat.segment, seconds{20});
  Reader<Attitude> attitude{board->attitude};
  std::mt19937_64 random{7};
  std::vector<double> lost_s;
  for (int i = 0; i < kills; ++i) {
    const fs::path file = scratch.file("kill-" + std::to_string(i) + ".mcap");
    auto recorder = start_recorder(boat, file);
    std::this_thread::sleep_for(milliseconds{2000 + random() % 2000});
    const Time newest = await_first(attitude).stamp;
    kill(recorder->pid(), SIGKILL);
    recorder->stop(seconds{5});
    lost_s.push_back(to_seconds(newest - look_into(DiskFile::part_of(file)).newest));
  }
  fmt::print("\n| killed at random | lost, median s | lost, worst s |\n|---|---|---|\n");
  fmt::print("| {} times | {:.2f} | {:.2f} |\n", kills, percentile(lost_s, 0.5),
             percentile(lost_s, 1.0));
  return percentile(lost_s, 1.0);
}

[[nodiscard]] int run(Duration span, int kills) {
  fmt::print(
      "| pings at 10 Hz | recorded s | publications | missed | of a core | peak memory MB | disk "
      "MB/s "
      "| ping to thrust without: number, p50, p99 ms | with "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  std::uint64_t missed = 0;
  for (const Pings& pings : {Pings{120, 500}, Pings{512, 1000}}) {
    const Row row = measure(pings, span);
    print(pings, row);
    missed += row.recorded.missed;
  }
  fmt::print(
      "\n| pings of noise at 10 Hz | s | pings | missed | of a core | peak memory MB | disk MB/s "
      "|\n"
      "|---|---|---|---|---|---|---|\n");
  for (const Pings& pings : {Pings{120, 500}, Pings{512, 1000}}) {
    missed += record_noise(pings, span);
  }
  // A few kills on a machine that tests at the same time say little of the worst.
  const bool is_kept = kill_some(kills) <= kMayBeLost_s || kills < kEnoughKills;
  return missed == 0 && is_kept ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace lodesman::measure

int main(int argc, char** argv) {
  const int span_s = argc > 1 ? std::atoi(argv[1]) : 300;
  const int kills = argc > 2 ? std::atoi(argv[2]) : std::clamp(span_s / 6, 2, 50);
  try {
    return lodesman::measure::run(std::chrono::seconds{span_s}, kills);
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_recorder: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
