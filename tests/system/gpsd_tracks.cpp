// SPDX-License-Identifier: Apache-2.0
// Recorded tracks through the gpsd that Debian ships, its driver, the position task and the
// estimator, which fixes the world's origin by them: played by gpsfake, and, where gpsd or its
// receiver is to go under way, at their own times into a pty. Where gpsd, gpsfake or the recordings
// are missing these tests are skipped.
#include <algorithm>
#include <limits>

#include "tests/support/pty_device.h"
#include "tests/system/gpsd_chain.h"
#include "tests/system/gpsd_program.h"
#include "tests/system/program.h"
#include "tests/system/recorded_track.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

// Where the track was at a second of the day.
[[nodiscard]] std::optional<WorldPoint> place_at(const std::vector<Epoch>& track, double second_s,
                                                 const LocalFrame& frame) {
  for (std::size_t i = 1; i < track.size(); ++i) {
    if (second_s >= track[i - 1].second_s && second_s <= track[i].second_s) {
      const double share =
          (second_s - track[i - 1].second_s) / (track[i].second_s - track[i - 1].second_s);
      const Eigen::Vector2d from = frame.to_world(track[i - 1].place).xy_m;
      return WorldPoint{from + share * (frame.to_world(track[i].place).xy_m - from)};
    }
  }
  return std::nullopt;
}

// Which of the track's epochs a fix is, after one; its size where it is none.
[[nodiscard]] std::size_t epoch_of(const std::vector<Epoch>& track, const PositionFix& fix,
                                   std::size_t after) {
  std::size_t i = after;
  while (i < track.size() &&
         rough_distance_m(track[i].place, {fix.latitude_deg, fix.longitude_deg}) > 0.02) {
    ++i;
  }
  return i;
}

// gpsfake with its gpsd, which end with it.
class Player {
 public:
  Player(const fs::path& gpsfake, const std::vector<Epoch>& track, double cycle_s) {
    std::string text;
    for (const Epoch& epoch : track) {
      text += epoch.sentences;
    }
    const fs::path log = scratch_.file("track.log", text);
    gpsfake_.emplace(gpsfake,
                     std::vector<std::string>{"-1", "-q", "-P", port, "-c", std::to_string(cycle_s),
                                              log.string()},
                     [] { setpgid(0, 0); });
  }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;
  ~Player() { kill(-gpsfake_->pid(), SIGKILL); }

  [[nodiscard]] bool ended() { return gpsfake_->ended().has_value(); }

  std::string port = free_tcp_port();

 private:
  Scratch scratch_{"gpsfake"};
  std::optional<Program> gpsfake_;
};

struct Recording {
  const char* name;
  std::vector<Epoch> track;
  double off_way_m;    // the most that the estimate may be off the way, root of the mean square
  double off_place_m;  // and off where the boat was on it
};

// From a point to the way through the epochs up to a few beyond one.
[[nodiscard]] double off_way_m(const std::vector<Epoch>& track, std::size_t at,
                               const Eigen::Vector2d& here_m, const LocalFrame& frame) {
  constexpr std::size_t kAround = 12;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = at > kAround ? at - kAround : 1; i < std::min(at + kAround, track.size());
       ++i) {
    const Eigen::Vector2d from = frame.to_world(track[i - 1].place).xy_m;
    const Eigen::Vector2d along = frame.to_world(track[i].place).xy_m - from;
    const double length_m2 = std::max(along.squaredNorm(), 1e-12);
    const double share = std::clamp((here_m - from).dot(along) / length_m2, 0.0, 1.0);
    least_m = std::min(least_m, (here_m - from - share * along).norm());
  }
  return least_m;
}

class Comparison {
 public:
  explicit Comparison(const std::vector<Epoch>& track) : track_{track} {}

  void look(Chain& chain) {
    for (; seen_ < chain.given.size(); ++seen_) {
      at_ = epoch_of(track_, chain.given[seen_], at_);
      INFO("fix " << seen_);
      REQUIRE(at_ < track_.size());  // nothing but what was recorded, in its order
    }
    if (seen_ < kSettled || !chain.estimates() || chain.estimate.valid_at == judged_) {
      return;
    }
    judged_ = chain.estimate.valid_at;
    const WorldOrigin origin = chain.origin().value();
    const LocalFrame frame{{origin.latitude_deg, origin.longitude_deg}};
    const double second_s = track_[at_].second_s + to_seconds(judged_ - chain.last.measured);
    if (const auto there = place_at(track_, second_s, frame)) {
      const Eigen::Vector2d here_m{chain.estimate.x_m, chain.estimate.y_m};
      place_m2_ += (here_m - there->xy_m).squaredNorm();
      const double way_m = off_way_m(track_, at_, here_m, frame);
      way_m2_ += way_m * way_m;
      ++count_;
    }
  }
  void judge(const Recording& recording, const char* player, const Chain& chain) const {
    const double way_m = std::sqrt(way_m2_ / count_);
    const double place_m = std::sqrt(place_m2_ / count_);
    std::cout << recording.name << " by " << player << ": " << chain.given.size() << " fixes of "
              << track_.size() << ", the estimate " << way_m << " m off the way, " << place_m
              << " m off the place (RMS of " << count_ << ")\n";
    CHECK(chain.given.size() > track_.size() * 2 / 3);  // gpsd may drop what comes apart
    CHECK(count_ > 50);
    CHECK(way_m < recording.off_way_m);
    CHECK(place_m < recording.off_place_m);
  }
  [[nodiscard]] bool is_at_end() const { return at_ + 1 >= track_.size(); }

 private:
  static constexpr std::size_t kSettled = 12;  // fixes before which nothing is counted

  const std::vector<Epoch>& track_;
  std::size_t seen_ = 0;
  std::size_t at_ = 0;
  Time judged_{};
  double place_m2_ = 0.0;
  double way_m2_ = 0.0;
  int count_ = 0;
};

// gpsd on a pty into which a track is said at its own times, again from its beginning to its end.
class Bench {
 public:
  Bench(fs::path program, std::vector<Epoch> track)
      : program_{std::move(program)}, track_{std::move(track)} {
    start();
  }

  void start() {
    gpsd_.emplace(program_, std::vector<std::string>{"-N", "-n", "-b", "-S", port_, pty_.node()});
  }
  void kill_gpsd() {
    kill(gpsd_->pid(), SIGKILL);
    REQUIRE(gpsd_->status() == 128 + SIGKILL);
  }
  void unplug() { pty_.hang_up(); }

  // Goes on until that holds; no longer than anybody should wait.
  [[nodiscard]] bool comes_to(const std::function<bool()>& holds) {
    const Time until = SteadyClock{}.now() + std::chrono::seconds{40};
    while (SteadyClock{}.now() < until) {
      speak();
      chain.step();
      if (holds()) {
        return true;
      }
      std::this_thread::sleep_for(milliseconds{2});
    }
    return false;
  }
  // Where the boat of the track is now.
  [[nodiscard]] double off_m() {
    const WorldOrigin origin = chain.origin().value();
    const LocalFrame frame{{origin.latitude_deg, origin.longitude_deg}};
    const double second_s = track_[0].second_s + to_seconds(SteadyClock{}.now() - began_);
    const auto there = place_at(track_, second_s, frame);
    REQUIRE(there);
    return (Eigen::Vector2d{chain.estimate.x_m, chain.estimate.y_m} - there->xy_m).norm();
  }

 private:
  std::string port_ = free_tcp_port();

 public:
  Chain chain{port_};

 private:
  void speak() {
    const Time now = SteadyClock{}.now();
    while (next_ < track_.size() &&
           now - began_ >= from_seconds(track_[next_].second_s - track_[0].second_s)) {
      const std::string& text = track_[next_++].sentences;
      const std::vector<std::uint8_t> bytes{text.begin(), text.end()};
      static_cast<void>(pty_.send(bytes));
      std::array<std::uint8_t, 256> ignored{};
      static_cast<void>(pty_.receive(ignored));
    }
  }

  fs::path program_;
  std::vector<Epoch> track_;
  PtyDevice pty_;
  std::optional<Program> gpsd_;
  Time began_ = SteadyClock{}.now();
  std::size_t next_ = 0;
};

// gpsfake has a rhythm of its own, to which the boat's speed does not fit: the estimate is judged
// loosely here, and closely where the track is said at its own times.
void play(const fs::path& gpsfake, const Recording& recording, double cycle_s) {
  INFO(recording.name);
  REQUIRE(recording.track.size() > 30);
  Player player{gpsfake, recording.track, cycle_s};
  Chain chain{player.port};
  Comparison comparison{recording.track};
  // gpsfake waits for a while after the last sentence, before it ends.
  const auto is_over = [&] {
    return comparison.is_at_end() || player.ended() ||
           (!chain.given.empty() &&
            SteadyClock{}.now() - chain.last.measured > std::chrono::seconds{10});
  };
  const Time until = SteadyClock{}.now() + std::chrono::seconds{150};
  while (!is_over() && SteadyClock{}.now() < until) {
    chain.step();
    comparison.look(chain);
    std::this_thread::sleep_for(milliseconds{2});
  }
  REQUIRE(chain.origin());
  CHECK(chain.origin()->source == OriginSource::kFirstFix);
  CHECK(rough_distance_m(recording.track[0].place,
                         {chain.origin()->latitude_deg, chain.origin()->longitude_deg}) < 10.0);
  comparison.judge(recording, "gpsfake", chain);
}

// At its own times.
void say(const fs::path& gpsd, const Recording& recording) {
  INFO(recording.name);
  Bench bench{gpsd, recording.track};
  Comparison comparison{recording.track};
  static_cast<void>(bench.comes_to([&] {
    comparison.look(bench.chain);
    return comparison.is_at_end();
  }));
  comparison.judge(recording, "its own times", bench.chain);
}

struct Recordings {
  std::optional<fs::path> rtk = data_path("nmea_usv_rtk/202412071309.txt");
  std::optional<fs::path> lake = data_path("asv_catabot/lake_china_20201006_slice.csv");
  std::optional<fs::path> walk = data_path("nmea_mixed/signalk/gps.log");
  [[nodiscard]] bool are_there() const { return rtk && lake && walk; }
};

TEST_CASE("gpsd tracks: what gpsfake plays of boats' own logs is what the estimate follows",
          "[system]") {
  const auto gpsfake = gpsfake_program();
  const Recordings at;
  if (!gpsfake || !gpsd_program() || !at.are_there()) {
    return;
  }
  SECTION("a small boat with RTK, 5 fixes a second") {
    play(*gpsfake, {"nmea_usv_rtk", nmea_epochs(*at.rtk, 100, 100), 3.0, 5.0}, 0.025);
  }
  SECTION("a lake boat, a fix a second") {
    play(*gpsfake, {"asv_catabot", catabot_epochs(*at.lake, 60, 32), 3.0, 5.0}, 0.47);
  }
  SECTION("a hand-held receiver, a fix a second, in fifths of a metre") {
    play(*gpsfake, {"nmea_mixed/signalk", nmea_epochs(*at.walk, 100, 32), 3.0, 5.0}, 0.225);
  }
}

TEST_CASE("gpsd tracks: said at their own times they are followed closely", "[system]") {
  const auto gpsd = gpsd_program();
  const Recordings at;
  if (!gpsd || !at.are_there()) {
    return;
  }
  SECTION("a small boat with RTK, 5 fixes a second") {
    say(*gpsd, {"nmea_usv_rtk", nmea_epochs(*at.rtk, 100, 125), 0.5, 1.0});
  }
  SECTION("a lake boat, a fix a second") {
    say(*gpsd, {"asv_catabot", catabot_epochs(*at.lake, 60, 32), 1.0, 1.5});
  }
  SECTION("a hand-held receiver, a fix a second, in fifths of a metre") {
    say(*gpsd, {"nmea_mixed/signalk", nmea_epochs(*at.walk, 100, 32), 2.0, 2.5});
  }
}

TEST_CASE(
    "gpsd tracks: gpsd dies and comes back under way, its receiver goes for good, and it is told",
    "[system]") {
  const auto program = gpsd_program();
  const auto rtk = Recordings{}.rtk;
  if (!program || !rtk) {
    return;
  }
  Bench bench{*program, nmea_epochs(*rtk, 100, 1000)};
  Chain& chain = bench.chain;
  const auto trust = [&] { return chain.status().value("position_trust", ""); };
  REQUIRE(bench.comes_to([&] { return chain.given.size() >= 30 && trust() == "tracked"; }));
  CHECK(chain.receiver()["status"] == "working");
  CHECK(chain.receiver()["fault"] == "wrong_date");  // the track is of 2024, and that is told too
  CHECK(bench.off_m() < 2.0);
  // gpsd dies: said at once, and the position goes on by the model.
  bench.kill_gpsd();
  REQUIRE(bench.comes_to([&] { return chain.receiver()["status"] == "disconnected"; }));
  REQUIRE(bench.comes_to([&] { return chain.receiver().value("fault", "") == "no_service"; }));
  CHECK(chain.receiver()["means"] == describe(DeviceFault::kNoService));
  REQUIRE(bench.comes_to([&] { return trust() == "bridged"; }));
  CHECK(chain.estimates());
  // It comes back: the next fix is believed, no step is seen but the correction of the gap.
  const std::size_t before = chain.given.size();
  bench.start();
  REQUIRE(
      bench.comes_to([&] { return chain.given.size() >= before + 10 && trust() == "tracked"; }));
  CHECK(chain.receiver()["status"] == "working");
  CHECK(bench.off_m() < 2.0);
  // The receiver is unplugged for good: bridged, then there is no position, and a start is refused.
  bench.unplug();
  REQUIRE(bench.comes_to([&] { return trust() == "bridged"; }));
  CHECK(chain.estimates());
  REQUIRE(bench.comes_to([&] {
    const std::string fault = chain.receiver().value("fault", "");
    return chain.receiver()["status"] == "silent" && (fault == "unplugged" || fault == "no_answer");
  }));
  REQUIRE(bench.comes_to([&] { return !chain.estimates(); }));
  CHECK(to_seconds(SteadyClock{}.now() - chain.last.measured) > 14.5);  // fix_gap_max_s
  CHECK(chain.status()["state_age_s"] > 0.4);
}

}  // namespace
}  // namespace lodesman::testing
