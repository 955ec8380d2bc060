// SPDX-License-Identifier: Apache-2.0
// What stands on the blackboard may be anything: both levels in lock-step, with forgeries between
// their steps. LODESMAN_FORGERIES says how many; the suite makes few.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "deploy/boat/assembled_boat.h"
#include "deploy/boat/voyage.h"
#include "deploy/operator/run/watcher.h"
#include "mid_level/recording/recording_hash.h"
#include "mid_level/runtime/run_lockstep.h"
#include "tests/support/catch.h"
#include "tests/support/forgery.h"
#include "tests/support/self_start.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

[[nodiscard]] std::uint64_t forgeries_asked(std::uint64_t otherwise) {
  const char* text = std::getenv("LODESMAN_FORGERIES");  // NOLINT(concurrency-mt-unsafe)
  return text != nullptr ? std::stoull(text) : otherwise;
}

struct Applied {
  Time stamp;
  std::uint8_t left = 0;
  std::uint8_t right = 0;
  friend bool operator==(const Applied&, const Applied&) = default;
};

// Both levels on a board of their own, sailing.
class ForgedBoat {
 public:
  ForgedBoat(const std::string& profile, const std::string& scenario_name)
      : configuration_{load_configuration(profile, {})},
        scenario_{load_named_scenario(scenario_name, configuration_.speeds)},
        boat_{*board_, configuration_, &scenario_},
        high_{*board_, Role::kHigh,
              high_level_options(configuration_, voyage_of(configuration_, &scenario_))},
        self_start_{*board_, configuration_, scenario_, [this] { return clock_.now(); }},
        watcher_{*board_, scenario_, 0.5} {
    std::vector<TaskEntry> entries = boat_.tasks();
    for (const TaskEntry& entry : high_.tasks()) {
      entries.push_back(entry);
    }
    clock_.advance_to(Time{seconds{1}});
    runner_ = std::make_unique<LockstepRunner>(entries, clock_, *board_, LockstepOptions{});
  }

  [[nodiscard]] Blackboard& board() noexcept { return *board_; }
  void step() {
    runner_->step();
    self_start_.look();
    hash_.update();
    if (clock_.now() >= next_look_) {
      next_look_ = clock_.now() + milliseconds{100};
      watcher_.poll();
      static_cast<void>(watcher_.progress());
    }
    while (const auto* thrust = thrust_.next()) {
      applied_.push_back({thrust->stamp, thrust->value.left, thrust->value.right});
    }
  }
  [[nodiscard]] Time now() const noexcept { return clock_.now(); }
  [[nodiscard]] const std::vector<Applied>& applied() const noexcept { return applied_; }

 private:
  std::unique_ptr<Blackboard> board_ = std::make_unique<Blackboard>();
  BoatConfig configuration_;
  Scenario scenario_;
  SimClock clock_;
  AssembledBoat boat_;
  HighLevel high_;
  testing::SelfStart self_start_;
  cli::RunWatcher watcher_;
  RecordingHash hash_{*board_};
  Reader<ThrustApplied> thrust_{board_->thrust_applied};
  Time next_look_{};
  std::unique_ptr<LockstepRunner> runner_;
  std::vector<Applied> applied_;
};

// What the box was told in a minute, with a share of all publications spoilt.
[[nodiscard]] std::vector<Applied> sail_spoilt(const std::string& profile, Spoil kind,
                                               std::uint64_t seed, std::uint64_t one_in) {
  ForgedBoat boat{profile, "paper-moving"};
  PublicationSpoiler spoiler{kind, seed, one_in};
  while (boat.now() < Time{seconds{61}}) {
    boat.step();
    spoiler.follow(boat.board());
  }
  CHECK(spoiler.spoilt() > 20);
  return boat.applied();
}

// Those that hold what is not sane, beside a twin run in which they were never made.
void require_equal_twins(const std::string& profile) {
  for (const std::uint64_t one_in : {400ULL, 20ULL, 3ULL}) {
    for (const std::uint64_t seed : {1ULL, 2ULL}) {
      CAPTURE(profile, one_in, seed);
      const auto forged = sail_spoilt(profile, Spoil::kNotSane, seed, one_in);
      const auto absent = sail_spoilt(profile, Spoil::kAbsent, seed, one_in);
      CHECK(forged.size() > 100);
      const auto first =
          std::mismatch(forged.begin(), forged.end(), absent.begin(), absent.end()).first;
      INFO("they differ from " << (first == forged.end() ? 0.0 : to_seconds(first->stamp - Time{}))
                               << " s on");
      CHECK((forged == absent));
    }
  }
}

}  // namespace

TEST_CASE("forgeries: random bytes and heads crash no task and no onlooker", "[system]") {
  const std::uint64_t asked = forgeries_asked(20'000);
  constexpr std::uint64_t kEachBoat = 5'000;
  std::uint64_t made = 0;
  for (std::uint64_t seed = 1; made < asked; ++seed) {
    ForgedBoat boat{seed % 2 == 0 ? "default" : "paper",
                    seed % 3 == 0 ? "paper-multiple" : "paper-moving"};
    RandomForger forger{seed};
    while (boat.now() < Time{seconds{4}}) {
      boat.step();  // it is under way, and nobody has touched anything yet
    }
    for (std::uint64_t i = 0; i < kEachBoat; ++i, ++made) {
      forger.forge(boat.board());
      boat.step();
    }
    CHECK_FALSE(boat.applied().empty());
    if (asked > 100'000) {
      std::printf("\r%llu of %llu forgeries", static_cast<unsigned long long>(made),
                  static_cast<unsigned long long>(asked));
      std::fflush(stdout);
    }
  }
  CHECK(made >= asked);
}

TEST_CASE("forgeries: what is not sane leaves the commands as if it had not been published",
          "[system][plain]") {
  require_equal_twins("default");
}

TEST_CASE("forgeries: and so in the paper's profile", "[system][plain]") {
  require_equal_twins("paper");
}
