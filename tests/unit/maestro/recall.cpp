// SPDX-License-Identifier: Apache-2.0
// A driver that comes after one that died, with what that had on record of the box.
#include <memory>

#include "drivers/maestro/maestro.h"
#include "tests/support/catch.h"
#include "tests/unit/maestro/scripted_box.h"

namespace lodesman {
namespace {

using testing::MaestroBench;
using State = Maestro::State;
using std::chrono::milliseconds;
using std::chrono::seconds;

// A line whose device has come up so often.
class NumberedLine final : public ByteStream {
 public:
  explicit NumberedLine(ByteStream& line) : line_{line} {}
  [[nodiscard]] std::uint64_t connection(Time now) noexcept override {
    return line_.connection(now);
  }
  [[nodiscard]] Received read(std::span<std::uint8_t> into, Time now) noexcept override {
    return line_.read(into, now);
  }
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes, Time now) noexcept override {
    return line_.write(bytes, now);
  }
  void reconnect(int baud) noexcept override { line_.reconnect(baud); }
  [[nodiscard]] std::uint64_t power_up() const noexcept override { return number; }
  [[nodiscard]] DeviceFault fault() const noexcept override { return line_.fault(); }

  std::uint64_t number = 7;

 private:
  ByteStream& line_;
};

// The box with a driver that drives it, dies, and has a successor.
struct Voyage {
  explicit Voyage(testing::MaestroBoxSettings settings = {}) : bench{settings} {
    REQUIRE(reach(State::kReady));
    for (int i = 0; i < 10; ++i) {
      step(testing::kAhead);
    }
    REQUIRE(bench.box.pulses[0] == testing::kAheadPulse);
  }
  CommandStatus step(ThrustCommand command = kNeutralThrust) {
    const CommandStatus status = driver->command(command, bench.now);
    last_command = bench.now;
    bench.pass(50);
    return status;
  }
  bool reach(State state) {
    for (int i = 0; i < 200; ++i) {
      (void)step();
      if (driver->state() == state) {
        return true;
      }
    }
    return false;
  }
  // The driver dies with its last command given; the next one comes so long after.
  void succeed(Duration after, const BoxProof& on_record) {
    const Time died = last_command;
    bench.pass(static_cast<int>(after / milliseconds{1}));
    driver = std::make_unique<Maestro>(line, MaestroOptions{}, ThrustShapeOptions{});
    driver->recall(on_record, died);
    began = bench.now;
  }
  [[nodiscard]] Duration until_ready() {
    REQUIRE(reach(State::kReady));
    return bench.now - began;
  }

  MaestroBench bench;
  NumberedLine line{bench.line->near_end()};
  std::unique_ptr<Maestro> driver =
      std::make_unique<Maestro>(line, MaestroOptions{}, ThrustShapeOptions{});
  Time last_command{};
  Time began{};
};

constexpr Duration kProof = milliseconds{750};  // a time-out and a half of silence
constexpr Duration kHold = seconds{2};

TEST_CASE("maestro recall: a box that stopped by itself again is not proved anew", "[maestro]") {
  for (const int after_ms : {10, 300, 2000}) {
    Voyage voyage;
    const BoxProof proof = voyage.driver->proof();
    CHECK(proof.power_up == 7);
    CHECK(proof.proved != Time{});
    voyage.succeed(milliseconds{after_ms}, proof);
    CHECK(voyage.until_ready() <= milliseconds{900});
    CHECK(voyage.bench.neutral());
    CHECK(voyage.driver->counts().recalls == 1);
    CHECK(voyage.driver->proof().proved == proof.proved);  // the record stands
    CHECK(voyage.step(testing::kAhead) == CommandStatus::kTaken);
    CHECK(voyage.bench.box.pulses[0] == testing::kAheadPulse);
  }
}

TEST_CASE("maestro recall: nothing is said before the box must have stopped", "[maestro]") {
  Voyage voyage;
  const int heard = voyage.bench.box.commands;
  voyage.succeed(milliseconds{20}, voyage.driver->proof());
  while (voyage.driver->state() != State::kConfirming) {
    CHECK(voyage.bench.box.commands == heard);
    (void)voyage.step(testing::kAhead);
  }
  CHECK(voyage.bench.neutral());
}

TEST_CASE("maestro recall: another power-up, or none that is known, is proved", "[maestro]") {
  for (const std::uint64_t number : {std::uint64_t{8}, std::uint64_t{0}}) {
    Voyage voyage;
    const BoxProof proof = voyage.driver->proof();
    voyage.line.number = number;
    voyage.succeed(milliseconds{1000}, proof);
    CHECK(voyage.until_ready() >= kProof + kHold);
    CHECK(voyage.driver->counts().recalls == 0);
  }
  Voyage unknown;
  unknown.line.number = 0;
  unknown.succeed(milliseconds{1000}, {unknown.driver->proof().proved, 0});
  CHECK(unknown.until_ready() >= kProof + kHold);
}

TEST_CASE("maestro recall: a box that does not tell of its time-out is proved, and may fail",
          "[maestro]") {
  Voyage cleared;  // somebody else has read the register
  const BoxProof proof = cleared.driver->proof();
  cleared.bench.pass(1000);
  cleared.bench.box.errors = 0;
  cleared.succeed(milliseconds{10}, proof);
  CHECK(cleared.until_ready() >= kProof + kHold);
  Voyage changed;  // somebody has switched it off
  const BoxProof old = changed.driver->proof();
  changed.bench.box.settings.time_out_ms = 0;
  changed.succeed(milliseconds{1000}, old);
  CHECK_FALSE(changed.reach(State::kReady));
  CHECK(changed.driver->fault() == DeviceFault::kNoTimeOut);
}

TEST_CASE("maestro recall: a lost connection and a fault end the proof", "[maestro]") {
  Voyage voyage;
  REQUIRE(voyage.driver->proof().proved != Time{});
  voyage.bench.line->unplug();
  (void)voyage.step();
  CHECK(voyage.driver->proof().proved == Time{});

  Voyage replugged;  // the record is good for the first connection alone
  replugged.succeed(milliseconds{1000}, replugged.driver->proof());
  (void)replugged.step();
  replugged.bench.line->unplug();
  (void)replugged.step();
  replugged.bench.line->plug();
  replugged.began = replugged.bench.now;
  CHECK(replugged.until_ready() >= kProof + kHold);
  CHECK(replugged.driver->counts().recalls == 0);
}

}  // namespace
}  // namespace lodesman
