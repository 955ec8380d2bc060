// SPDX-License-Identifier: Apache-2.0
// The second gate by itself: what follows from what was believed, and what does not.
#include "drivers/nav440/plausibility.h"

#include "mid_level/base/heading.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using nav440::HeadingPacket;
using nav440::Plausibility;
using std::chrono::milliseconds;
using Verdict = Plausibility::Verdict;

constexpr Time kBegins{std::chrono::seconds{100}};
constexpr std::int64_t kPeriod_ms = 20;

// Of a unit that is level, in its own time.
[[nodiscard]] HeadingPacket packet_at(std::int64_t time_ms, double yaw_deg = 0.0,
                                      double rate_deg_s = 0.0) {
  HeadingPacket packet;
  packet.angles.yaw_rad = wrap_to_pi(to_rad(yaw_deg));
  packet.rate_rad_s[2] = to_rad(rate_deg_s);
  packet.time_ms = static_cast<std::uint32_t>(time_ms);
  packet.time_wraps_ms = nav440::kWeek_ms;
  return packet;
}

// Without any delay.
[[nodiscard]] Verdict judged(Plausibility& gate, const HeadingPacket& packet) {
  return gate.judge(packet, kBegins + milliseconds{packet.time_ms}).verdict;
}

// Up to the time it gives, heading 0, at rest.
[[nodiscard]] std::int64_t settle(Plausibility& gate) {
  std::int64_t time_ms = 0;
  for (int i = 0; i < 10; ++i) {
    time_ms += kPeriod_ms;
    static_cast<void>(judged(gate, packet_at(time_ms)));
  }
  return time_ms;
}

// Clocks of the satellites and of the unit round to and fro.
TEST_CASE("nav440 plausibility: a time that is off by its last millisecond is a sound one",
          "[nav440]") {
  for (const std::int64_t off_ms : {0, 1, 2}) {
    INFO("each second one off by " << off_ms << " ms");
    Plausibility gate{50};
    int believed = 0;
    for (int i = 0; i < 50; ++i) {
      const HeadingPacket packet = packet_at(i * kPeriod_ms + i % 2 * off_ms);
      const Time arrived = kBegins + milliseconds{i * kPeriod_ms};
      believed += gate.judge(packet, arrived).verdict == Verdict::kBelieved ? 1 : 0;
    }
    CHECK(believed == (off_ms <= 1 ? 50 - (Plausibility::kConsistent - 1) : 0));
  }
}

// F6: an adapter lets bytes go each 16 ms; nothing is known yet of how late the first packet is.
TEST_CASE("nav440 plausibility: F6: batches of an adapter cost nothing at the beginning either",
          "[nav440]") {
  constexpr std::int64_t kBatch_ms = 16;
  for (const int rate_hz : {20, 25, 50, 100}) {
    for (std::int64_t phase_ms = 0; phase_ms < kBatch_ms; ++phase_ms) {
      INFO(rate_hz << " Hz, " << phase_ms << " ms into a batch");
      Plausibility gate{rate_hz};
      for (int i = 0; i < 20; ++i) {
        const std::int64_t sent_ms = phase_ms + i * 1000 / rate_hz;
        const std::int64_t let_go_ms = (sent_ms + kBatch_ms - 1) / kBatch_ms * kBatch_ms;
        const Verdict verdict =
            gate.judge(packet_at(sent_ms), kBegins + milliseconds{let_go_ms}).verdict;
        CHECK((verdict == Verdict::kBelieved) == (i + 1 >= Plausibility::kConsistent));
      }
    }
  }
}

// Packets may be missing for a while; the boat goes on turning as boats do.
TEST_CASE(
    "nav440 plausibility: however long nothing came, no rate is believed that no boat gets to",
    "[nav440]") {
  for (const std::int64_t gap_ms : {140, 200, 280}) {
    for (const double rate_deg_s : {-80.0, -50.0, 50.0, 80.0}) {
      INFO(gap_ms << " ms, " << rate_deg_s << " deg/s");
      Plausibility gate{50};
      const std::int64_t time_ms = settle(gate) + gap_ms;
      const double gap_s = static_cast<double>(gap_ms) / 1000.0;
      // Its heading is where an even growth of that rate takes it.
      const Verdict verdict =
          judged(gate, packet_at(time_ms, 0.5 * gap_s * rate_deg_s, rate_deg_s));
      CHECK(verdict == (std::abs(rate_deg_s) < 60.0 ? Verdict::kBelieved : Verdict::kRefused));
    }
  }
}

}  // namespace
}  // namespace lodesman::testing
