// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/speed_table.h"

#include <array>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {
constexpr std::array<SpeedPoint, 2> kPoints{{{10.0, 0.2}, {50.0, 0.8}}};
}

TEST_CASE("speed table: straight lines from rest through its points and beyond", "[base]") {
  const SpeedTable table{kPoints};
  CHECK(table.speed_m_s(0) == Approx(0.0).margin(0.0));
  CHECK(table.speed_m_s(5) == Approx(0.1));
  CHECK(table.speed_m_s(10) == Approx(0.2));
  CHECK(table.speed_m_s(30) == Approx(0.5));
  CHECK(table.speed_m_s(50) == Approx(0.8));
  CHECK(table.speed_m_s(100) == Approx(1.6));
  for (int surge_ref = 1; surge_ref <= kMaxSurgeRef; ++surge_ref) {
    CHECK(table.speed_m_s(surge_ref) > table.speed_m_s(surge_ref - 1));
    CHECK(table.speed_m_s(-surge_ref) == Approx(-table.speed_m_s(surge_ref)));
  }
}

TEST_CASE("speed table: a speed is held by the nearest SurgeRef", "[base]") {
  const SpeedTable table{kPoints};
  for (int surge_ref = 1; surge_ref <= kMaxSurgeRef; ++surge_ref) {
    const HeldSpeed held = table.held(table.speed_m_s(surge_ref));
    CHECK(held.surge_ref == surge_ref);
    CHECK(held.speed_m_s == Approx(table.speed_m_s(surge_ref)));
  }
  CHECK(table.held(0.0).surge_ref == 1);
  CHECK(table.held_at_most(0.2).surge_ref == 10);
  CHECK(table.held_at_most(0.1999).surge_ref == 9);
  CHECK(table.held_at_most(0.0).surge_ref == 1);
  CHECK(table.held_at_most(99.0).surge_ref == kMaxSurgeRef);
  CHECK(table.held(99.0).surge_ref == kMaxSurgeRef);
}

TEST_CASE("speed table: the paper's is k times SurgeRef", "[base]") {
  const SpeedTable table = SpeedTable::proportional(0.0131);
  for (const int surge_ref : {-100, -7, 0, 16, 91, 100}) {
    CHECK(table.speed_m_s(surge_ref) == Approx(0.0131 * surge_ref));
  }
}
