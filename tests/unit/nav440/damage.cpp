// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/nav440/damage.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "drivers/nav440/plausibility.h"
#include "mid_level/base/heading.h"
#include "mid_level/base/random_stream.h"
#include "tests/support/catch.h"
#include "tests/unit/nav440/support.h"

namespace lodesman::testing {
namespace {

using nav440::HeadingPacket;
using nav440::Plausibility;

constexpr std::int64_t kPeriod_ms = 20;
constexpr double kPeriod_s = 0.02;
constexpr Time kBegins{std::chrono::seconds{100}};

void put(ByteList& payload, std::size_t at, std::int64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) {
    payload[at + i] = static_cast<std::uint8_t>((value >> (8 * (bytes - 1 - i))) & 0xFF);
  }
}

// The n-th, as its unit sends it.
[[nodiscard]] ByteList payload_of(nav440::PacketType type, std::uint64_t n) {
  const double t_s = kPeriod_s * static_cast<double>(n);
  const double yaw_deg = std::remainder(150.0 + 60.0 * std::sin(0.5 * t_s), 360.0);
  const double rate_deg_s = 30.0 * std::cos(0.5 * t_s);
  ByteList payload(type == nav440::kA1 ? 32 : 42, 0);
  const auto flicker = static_cast<std::int64_t>(n * 2654435761U >> 7U) % 5 - 2;
  put(payload, 0, flicker, 2);
  put(payload, 4, std::lround(yaw_deg / 360.0 * 65536.0), 2);
  put(payload, 10, std::lround(rate_deg_s / 1260.0 * 65536.0), 2);
  put(payload, 16, -3277 + flicker, 2);
  put(payload, nav440::time_field(type).at, static_cast<std::int64_t>(n) * kPeriod_ms, 4);
  return payload;
}

// Which byte is hit next: the gaps between hits of independent bytes.
class Hits {
 public:
  explicit Hits(double share) : chance_{"nav440 damage", 1}, scale_{1.0 / std::log1p(-share)} {
    next_ = gap();
  }
  // Whether any was.
  [[nodiscard]] bool hit(ByteList& bytes) {
    bool any = false;
    for (; next_ < bytes.size(); next_ += 1 + gap()) {
      const auto value = static_cast<std::uint8_t>(chance_.uniform() * 256.0);
      any = any || value != bytes[next_];
      bytes[next_] = value;
    }
    next_ -= bytes.size();
    return any;
  }

 private:
  [[nodiscard]] std::uint64_t gap() {
    return static_cast<std::uint64_t>(std::log(chance_.uniform()) * scale_);
  }
  RandomStream chance_;
  double scale_;
  std::uint64_t next_ = 0;
};

class DamagedStream {
 public:
  DamagedStream(nav440::PacketType type, double share) : type_{type}, hits_{share} {}

  void send_next() {
    const std::string letters{static_cast<char>(type_ >> 8U), static_cast<char>(type_ & 0xFFU)};
    ByteList frame{0x55, 0x55};
    const ByteList payload = payload_of(type_, counts_.frames);
    frame.push_back(static_cast<std::uint8_t>(letters[0]));
    frame.push_back(static_cast<std::uint8_t>(letters[1]));
    frame.push_back(static_cast<std::uint8_t>(payload.size()));
    append(frame, payload);
    const std::uint16_t crc = nav440_crc(std::span{frame}.subspan(2));
    frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
    frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    counts_.untouched += hits_.hit(frame) ? 0U : 1U;
    ++counts_.frames;
    sent_ += frame.size();
    counts_.lost_bytes += frame.size() - framing_.push(frame);
    while (const auto found = framing_.next()) {
      take(*found, frame.size());
    }
  }
  [[nodiscard]] const DamageCounts& counts() const { return counts_; }

 private:
  void take(const Nav440Frame& found, std::size_t frame_size) {
    if (found.type != type_) {
      return;
    }
    const std::uint64_t began = sent_ - framing_.pending() - frame_size;
    const std::uint64_t n = began / frame_size;
    const ByteList payload{found.payload.begin(), found.payload.end()};
    const ByteList as_sent = payload_of(type_, n);
    const bool right = began % frame_size == 0 && payload == as_sent;
    const HeadingPacket packet = *nav440::heading_packet(type_, payload);
    const HeadingPacket truth = *nav440::heading_packet(type_, as_sent);
    const double off_rad = std::abs(wrap_to_pi(packet.angles.yaw_rad - truth.angles.yaw_rad));
    counts_.crc_right += right ? 1U : 0U;
    counts_.crc_wrong += right ? 0U : 1U;
    counts_.crc_wrong_yaw += !right && off_rad > 0.0 ? 1U : 0U;
    const auto at = [](std::uint64_t i) {
      return kBegins + std::chrono::milliseconds{kPeriod_ms} * static_cast<std::int64_t>(i);
    };
    const auto judged = plausibility_.judge(packet, at(counts_.frames - 1));
    if (judged.verdict != Plausibility::Verdict::kBelieved) {
      return;
    }
    counts_.recovered += right ? 1U : 0U;
    counts_.both_wrong += right ? 0U : 1U;
    const double rate_off_rad_s = std::abs(packet.rate_rad_s[2] - truth.rate_rad_s[2]);
    const double longest_s = to_seconds(Plausibility::kLongestStep);
    const bool used_wrong = off_rad > Plausibility::yaw_bound_rad(longest_s) ||
                            rate_off_rad_s > Plausibility::rate_bound_rad_s(longest_s) ||
                            judged.measured < at(n) - std::chrono::milliseconds{1};
    counts_.worst_off_deg = std::max(counts_.worst_off_deg, to_deg(off_rad));
    counts_.used_wrong += used_wrong ? 1U : 0U;
  }

  nav440::PacketType type_;
  Hits hits_;
  Nav440Framing framing_;
  Plausibility plausibility_{50};
  DamageCounts counts_;
  std::uint64_t sent_ = 0;  // bytes
};

// What would be recovered if every frame were that none of whose bytes is hit.
[[nodiscard]] double ceiling(nav440::PacketType type, double share) {
  return std::pow(1.0 - share, type == nav440::kA1 ? 39.0 : 49.0);
}

}  // namespace

DamageCounts damaged_stream(nav440::PacketType type, double share, std::uint64_t frames) {
  DamagedStream stream{type, share};
  for (std::uint64_t i = 0; i < frames; ++i) {
    stream.send_next();
  }
  return stream.counts();
}

TEST_CASE("nav440: H7: of damaged frames none passes both gates with another heading",
          "[nav440][plain]") {
  constexpr std::uint64_t kFrames = 1'000'000;
  for (const double share : {0.01, 0.1}) {
    const DamageCounts counts = damaged_stream(nav440::kA1, share, kFrames);
    INFO(share << ": CRC wrong " << counts.crc_wrong << ", both wrong " << counts.both_wrong);
    CHECK(counts.lost_bytes == 0);
    CHECK(counts.used_wrong == 0);
    CHECK(counts.crc_wrong <= 40);  // of 65536 damaged candidates one
    const auto part = [&](std::uint64_t of) {
      return static_cast<double>(of) / static_cast<double>(kFrames);
    };
    // Every frame that no byte of was changed is recovered, but for those that a gate needs to
    // begin.
    CHECK(part(counts.untouched) > 0.99 * ceiling(nav440::kA1, share));
    CHECK(counts.crc_right == counts.untouched);
    // At one byte in a hundred nearly all of them are near enough to the one before to be believed.
    CHECK((share > 0.05 || part(counts.recovered) > 0.999 * part(counts.untouched)));
    CHECK(counts.worst_off_deg < 1.5);
  }
}

// The gates are what refuses them: without damage nothing is, and with a CRC that holds some must
// be.
TEST_CASE("nav440: H7: what a CRC lets pass is there to be refused", "[nav440]") {
  const DamageCounts none = damaged_stream(nav440::kN1, 1e-12, 10'000);
  CHECK(none.recovered == 10'000 - (Plausibility::kConsistent - 1));
  CHECK(none.crc_wrong == 0);
  const DamageCounts much = damaged_stream(nav440::kA1, 0.1, 1'000'000);
  CHECK(much.crc_wrong > 0);
  CHECK(much.both_wrong < much.crc_wrong);
  CHECK(much.used_wrong == 0);
}

// A row of a table for each share, of as many frames as LODESMAN_FRAMES says.
TEST_CASE("nav440: what damaged streams come to", "[.measure]") {
  const char* told = std::getenv("LODESMAN_FRAMES");
  const std::uint64_t frames = told != nullptr ? std::stoull(told) : 1'000'000;
  for (const nav440::PacketType type : {nav440::kA1, nav440::kN1}) {
    for (const double share : {0.01, 0.1}) {
      const DamageCounts counts = damaged_stream(type, share, frames);
      const auto of_all = [&](std::uint64_t count) {
        return 100.0 * static_cast<double>(count) / static_cast<double>(counts.frames);
      };
      std::printf(
          "| %s | %.0f %% | %llu | %.2f | %.2f | %.2f | %llu | %llu | %llu | %.2f | %llu |\n",
          type == nav440::kA1 ? "A1" : "N1", 100.0 * share,
          static_cast<unsigned long long>(counts.frames), 100.0 * ceiling(type, share),
          of_all(counts.crc_right), of_all(counts.recovered),
          static_cast<unsigned long long>(counts.crc_wrong),
          static_cast<unsigned long long>(counts.crc_wrong_yaw),
          static_cast<unsigned long long>(counts.both_wrong), counts.worst_off_deg,
          static_cast<unsigned long long>(counts.used_wrong));
      CHECK(counts.used_wrong == 0);
    }
  }
}

}  // namespace lodesman::testing
