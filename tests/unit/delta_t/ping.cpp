// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/ping.h"

#include <memory>

#include "mid_level/messages/sane.h"
#include "tests/support/catch.h"
#include "tests/support/delta_t_records.h"
#include "tests/unit/delta_t/vectors.h"

namespace lodesman::delta_t {
namespace {

using testing::ByteList;

[[nodiscard]] std::unique_ptr<SonarPing> ping_of(const ByteList& bytes,
                                                 BeamSign sign = BeamSign::kStarboard) {
  const Parsed parsed = parse_record(bytes);
  REQUIRE(parsed.refusal == Refusal::kNone);
  auto ping = std::make_unique<SonarPing>();
  fill_ping(parsed.record, sign, *ping);
  return ping;
}

TEST_CASE("delta t ping: an image arrives as it was sent, to the sample", "[drivers]") {
  const Header h = testing::usual_header(RecordKind::kImage, 1);
  const auto echo = [](std::uint32_t beam, std::uint32_t bin) {
    return static_cast<std::uint8_t>(beam * 31 + bin * 7);
  };
  const auto ping = ping_of(testing::image_record(h, echo));
  REQUIRE(sane(*ping));
  CHECK(ping->kind == PingKind::kImage);
  CHECK(ping->range_m == Approx(30.0));
  CHECK(to_deg(ping->sector_rad) == Approx(120.0));
  CHECK(to_deg(ping->bearing_rad(0)) == Approx(-59.5));
  CHECK(to_deg(ping->bearing_rad(119)) == Approx(59.5));
  bool same = true;
  for (std::uint32_t beam = 0; beam < 120; ++beam) {
    for (std::uint32_t bin = 0; bin < 500; ++bin) {
      same = same && ping->echo[beam * 500 + bin] == echo(beam, bin);
    }
  }
  CHECK(same);
}

TEST_CASE("delta t ping: bearings are the header's own, whatever its sector says", "[drivers]") {
  for (const double start_deg : {-59.5, -60.0, -44.75, 10.0}) {
    for (const double step_deg : {0.25, 0.5, 1.0}) {
      Header h = testing::usual_header(RecordKind::kImage, 1);
      h.sector_rad = to_rad(90.0);
      h.first_bearing_rad = to_rad(start_deg);
      h.beam_step_rad = to_rad(step_deg);
      const auto ping = ping_of(testing::usual_image(h));
      REQUIRE(sane(*ping));
      CHECK(to_deg(ping->bearing_rad(0)) == Approx(start_deg).margin(1e-9));
      CHECK(to_deg(ping->bearing_rad(119)) == Approx(start_deg + 119 * step_deg).margin(1e-9));
      CHECK(to_deg(ping->sector_rad) == Approx(120 * step_deg));
    }
  }
}

TEST_CASE("delta t ping: with the other sign left and right change places", "[drivers]") {
  Header h = testing::usual_header(RecordKind::kImage, 1);
  h.first_bearing_rad = to_rad(-20.0);  // 120 beams to 99 degrees
  const ByteList image = testing::usual_image(h);
  const auto starboard = ping_of(image);
  const auto port = ping_of(image, BeamSign::kPort);
  REQUIRE(sane(*port));
  CHECK(port->beam_step_rad > 0.0);
  CHECK(starboard->echo[30 * 500 + 100] == 200);
  CHECK(port->echo[89 * 500 + 100] == 200);
  CHECK(to_deg(starboard->bearing_rad(30)) == Approx(10.0));
  CHECK(to_deg(port->bearing_rad(89)) == Approx(-10.0));
  h.kind = RecordKind::kProfile;
  const auto profile = ping_of(testing::usual_profile(h), BeamSign::kPort);
  REQUIRE(sane(*profile));
  CHECK(profile->points[89].range_m == Approx(6.0));
  CHECK(profile->points[30].range_m == Approx(0.0).margin(1e-12));
}

TEST_CASE("delta t ping: a profile is a range a beam with its intensity", "[drivers]") {
  const auto ping = ping_of(testing::profile_vector());
  REQUIRE(sane(*ping));
  CHECK(ping->kind == PingKind::kProfile);
  CHECK(ping->point_count == 120);
  CHECK(ping->bins == 0);
  CHECK(ping->echo_count == 0);
  CHECK(ping->points[0].range_m == Approx(5.0));
  CHECK(ping->points[1].range_m == Approx(0.0).margin(1e-12));
  CHECK(ping->points[118].intensity == 118);
  const auto real = ping_of(testing::real_vector());
  REQUIRE(sane(*real));
  CHECK(real->beams == 480);
  CHECK(real->range_m == Approx(5.0 * 1480.0 / 1500.0));
}

TEST_CASE("delta t ping: the largest and fastest that a header may say is still sane",
          "[drivers]") {
  Header h = testing::usual_header(RecordKind::kProfile, 1);
  h.range_m = 300.0;
  h.resolution_m = 0.6;
  h.sound_speed = 1700.0;
  const auto ping = ping_of(testing::profile_record(
      h, [](std::uint32_t) { return 510U; }, [](std::uint32_t) { return 65535U; }));
  CHECK(ping->points[0].range_m > 340.0);
  CHECK(sane(*ping));
}

TEST_CASE("delta t order: numbers that follow are all taken", "[drivers]") {
  PingOrder order;
  CHECK(order.take(UINT32_MAX - 1) == 1U);
  CHECK(order.take(UINT32_MAX) == 2U);
  CHECK(order.take(0) == 3U);  // it wraps
  CHECK(order.take(1) == 4U);
  CHECK(order.counts().lost == 0);
}

TEST_CASE("delta t order: a repeated ping is used once, and a gap is counted", "[drivers]") {
  PingOrder order;
  CHECK(order.take(10) == 1U);
  CHECK_FALSE(order.take(10));
  CHECK_FALSE(order.take(10));
  CHECK(order.counts().repeated == 2);
  CHECK(order.take(13) == 4U);
  CHECK(order.counts().lost == 2);
  CHECK(order.take(1013) == 1004U);
  CHECK(order.counts().lost == 1001);
  CHECK(order.counts().restarts == 0);
}

TEST_CASE("delta t order: a ping that was overtaken is left out", "[drivers]") {
  PingOrder order;
  CHECK(order.take(10) == 1U);
  CHECK(order.take(12) == 3U);
  CHECK_FALSE(order.take(11));
  CHECK(order.take(13) == 4U);
  CHECK_FALSE(order.take(12));
  CHECK(order.take(14) == 5U);
  CHECK(order.counts().late == 2);
  CHECK(order.counts().restarts == 0);
}

TEST_CASE("delta t order: a numbering that begins anew is followed, near or far", "[drivers]") {
  PingOrder far;
  CHECK(far.take(5000) == 1U);
  CHECK(far.take(1) == 2U);
  CHECK(far.take(2) == 3U);
  CHECK(far.counts().restarts == 1);
  PingOrder near;
  CHECK(near.take(9) == 1U);
  CHECK_FALSE(near.take(1));  // it may have come late
  CHECK(near.take(2) == 2U);
  CHECK(near.take(3) == 3U);
  CHECK(near.counts().restarts == 1);
  CHECK(near.counts().late == 1);
  CHECK(near.counts().lost == 0);
}

TEST_CASE("delta t order: numbers that run backwards bring a ping now and then", "[drivers]") {
  PingOrder order;
  std::uint64_t last = 0;
  int taken = 0;
  for (std::uint32_t number = 1000; number > 0; --number) {
    if (const auto given = order.take(number)) {
      CHECK(*given > last);
      last = *given;
      ++taken;
    }
  }
  CHECK(taken > 40);
}

}  // namespace
}  // namespace lodesman::delta_t
