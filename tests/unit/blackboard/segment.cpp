// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/segment.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

std::string own_name(const char* test) {
  return "lodesman-test-" + std::string{test} + "-" + std::to_string(getpid());
}

bool exists(const std::string& name) { return std::filesystem::exists("/dev/shm/" + name); }

}  // namespace

TEST_CASE("segment: what one side publishes the other reads, and the name goes with its maker",
          "[mid_level][blackboard]") {
  const auto name = own_name("both");
  {
    auto low = SharedBlackboard::create(name);
    auto high = SharedBlackboard::open(name, Role::kHigh, Duration::zero());
    const auto watch = SharedBlackboard::observe(name, Duration::zero());
    Writer<HelmCommand> writer{high.writable().helm_command, Role::kHigh, "helm_command"};
    HelmCommand helm;
    helm.head_ref = -7;
    writer.publish(helm, Time{Duration{5}});
    Reader<HelmCommand> low_reader{low->helm_command};
    Reader<HelmCommand> watch_reader{watch->helm_command};
    REQUIRE(low_reader.latest() != nullptr);
    CHECK(low_reader.latest()->value.head_ref == -7);
    CHECK(watch_reader.latest()->value.head_ref == -7);
    CHECK(watch.alive(Role::kLow));
    CHECK(watch.alive(Role::kHigh));
    CHECK_FALSE(high.found_dead());
  }
  CHECK_FALSE(exists(name));
}

TEST_CASE("segment: a live one is refused, in either role", "[mid_level][blackboard]") {
  const auto name = own_name("live");
  const auto low = SharedBlackboard::create(name);
  CHECK_THROWS_WITH(SharedBlackboard::create(name),
                    "segment " + name + " is in use by a running lodesman-low");
  const auto high = SharedBlackboard::open(name, Role::kHigh, Duration::zero());
  CHECK_THROWS_WITH(SharedBlackboard::open(name, Role::kHigh, Duration::zero()),
                    "segment " + name + ": a program in the same role is running");
  CHECK_FALSE(remove_dead_segment(name));
}

TEST_CASE("segment: there is none without a low level", "[mid_level][blackboard]") {
  const auto name = own_name("none");
  CHECK_THROWS_WITH(SharedBlackboard::open(name, Role::kHigh, Duration::zero()),
                    "segment " + name + " does not exist: is lodesman-low running?");
}

TEST_CASE(
    "segment: a killed high level's channels can be claimed again, a killed low level's "
    "segment is made anew",
    "[mid_level][blackboard]") {
  const auto name = own_name("killed");
  const auto die_as = [&](auto body) {
    const pid_t child = fork();
    if (child == 0) {
      body();
      kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
  };
  {
    auto low = SharedBlackboard::create(name);
    die_as([&] {
      auto high = SharedBlackboard::open(name, Role::kHigh, Duration::zero());
      Writer<HelmCommand> writer{high.writable().helm_command, Role::kHigh, "helm_command"};
      writer.publish(HelmCommand{}, Time{Duration{1}});
    });
    CHECK_FALSE(low.alive(Role::kHigh));
    auto again = SharedBlackboard::open(name, Role::kHigh, Duration::zero());
    CHECK(again.found_dead());
    Writer<HelmCommand> writer{again.writable().helm_command, Role::kHigh, "helm_command"};
    CHECK(writer.sequence() == 1);
  }
  die_as([&] {
    auto low = std::make_unique<SharedBlackboard>(SharedBlackboard::create(name));
    (void)low.release();
  });
  CHECK(exists(name));
  {
    const auto low = SharedBlackboard::create(name);
    CHECK(low.found_dead());
  }
  CHECK_FALSE(exists(name));
}

TEST_CASE("segment: a header that does not fit is refused with the reason",
          "[mid_level][blackboard]") {
  SegmentHeader header;
  CHECK(header_fault(header, 8) == "is shorter than a header");
  CHECK(header_fault(header, 4096) == "is not ready");
  header.ready.store(SegmentHeader::kReady);
  CHECK(header_fault(header, 4096) == "is no Lodesman segment");
  header.magic.store(SegmentHeader::kMagic);
  CHECK(header_fault(header, 4096) ==
        "was made by a build with another layout; use programs of one build");
  header.layout_hash.store(layout_hash());
  CHECK(header_fault(header, 4096) == "has the wrong size");
}

TEST_CASE("segment: a process killed while it publishes leaves nothing torn",
          "[mid_level][blackboard]") {
  const auto name = own_name("torn");
  auto low = SharedBlackboard::create(name);
  Reader<SonarPath> reader{low->sonar_path};
  std::uint64_t last = 0;
  const auto look = [&] {
    const auto* got = reader.latest();
    REQUIRE(got != nullptr);
    const auto wanted = static_cast<std::int16_t>(got->value.request % 30000);
    const auto& pixels = got->value.pixels;
    REQUIRE(std::all_of(pixels.begin(), pixels.end(),
                        [&](const PathPixel& pixel) { return pixel.column == wanted; }));
    REQUIRE(got->sequence >= last);
    last = got->sequence;
  };
  for (unsigned round = 0; round < 50; ++round) {
    const pid_t child = fork();
    if (child == 0) {
      // A path as long as they get, every pixel with the number of the request.
      auto path = std::make_unique<SonarPath>();
      path->pixel_count = kMaxPathPixels;
      auto& channel = low.writable().sonar_path;
      channel.release_claim_of(Role::kHigh);
      Writer<SonarPath> writer{channel, Role::kHigh, "sonar_path"};
      for (;;) {
        path->request = writer.sequence() + 1;
        path->pixels.fill({static_cast<std::int16_t>(path->request % 30000), 0});
        writer.publish(*path, Time{Duration{1}});
      }
    }
    // Killed in the middle of a later publication, wherever that is.
    const std::uint64_t before = reader.newest_sequence();
    while (reader.newest_sequence() < before + 2 + round % 7) {
    }
    look();
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    look();
  }
  CHECK(last >= 100);
}
