// SPDX-License-Identifier: Apache-2.0
// What is asked of every sensor alike. `poll_once(bench)` polls it and gives status and stamp; the
// rest is up to the suite of its contract. One thread.
#pragma once

#include <string>

#include "tests/conformance/bench.h"
#include "tests/support/allocations.h"
#include "tests/support/catch.h"

namespace lodesman::conformance {

struct Polled {
  ReadStatus status = ReadStatus::kNothingNew;
  Time stamp{};  // valid when kFresh
};

// Lets time pass in small steps until the sensor answers so; false when it does not in 20 periods.
template <class Bench, class PollOnce>
[[nodiscard]] bool comes_to(Bench& bench, PollOnce poll_once, ReadStatus status) {
  const Duration step = Bench::period() / 4;
  for (int i = 0; i < 80; ++i) {
    if (poll_once(bench).status == status) {
      return true;
    }
    bench.pass(step);
  }
  return false;
}

template <class Bench, class PollOnce>
void gives_each_sample_once(PollOnce poll_once) {
  Bench bench;
  bench.come_up();
  bench.pass(4 * Bench::period());
  REQUIRE(comes_to(bench, poll_once, ReadStatus::kFresh));
  for (int i = 0; i < 16 && poll_once(bench).status == ReadStatus::kFresh; ++i) {
  }
  for (int i = 0; i < 5; ++i) {
    CHECK(poll_once(bench).status == ReadStatus::kNothingNew);
  }
}

template <class Bench, class PollOnce>
void brings_samples_at_its_rate(PollOnce poll_once) {
  Bench bench;
  bench.come_up();
  Time last{};
  int fresh = 0;
  for (int i = 0; i < 400; ++i) {
    bench.pass(Bench::period() / 4);
    const Polled polled = poll_once(bench);
    REQUIRE((polled.status == ReadStatus::kFresh || polled.status == ReadStatus::kNothingNew));
    if (polled.status == ReadStatus::kFresh) {
      CHECK(polled.stamp <= bench.now());
      CHECK(polled.stamp > last);
      CHECK(bench.now() - polled.stamp <= 2 * Bench::period());
      last = polled.stamp;
      ++fresh;
    }
  }
  CHECK(fresh >= 90);
  CHECK(fresh <= 101);
}

template <class Bench, class PollOnce>
void fails_as_it_must_and_recovers(PollOnce poll_once) {
  Bench bench;
  bench.come_up();
  bench.pass(2 * Bench::period());
  REQUIRE(comes_to(bench, poll_once, ReadStatus::kFresh));
  const struct {
    BenchFault fault;
    ReadStatus status;
  } rows[] = {{BenchFault::kStall, ReadStatus::kNothingNew},
              {BenchFault::kCorrupt, ReadStatus::kCorrupt},
              {BenchFault::kDisconnect, ReadStatus::kDisconnected}};
  for (const auto& row : rows) {
    INFO("fault " << static_cast<int>(row.fault));
    bench.fail(row.fault);
    bench.pass(Bench::period());
    CHECK(comes_to(bench, poll_once, row.status));
    for (int i = 0; i < 40; ++i) {
      bench.pass(Bench::period() / 4);
      const ReadStatus status = poll_once(bench).status;
      CHECK((status == row.status || status == ReadStatus::kNothingNew));
    }
    bench.mend();
    const Time mended = bench.now();
    Polled polled;
    while (polled.status != ReadStatus::kFresh && bench.now() - mended < Bench::recovery()) {
      bench.pass(Bench::period() / 4);
      polled = poll_once(bench);
    }
    REQUIRE(polled.status == ReadStatus::kFresh);
    CHECK(polled.stamp >= mended);  // nothing of the time of the fault is delivered late
  }
}

// Whatever comes of it: what stands behind a device may take from the heap, the device must not.
template <class Bench, class PollOnce>
void polls_without_the_heap(PollOnce poll_once) {
  Bench bench;
  static_cast<void>(poll_once(bench));  // the suite's own buffers
  int fresh = 0;
  std::uint64_t taken_from_heap = 0;
  const auto use = [&](int polls) {
    for (int i = 0; i < polls; ++i) {
      bench.pass(Bench::period() / 4);
      const testing::AllocationScope scope;
      fresh += poll_once(bench).status == ReadStatus::kFresh ? 1 : 0;
      taken_from_heap += scope.count();
    }
  };
  use(400);  // its start-up too
  for (const auto fault : {BenchFault::kStall, BenchFault::kCorrupt, BenchFault::kDisconnect}) {
    bench.fail(fault);
    use(400);  // long enough for a start-up to begin again
    bench.mend();
    use(400);
  }
  CHECK(fresh > 200);
  CHECK(taken_from_heap == 0);
}

}  // namespace lodesman::conformance
