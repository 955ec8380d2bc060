// SPDX-License-Identifier: Apache-2.0
// Both programs as they sail, and somebody who writes anything into their shared memory.
// LODESMAN_LIVE_FORGERIES says how often; the suite does it few times.
#include <boost/interprocess/mapped_region.hpp>
#include <boost/interprocess/shared_memory_object.hpp>
#include <cstdlib>

#include "mid_level/recording/recording_hash.h"
#include "tests/support/catch.h"
#include "tests/support/forgery.h"
#include "tests/system/boat.h"

using namespace lodesman;
using namespace lodesman::testing;
namespace bip = boost::interprocess;

namespace {

// As segments are laid out.
struct Segment {
  SegmentHeader header;
  Blackboard board;
};

// The segment as another program of the same user could have it.
class Intruder {
 public:
  explicit Intruder(const std::string& segment)
      : memory_{bip::open_only, segment.c_str(), bip::read_write},
        region_{memory_, bip::read_write} {}
  [[nodiscard]] Blackboard& board() noexcept {
    return static_cast<Segment*>(region_.get_address())->board;
  }

 private:
  bip::shared_memory_object memory_;
  bip::mapped_region region_;
};

[[nodiscard]] int forgeries_asked() {
  const char* text = std::getenv("LODESMAN_LIVE_FORGERIES");  // NOLINT(concurrency-mt-unsafe)
  return text != nullptr ? std::atoi(text) : 40;
}

}  // namespace

TEST_CASE("live forgeries: neither program dies of what stands in shared memory nor an onlooker",
          "[system]") {
  const Scratch scratch{"forgeries"};
  Boat boat{scratch};
  const auto board = SharedBlackboard::observe(boat.segment, seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  RecordingHash onlooker{*board};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  Intruder intruder{boat.segment};
  RandomForger forger{11};
  const int asked = forgeries_asked();
  for (int i = 0; i < asked; ++i) {
    forger.forge(intruder.board());
    std::this_thread::sleep_for(milliseconds{20});
    onlooker.update();
    REQUIRE_FALSE(boat.low->ended().has_value());
    REQUIRE_FALSE(boat.high->ended().has_value());
  }
  // And it is still a boat: the box is told something, sanely, after the last of them.
  const std::uint64_t before = board->thrust_applied.head.newest.load();
  CHECK(eventually([&] { return board->thrust_applied.head.newest.load() != before; }));
}
