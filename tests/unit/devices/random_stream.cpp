// SPDX-License-Identifier: Apache-2.0
#include "mid_level/base/random_stream.h"

#include <cmath>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

TEST_CASE("random stream: the same name and seed give the same numbers, others do not",
          "[hal_sim][random]") {
  RandomStream a{"position", 1};
  RandomStream b{"position", 1};
  RandomStream other_name{"sonar", 1};
  RandomStream other_seed{"position", 2};
  const double first = a.uniform();
  CHECK(first == Approx(b.uniform()).margin(0.0));
  CHECK(first != Approx(other_name.uniform()).margin(1e-12));
  CHECK(first != Approx(other_seed.uniform()).margin(1e-12));
}

TEST_CASE("random stream: uniform lies within (0, 1), gaussian has its moments",
          "[hal_sim][random]") {
  RandomStream stream{"test", 3};
  double sum = 0.0;
  double squares = 0.0;
  int within_one = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double u = stream.uniform();
    REQUIRE(u > 0.0);
    REQUIRE(u < 1.0);
    const double g = stream.gaussian();
    sum += g;
    squares += g * g;
    within_one += std::abs(g) < 1.0 ? 1 : 0;
  }
  CHECK(sum / kCount == Approx(0.0).margin(0.02));
  CHECK(squares / kCount == Approx(1.0).margin(0.02));
  CHECK(static_cast<double>(within_one) / kCount == Approx(0.6827).margin(0.01));
}

}  // namespace
}  // namespace lodesman
