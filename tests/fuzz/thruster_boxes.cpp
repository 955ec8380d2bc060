// SPDX-License-Identifier: Apache-2.0
// The drivers of the thruster boxes, whose box answers as the input has it, and the decoders of
// what is said to such boxes. Each byte of the input is what happens in one step of 50 ms.
#include <cmath>
#include <cstdlib>

#include "deploy/operator/decode/maestro_lines.h"
#include "deploy/operator/decode/roboclaw_lines.h"
#include "drivers/hal/thrust_scale.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"
#include "tests/unit/maestro/scripted_box.h"
#include "tests/unit/roboclaw/scripted_box.h"

namespace lodesman::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kMaxSteps = 600;

class Script {
 public:
  explicit Script(std::string_view input) : input_{input.substr(0, kMaxSteps)} {}

  [[nodiscard]] bool over() const { return input_.empty(); }
  std::uint8_t next() {
    const auto byte = static_cast<std::uint8_t>(input_.empty() ? '\0' : input_.front());
    input_.remove_prefix(input_.empty() ? 0 : 1);
    return byte;
  }

 private:
  std::string_view input_;
};

// Which bits of a step's byte mean what.
enum StepBit : unsigned {
  kSwallowed = 1,  // no answer comes
  kDamaged = 2,    // its first byte is another; the next bytes of the input say which
  kForeign = 4,    // and some that belong to nothing come too
  kMoves = 8,      // what is commanded is not neutral
  kReplugged = 16,
  kReset = 32,
  kSlow = 64,   // two steps without a call
  kLate = 128,  // answers come late
};

// The command of one step, after which `bench.sent` and `bench.status` tell what became of it.
template <class Bench>
ThrustCommand run_step(Bench& bench, Script& script) {
  const unsigned what = script.next();
  const ThrustCommand command =
      (what & kMoves) != 0 ? ThrustCommand{script.next(), script.next()} : kNeutralThrust;
  const auto damage = static_cast<std::uint8_t>((what & kDamaged) != 0 ? script.next() : 0U);
  const auto alter = [what, damage](Bytes& reply) {
    reply[0] = static_cast<std::uint8_t>(reply[0] ^ damage);
    if ((what & kSwallowed) != 0) {
      reply.clear();
    }
    return (what & kLate) != 0 ? 120 : 0;
  };
  bench.damage = alter;
  for (unsigned n = (what & kForeign) != 0 ? script.next() % 8U : 0U; n > 0; --n) {
    bench.line->send(script.next(), bench.now + std::chrono::milliseconds{n});
  }
  if ((what & kReplugged) != 0) {
    bench.line->unplug();
    bench.line->plug();
  }
  if ((what & kReset) != 0) {
    bench.box.reset();
  }
  bench.step(command, (what & kSlow) != 0 ? 150 : 50);
  return command;
}

void require_sound_targets(const testing::MaestroBench& bench, const ThrustCommand& command) {
  const bool taken = bench.status == CommandStatus::kTaken;
  int targets = 0;
  for (std::size_t i = 0; i + 3 < bench.sent.size(); ++i) {
    if (bench.sent[i] != 0x84) {
      continue;
    }
    ++targets;
    const int pulse = bench.sent[i + 2] + 128 * bench.sent[i + 3];
    const double share = thrust_share(bench.sent[i + 1] == 0 ? command.left : command.right);
    const int wanted = taken ? 6000 + static_cast<int>(std::lround(1905 * share)) : 6000;
    require(std::abs(pulse - wanted) <= (taken ? 0 : 4),
            "a maestro is told what was not commanded");
  }
  require(!taken || targets == 2, "a command is called taken that was not sent");
}

void require_sound_duties(const testing::RoboClawBench& bench, const ThrustCommand& command) {
  const bool taken = bench.status == CommandStatus::kTaken;
  if (bench.sent.size() != 8) {
    require(bench.sent.size() <= 5, "a roboclaw is told more than one thing");
    return;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const int duty =
        static_cast<std::int16_t>(bench.sent[2 + 2 * side] << 8 | bench.sent[3 + 2 * side]);
    const double share = thrust_share(side == 0 ? command.left : command.right);
    require(duty == (taken ? static_cast<int>(std::lround(32767 * share)) : 0),
            "a roboclaw is told what was not commanded");
  }
}

void require_all_accounted(const DecodeCounts& counts, std::size_t bytes, std::uint64_t lines) {
  require(counts.packets == lines, "a packet is counted and not given");
  require(counts.skipped_bytes <= bytes && counts.refused <= counts.skipped_bytes &&
              (bytes == 0 || counts.packets + counts.skipped_bytes > 0),
          "bytes are lost");
}

}  // namespace

void maestro(std::string_view input) {
  testing::MaestroBench bench;
  for (Script script{input}; !script.over();) {
    const ThrustCommand command = run_step(bench, script);
    require_sound_targets(bench, command);
  }
}

void roboclaw(std::string_view input) {
  testing::RoboClawBench bench;
  for (Script script{input}; !script.over();) {
    const ThrustCommand command = run_step(bench, script);
    require_sound_duties(bench, command);
  }
}

void thruster_lines(std::string_view input) {
  const Bytes bytes{input.begin(), input.end()};
  std::uint64_t lines = 0;
  const auto count = [&lines](const nlohmann::ordered_json& json) {
    require(json.at("known").is_boolean() && json.at("type").is_string(), "a packet has no type");
    ++lines;
  };
  const DecodeCounts of_maestro = maestro_lines(bytes, count);
  require_all_accounted(of_maestro, bytes.size(), lines);
  lines = 0;
  const DecodeCounts of_roboclaw = roboclaw_lines(bytes, count);
  require_all_accounted(of_roboclaw, bytes.size(), lines);
}

}  // namespace lodesman::fuzz
