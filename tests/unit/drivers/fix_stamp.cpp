// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/fix_stamp.h"

#include <algorithm>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Verdict = FixStamp::Verdict;

constexpr Time kBegin{seconds{1000}};

TEST_CASE("fix stamp: a fix is stamped by the earliest arrival, carried on by its time",
          "[drivers]") {
  FixStamp stamp;
  CHECK(stamp.judge(seconds{10}, kBegin + milliseconds{100}).measured ==
        kBegin + milliseconds{100});
  // One that comes early shows that the first one was late.
  CHECK(stamp.judge(seconds{11}, kBegin + seconds{1}).measured == kBegin + seconds{1});
  const auto late = stamp.judge(seconds{12}, kBegin + seconds{2} + milliseconds{300});
  CHECK(late.verdict == Verdict::kNew);
  CHECK(late.measured - (kBegin + seconds{2}) == std::chrono::microseconds{100});  // for drift
}

TEST_CASE("fix stamp: a burst of what was held back keeps its own times", "[drivers]") {
  FixStamp stamp;
  CHECK(stamp.judge(seconds{10}, kBegin).verdict == Verdict::kNew);
  const Time at_once = kBegin + seconds{10};
  for (int i = 1; i <= 10; ++i) {
    const auto judged = stamp.judge(seconds{10 + i}, at_once);
    CHECK(judged.verdict == Verdict::kNew);
    CHECK(judged.measured < kBegin + seconds{i} + milliseconds{2});
    CHECK(judged.measured >= kBegin + seconds{i});
  }
}

TEST_CASE("fix stamp: the same time again is the same fix, an earlier one is old", "[drivers]") {
  FixStamp stamp;
  CHECK(stamp.judge(seconds{10}, kBegin).verdict == Verdict::kNew);
  CHECK(stamp.judge(seconds{10}, kBegin + seconds{1}).verdict == Verdict::kSame);
  CHECK(stamp.judge(seconds{9}, kBegin + seconds{2}).verdict == Verdict::kOld);
  CHECK(stamp.judge(seconds{9}, kBegin + seconds{3}).verdict == Verdict::kOld);
  CHECK(stamp.judge(seconds{9}, kBegin + seconds{4}).verdict == Verdict::kOld);
  CHECK(stamp.judge(seconds{11}, kBegin + seconds{5}).verdict == Verdict::kNew);
}

TEST_CASE("fix stamp: three that follow from each other are believed, whatever was before",
          "[drivers]") {
  FixStamp stamp;
  CHECK(stamp.judge(hours{5}, kBegin).verdict == Verdict::kNew);
  CHECK(stamp.judge(seconds{9}, kBegin + seconds{1}).verdict == Verdict::kOld);
  CHECK(stamp.judge(seconds{10}, kBegin + seconds{2}).verdict == Verdict::kOld);
  const auto third = stamp.judge(seconds{11}, kBegin + seconds{3});
  CHECK(third.verdict == Verdict::kNew);
  CHECK(third.measured == kBegin + seconds{3});
  CHECK(stamp.judge(seconds{12}, kBegin + seconds{4}).verdict == Verdict::kNew);
}

TEST_CASE("fix stamp: midnight is one second after the one before", "[drivers]") {
  FixStamp stamp;
  CHECK(stamp.judge(hours{24} - seconds{1}, kBegin).verdict == Verdict::kNew);
  const auto midnight = stamp.judge(seconds{0}, kBegin + seconds{1});
  CHECK(midnight.verdict == Verdict::kNew);
  CHECK(midnight.measured == kBegin + seconds{1});
  CHECK(FixStamp::step_between(hours{23}, hours{1}) == hours{2});
  CHECK(FixStamp::step_between(hours{1}, hours{23}) == hours{-2});
}

TEST_CASE("fix stamp: a receiver that skips a second of its own is not taken to be late for ever",
          "[drivers]") {
  FixStamp stamp;
  CHECK(stamp.judge(seconds{10}, kBegin).verdict == Verdict::kNew);
  Time newest{};
  for (int i = 1; i <= 20; ++i) {
    // From the third on its time is a second less than it would be.
    const int told = i < 3 ? i : i - 1;
    newest = std::max(newest, stamp.judge(seconds{10 + told}, kBegin + seconds{i}).measured);
  }
  CHECK(kBegin + seconds{20} - newest < milliseconds{10});
}

}  // namespace
}  // namespace lodesman
