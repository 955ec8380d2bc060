// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/board_tap.h"

#include <limits>
#include <string>

#include "mid_level/recording/raw_codec.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/support.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// Keeps what it is handed; has no room where it is told so.
class KeepingSink final : public PublicationSink {
 public:
  std::span<std::byte> room_for(const Publication& publication) noexcept override {
    room_.assign(full ? 0 : publication.bytes, std::byte{0});
    return room_;
  }
  void take(const Publication& publication) noexcept override {
    taken.push_back(publication);
    bytes.push_back(room_);
  }
  void note(const Gap& gap) noexcept override { gaps.push_back(gap); }

  bool full = false;
  std::vector<Publication> taken;
  std::vector<std::vector<std::byte>> bytes;
  std::vector<Gap> gaps;

 private:
  std::vector<std::byte> room_;
};

}  // namespace

TEST_CASE("board tap: each publication is handed on once, in its bytes", "[recording]") {
  const auto board = std::make_unique<Blackboard>();
  auto attitude = writer_of(*board, board->attitude, Role::kLow);
  BoardTap tap{*board};
  KeepingSink sink;
  Attitude value;
  for (int i = 1; i <= 5; ++i) {
    value.yaw_rate_rad_s = i;
    attitude.publish(value, at(i));
  }
  tap.poll(sink);
  tap.poll(sink);
  REQUIRE(sink.taken.size() == 5);
  CHECK(sink.taken[4].sequence == 5);
  CHECK(sink.taken[4].stamp == at(5));
  CHECK(sink.taken[4].channel == channel_named("attitude"));
  Attitude back;
  REQUIRE(decode_raw(sink.bytes[4], back));
  CHECK(back.yaw_rate_rad_s == Approx(5.0));
  CHECK(sink.gaps.empty());
}

TEST_CASE("board tap: what was written over is a gap, what was before it came is none",
          "[recording]") {
  const auto board = std::make_unique<Blackboard>();
  auto helm = writer_of(*board, board->helm_command, Role::kHigh);
  for (int i = 1; i <= 100; ++i) {
    helm.publish({}, at(i));
  }
  BoardTap tap{*board};
  KeepingSink sink;
  tap.poll(sink);
  REQUIRE(sink.taken.size() == 64);  // what the ring still has
  CHECK(sink.taken.front().sequence == 37);
  CHECK(sink.gaps.empty());
  for (int i = 101; i <= 170; ++i) {
    helm.publish({}, at(i));
  }
  tap.poll(sink);
  REQUIRE(sink.gaps.size() == 1);
  CHECK(sink.gaps[0].first == 101);
  CHECK(sink.gaps[0].last == 106);
  CHECK(sink.gaps[0].cause == GapCause::kOverwritten);
  CHECK(sink.taken.size() == 64 + 64);
}

TEST_CASE("board tap: what was published before a tap that is to have all is a gap",
          "[recording]") {
  const auto board = std::make_unique<Blackboard>();
  auto helm = writer_of(*board, board->helm_command, Role::kHigh);
  for (int i = 1; i <= 100; ++i) {
    helm.publish({}, at(i));
  }
  BoardTap tap{*board, BoardTap::Past::kGap};
  KeepingSink sink;
  tap.poll(sink);
  CHECK(sink.taken.size() == 64);
  REQUIRE(sink.gaps.size() == 1);
  CHECK(sink.gaps[0].first == 1);
  CHECK(sink.gaps[0].last == 36);
}

TEST_CASE("board tap: what is not sane is a gap at once, be it the first or the last",
          "[recording]") {
  const auto board = std::make_unique<Blackboard>();
  auto attitude = writer_of(*board, board->attitude, Role::kLow);
  BoardTap tap{*board};
  KeepingSink sink;
  Attitude mad;
  mad.yaw_rate_rad_s = std::numeric_limits<double>::quiet_NaN();
  attitude.publish(mad, at(1));
  tap.poll(sink);
  tap.poll(sink);
  REQUIRE(sink.gaps.size() == 1);
  CHECK(sink.gaps[0].first == 1);
  CHECK(sink.gaps[0].last == 1);
  attitude.publish({}, at(2));
  attitude.publish(mad, at(3));
  tap.poll(sink);
  attitude.publish({}, at(4));
  tap.poll(sink);
  CHECK(sink.taken.size() == 2);
  REQUIRE(sink.gaps.size() == 2);
  CHECK(sink.gaps[1].first == 3);
  CHECK(sink.gaps[1].last == 3);
}

TEST_CASE("board tap: a sink without room loses what it refused and nothing else", "[recording]") {
  const auto board = std::make_unique<Blackboard>();
  auto helm = writer_of(*board, board->helm_command, Role::kHigh);
  BoardTap tap{*board};
  KeepingSink sink;
  sink.full = true;
  helm.publish({}, at(1));
  tap.poll(sink);
  sink.full = false;
  helm.publish({}, at(2));
  tap.poll(sink);
  REQUIRE(sink.taken.size() == 1);
  CHECK(sink.taken[0].sequence == 2);
  CHECK(sink.gaps.empty());  // the sink knows of it
}
