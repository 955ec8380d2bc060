// SPDX-License-Identifier: Apache-2.0
// What a reader makes of a channel that holds what no writer of ours would write.
#include <limits>

#include "mid_level/blackboard/blackboard.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time kNow{seconds{100}};

HelmCommand helm_of(std::int32_t surge_ref) {
  HelmCommand helm;
  helm.surge_ref = surge_ref;
  return helm;
}

// A channel with four publications, a second apart, the last one at kNow; SurgeRef counts them.
struct Channelful {
  std::unique_ptr<Channel<HelmCommand, 8>> channel = std::make_unique<Channel<HelmCommand, 8>>();
  Writer<HelmCommand> writer{*channel, Role::kHigh, "helm"};
  Reader<HelmCommand> reader{*channel};

  Channelful() {
    for (int i = 1; i <= 4; ++i) {
      writer.publish(helm_of(i), kNow - seconds{4 - i});
    }
  }
  [[nodiscard]] auto& slot(std::uint64_t sequence) { return channel->slots[sequence % 8]; }
  // A SurgeRef that no helm may have, in the place where SurgeRef lies.
  void spoil(std::uint64_t sequence) { slot(sequence).words[0] = 0x7fffffff00000000ULL; }
  [[nodiscard]] int latest() {
    const auto* helm = reader.latest();
    return helm != nullptr ? helm->value.surge_ref : 0;
  }
};

}  // namespace

TEST_CASE("reader: what is not sane is passed over for the newest value that is",
          "[mid_level][blackboard]") {
  Channelful made;
  made.spoil(4);
  made.spoil(3);
  CHECK(made.latest() == 2);
  CHECK(made.latest() == 2);
  CHECK(made.reader.fresh(kNow, seconds{1}) == nullptr);  // it ages like what is missing
  CHECK(made.reader.fresh(kNow, seconds{2})->value.surge_ref == 2);
  CHECK(made.reader.at(3) == nullptr);
  made.writer.publish(helm_of(5), kNow);
  CHECK(made.latest() == 5);
}

TEST_CASE("reader: each value that is not sane is counted once", "[mid_level][blackboard]") {
  Channelful made;
  made.spoil(4);
  for (int i = 0; i < 3; ++i) {
    CHECK(made.latest() == 3);
  }
  CHECK(made.reader.refused() == 1);
}

TEST_CASE("reader: one after the other leaves out what is not sane", "[mid_level][blackboard]") {
  Channelful made;
  made.spoil(1);
  made.spoil(3);
  CHECK(made.reader.next()->value.surge_ref == 2);
  CHECK(made.reader.next()->value.surge_ref == 4);
  CHECK(made.reader.next() == nullptr);
  CHECK(made.reader.refused() == 2);
  CHECK(made.reader.missed() == 2);
}

TEST_CASE("reader: a length that is not that of the value is not sane", "[mid_level][blackboard]") {
  for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{8}, sizeof(HelmCommand) + 8,
                                    std::numeric_limits<std::uint64_t>::max()}) {
    Channelful made;
    made.slot(4).bytes = bytes;
    CHECK(made.latest() == 3);
  }
}

TEST_CASE("reader: a stamp before the clock began or at its end is not sane",
          "[mid_level][blackboard]") {
  for (const std::int64_t stamp_ns : {std::int64_t{-1}, std::numeric_limits<std::int64_t>::min(),
                                      std::numeric_limits<std::int64_t>::max()}) {
    Channelful made;
    made.slot(4).stamp_ns = stamp_ns;
    CHECK(made.reader.fresh(kNow, seconds{1})->value.surge_ref == 3);
  }
}

TEST_CASE("reader: what is stamped in the future is not fresh, the newest before it is",
          "[mid_level][blackboard]") {
  Channelful made;
  made.writer.publish(helm_of(5), kNow + seconds{8});
  CHECK(made.reader.fresh(kNow, seconds{1})->value.surge_ref == 4);
  // Nor does it become fresh for ever: only when its time has come, and for as long as any other.
  CHECK(made.reader.fresh(kNow + seconds{7}, seconds{1}) == nullptr);
  CHECK(made.reader.fresh(kNow + seconds{9}, seconds{1})->value.surge_ref == 5);
  CHECK(made.reader.fresh(kNow + seconds{10}, seconds{1}) == nullptr);
}

TEST_CASE("reader: what alone is there and in the future is not fresh", "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<HelmCommand, 4>>();
  Writer<HelmCommand> writer{*channel, Role::kHigh, "helm"};
  Reader<HelmCommand> reader{*channel};
  writer.publish(helm_of(1), kNow + seconds{1});
  CHECK(reader.fresh(kNow, seconds{10}) == nullptr);
}

TEST_CASE("reader: age counts from when a thing was measured", "[mid_level][blackboard]") {
  const auto channel = std::make_unique<Channel<Attitude, 4>>();
  Writer<Attitude> writer{*channel, Role::kLow, "attitude"};
  Reader<Attitude> reader{*channel};
  Attitude attitude;
  attitude.measured = kNow - milliseconds{250};
  writer.publish(attitude, kNow);
  CHECK(reader.fresh(kNow, milliseconds{300}) != nullptr);
  CHECK(reader.fresh(kNow + milliseconds{60}, milliseconds{300}) == nullptr);
  attitude.measured = kNow + seconds{5};
  writer.publish(attitude, kNow);
  CHECK(reader.fresh(kNow, milliseconds{300})->value.measured == kNow - milliseconds{250});
}

TEST_CASE("reader: a spoilt head is mended by the next publication", "[mid_level][blackboard]") {
  for (const std::uint64_t head : {std::uint64_t{1}, std::uint64_t{0}, std::uint64_t{12},
                                   std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
    CAPTURE(head);
    Channelful made;
    CHECK(made.latest() == 4);
    Reader<HelmCommand> one_by_one{*made.channel};
    while (one_by_one.next() != nullptr) {
    }
    made.channel->head.newest = head;
    CHECK(made.latest() == 4);
    CHECK(one_by_one.next() == nullptr);
    made.writer.publish(helm_of(5), kNow);
    CHECK(made.latest() == 5);
    CHECK(one_by_one.next()->value.surge_ref == 5);
  }
}

TEST_CASE("reader: one after the other comes to an end whatever the head announces",
          "[mid_level][blackboard]") {
  for (const std::uint64_t newest : {~std::uint64_t{0}, ~std::uint64_t{0} - 3,
                                     std::uint64_t{1} << 63U, kLastSequence + 1, kLastSequence}) {
    Channelful made;
    while (made.reader.next() != nullptr) {
    }
    // Every place holds what would be whole, were that number right.
    for (std::uint64_t back = 0; back < 8; ++back) {
      made.slot(newest - back).version = 2 * (newest - back);
      made.slot(newest - back).bytes = sizeof(HelmCommand);
    }
    made.channel->head.newest = newest;
    int values = 0;
    while (values < 100 && made.reader.next() != nullptr) {
      ++values;
    }
    CHECK(values <= 8);
    CHECK(made.latest() <= 4);
  }
}

TEST_CASE("reader: one that was led far ahead begins anew", "[mid_level][blackboard]") {
  Channelful made;
  constexpr std::uint64_t kFar = (std::uint64_t{1} << 40) + 5;  // a forged value in the fifth slot
  made.slot(kFar).version = 2 * kFar;
  made.slot(kFar).bytes = sizeof(HelmCommand);
  made.channel->head.newest = kFar;
  Reader<HelmCommand> one_by_one{*made.channel};
  CHECK(made.reader.latest()->sequence == kFar);
  while (one_by_one.next() != nullptr) {
  }
  for (int i = 5; i < 20; ++i) {
    made.writer.publish(helm_of(i), kNow);
    static_cast<void>(made.latest());
    static_cast<void>(one_by_one.next());
  }
  CHECK(made.latest() == 19);
  made.writer.publish(helm_of(20), kNow);
  CHECK(one_by_one.next()->value.surge_ref == 20);
}
