// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/watch/find_segment.h"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>

#include "mid_level/blackboard/segment.h"
#include "tests/support/catch.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman::testing {
namespace {

using namespace cli;
namespace fs = std::filesystem;

TEST_CASE("find_segment: dead are those that nobody holds", "[cli]") {
  const TemporaryDirectory place;
  for (const char* name : {"lodesman-dead", "lodesman-held", "other"}) {
    std::ofstream{place.path() / name} << "x";
  }
  const int held = open((place.path() / "lodesman-held").c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(held >= 0);
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(Role::kHigh);
  lock.l_len = 1;
  REQUIRE(fcntl(held, F_OFD_SETLK, &lock) == 0);
  CHECK(dead_segments_in(place.path()) == std::vector<std::string>{"lodesman-dead"});
  close(held);
  CHECK(dead_segments_in(place.path()).size() == 2);
  CHECK(dead_segments_in(place.path() / "none").empty());
}

TEST_CASE("find_segment: what killed runs have left is removed, and nothing else", "[cli]") {
  const std::string id = std::to_string(getpid());
  const std::string dead = "lodesman-sim-test-dead-" + id;
  const std::string alive = "lodesman-sim-test-alive-" + id;
  const std::string other = "lodesman-test-other-boat-" + id;
  std::ofstream{"/dev/shm/" + dead} << "x";
  std::ofstream{"/dev/shm/" + other} << "x";
  {
    const SharedBlackboard held = SharedBlackboard::create(alive);
    remove_dead_runs();
    CHECK_FALSE(fs::exists("/dev/shm/" + dead));
    CHECK(fs::exists("/dev/shm/" + alive));
    CHECK(fs::exists("/dev/shm/" + other));
  }
  fs::remove("/dev/shm/" + other);
}

}  // namespace
}  // namespace lodesman::testing
