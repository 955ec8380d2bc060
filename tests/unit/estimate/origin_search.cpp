// SPDX-License-Identifier: Apache-2.0
#include "high_level/estimate/origin_search.h"

#include "tests/support/catch.h"

namespace lodesman {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr OriginSearchOptions kOptions{10.0, 5.0};
constexpr double kMetre_deg = 1.0 / 110946.0;  // of latitude at 35 degrees

// A second after the one before.
struct Fixes {
  [[nodiscard]] bool take(double north_m, double sigma_m = 2.0, Duration step = seconds{1}) {
    now += step;
    return search.take({now, 35.0 + north_m * kMetre_deg, 139.0, sigma_m});
  }
  OriginSearch search{kOptions};
  Time now{seconds{100}};
};

TEST_CASE("origin search: the third good fix in a row is the one", "[high_level][estimate]") {
  Fixes fixes;
  CHECK_FALSE(fixes.take(0.0));
  CHECK_FALSE(fixes.take(3.0));
  CHECK(fixes.take(-2.0));
}

TEST_CASE("origin search: one that is far off begins a row of its own", "[high_level][estimate]") {
  Fixes fixes;
  CHECK_FALSE(fixes.take(400.0));
  CHECK_FALSE(fixes.take(400.0));
  CHECK_FALSE(fixes.take(0.0));
  CHECK_FALSE(fixes.take(1.0));
  CHECK(fixes.take(0.0));
}

TEST_CASE("origin search: one that is bad by its own word, or says what cannot be, ends the row",
          "[high_level][estimate]") {
  for (const double sigma_m : {10.1, 1e5}) {
    Fixes fixes;
    CHECK_FALSE(fixes.take(0.0));
    CHECK_FALSE(fixes.take(0.0));
    CHECK_FALSE(fixes.take(0.0, sigma_m));
    CHECK_FALSE(fixes.take(0.0));
  }
  Fixes polar;
  for (int i = 0; i < 10; ++i) {
    polar.now += seconds{1};
    CHECK_FALSE(polar.search.take({polar.now, 89.0, 0.0, 1.0}));
    CHECK_FALSE(polar.search.take({polar.now, 35.0, 400.0, 1.0}));
  }
}

TEST_CASE("origin search: a receiver that does not say has the sigma that is set for it",
          "[high_level][estimate]") {
  Fixes fixes;
  CHECK_FALSE(fixes.take(0.0, 0.0));
  CHECK_FALSE(fixes.take(15.0, 0.0));
  CHECK(fixes.take(0.0, 0.0));
  OriginSearch strict{{4.0, 5.0}};
  for (int i = 0; i < 10; ++i) {
    CHECK_FALSE(strict.take({Time{seconds{100 + i}}, 35.0, 139.0, 0.0}));
  }
}

TEST_CASE("origin search: fixes too far apart in time are no row, and one time counts once",
          "[high_level][estimate]") {
  Fixes fixes;
  CHECK_FALSE(fixes.take(0.0));
  CHECK_FALSE(fixes.take(0.0, 2.0, seconds{4}));
  CHECK_FALSE(fixes.take(0.0, 2.0, seconds{4}));
  CHECK_FALSE(fixes.take(0.0, 2.0, milliseconds{200}));
  CHECK_FALSE(fixes.take(0.0, 2.0, milliseconds{0}));
  CHECK_FALSE(fixes.take(0.0, 2.0, milliseconds{-100}));
  CHECK(fixes.take(0.0, 2.0, milliseconds{400}));
}

}  // namespace
}  // namespace lodesman
