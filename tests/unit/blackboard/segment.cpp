// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/segment.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

std::string own_name(const char* test) {
  return "lodesman-test-" + std::string{test} + "-" + std::to_string(getpid());
}

constexpr Duration kPatience = std::chrono::seconds{20};

[[noreturn]] void die() {
  kill(getpid(), SIGKILL);
  std::abort();
}

[[noreturn]] void wait_for_ever() {
  for (;;) {
    pause();
  }
}

// A process that runs `body`, until it is killed.
class Life {
 public:
  template <class Body>
  explicit Life(Body body) : child_{fork()} {
    if (child_ == 0) {
      body();
      std::abort();
    }
  }
  Life(const Life&) = delete;
  Life& operator=(const Life&) = delete;
  ~Life() { end(); }
  void end() const {
    if (!ended_) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
      ended_ = true;
    }
  }

 private:
  pid_t child_;
  mutable bool ended_ = false;
};

template <class Body>
void die_as(Body body) {
  const pid_t child = fork();
  if (child == 0) {
    body();
    std::abort();
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  REQUIRE(WTERMSIG(status) == SIGKILL);
}

bool exists(const std::string& name) { return std::filesystem::exists("/dev/shm/" + name); }

// The file of a segment, as its bytes.
class Bytes {
 public:
  explicit Bytes(const std::string& name) : path_{"/dev/shm/" + name} {}
  void put(std::size_t offset, std::uint64_t word) {
    std::fstream file{path_, std::ios::in | std::ios::out | std::ios::binary};
    file.seekp(static_cast<std::streamoff>(offset));
    file.write(reinterpret_cast<const char*>(&word), sizeof word);
  }
  void lengthen() { std::filesystem::resize_file(path_, std::filesystem::file_size(path_) + 4096); }

 private:
  std::filesystem::path path_;
};

struct Layout {
  SegmentHeader header;
  Blackboard board;
};
constexpr std::size_t kBoardOffset = offsetof(Layout, board);

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

TEST_CASE("segment: a killed high level's channels can be claimed again",
          "[mid_level][blackboard]") {
  const auto name = own_name("killed-high");
  const auto low = SharedBlackboard::create(name);
  die_as([&] {
    auto high = SharedBlackboard::open(name, Role::kHigh, Duration::zero());
    Writer<HelmCommand> writer{high.writable().helm_command, Role::kHigh, "helm_command"};
    writer.publish(HelmCommand{}, Time{Duration{1}});
    die();
  });
  CHECK_FALSE(low.alive(Role::kHigh));
  {
    auto again = SharedBlackboard::open(name, Role::kHigh, Duration::zero());
    CHECK(again.found_dead());
    Writer<HelmCommand> writer{again.writable().helm_command, Role::kHigh, "helm_command"};
    CHECK(writer.sequence() == 1);
  }
  // That one ended in order, which is no death although its values are there.
  CHECK_FALSE(SharedBlackboard::open(name, Role::kHigh, Duration::zero()).found_dead());
}

TEST_CASE("segment: a dead one of this build is taken over, and who is attached goes on",
          "[mid_level][blackboard]") {
  const auto name = own_name("adopted");
  std::optional<SharedBlackboard> high;
  std::optional<Writer<HelmCommand>> helm;
  const Life low{[&] {
    auto board = SharedBlackboard::create(name);
    Writer<Attitude> writer{board.writable().attitude, Role::kLow, "attitude"};
    writer.publish(Attitude{}, Time{Duration{7}});
    wait_for_ever();
  }};
  high.emplace(SharedBlackboard::open(name, Role::kHigh, kPatience));
  helm.emplace(high->writable().helm_command, Role::kHigh, "helm_command");
  Reader<Attitude> attitude{(*high)->attitude};
  while (attitude.latest() == nullptr) {
  }
  low.end();
  CHECK_FALSE(high->alive(Role::kLow));
  CHECK_FALSE(high->is_superseded());
  {
    auto successor = SharedBlackboard::create(name);
    CHECK(successor.legacy() == "taken over from a lodesman-low that died");
    CHECK(successor.found_dead());
    CHECK(high->alive(Role::kLow));
    CHECK_FALSE(high->is_superseded());
    // What was there is there, and both sides hear each other on the same channels.
    Writer<Attitude> writer{successor.writable().attitude, Role::kLow, "attitude"};
    CHECK(writer.sequence() == 1);
    writer.publish(Attitude{}, Time{Duration{9}});
    CHECK(attitude.latest()->stamp == Time{Duration{9}});
    helm->publish(HelmCommand{}, Time{Duration{11}});
    CHECK(Reader<HelmCommand>{successor->helm_command}.latest()->stamp == Time{Duration{11}});
    // The claims of the living stay theirs.
    CHECK_THROWS((Writer<HelmCommand>{successor.writable().helm_command, Role::kHigh, "helm"}));
  }
  CHECK_FALSE(exists(name));
}

TEST_CASE(
    "segment: a dead one that cannot be gone on with is made anew, and who is attached sees it",
    "[mid_level][blackboard]") {
  const auto spoil_hash = [](Bytes& bytes) { bytes.put(offsetof(SegmentHeader, layout_hash), 1); };
  const auto spoil_ready = [](Bytes& bytes) { bytes.put(offsetof(SegmentHeader, ready), 0); };
  const auto lengthen = [](Bytes& bytes) { bytes.lengthen(); };
  const auto spoil_head = [](Bytes& bytes) {
    bytes.put(kBoardOffset + offsetof(Blackboard, attitude), std::uint64_t{1} << 63U);
  };
  const std::vector<std::pair<std::function<void(Bytes&)>, std::string>> kinds{
      {spoil_hash, "was made by a build with another layout; use programs of one build"},
      {spoil_ready, "is not ready"},
      {lengthen, "has the wrong size"},
      {spoil_head, "holds a broken channel, attitude"}};
  for (const auto& [spoil, fault] : kinds) {
    const auto name = own_name("anew");
    const Life low{[&] {
      const auto board = SharedBlackboard::create(name);
      wait_for_ever();
    }};
    const auto high = SharedBlackboard::open(name, Role::kHigh, kPatience);
    low.end();
    Bytes bytes{name};
    spoil(bytes);
    {
      const auto successor = SharedBlackboard::create(name);
      CHECK(successor.legacy() == "made anew: what was there " + fault);
      CHECK(high.is_superseded());
      CHECK_FALSE(SharedBlackboard::open(name, Role::kHigh, Duration::zero()).is_superseded());
    }
    CHECK_FALSE(exists(name));
  }
}

TEST_CASE("segment: a high level waits for a living low level", "[mid_level][blackboard]") {
  const auto name = own_name("waits");
  CHECK_THROWS_AS(SharedBlackboard::open(name, Role::kHigh, Duration::zero()), NotYetError);
  die_as([&] {
    const auto board = SharedBlackboard::create(name);
    die();
  });
  CHECK_THROWS_WITH(SharedBlackboard::open(name, Role::kHigh, Duration::zero()),
                    "segment " + name + " was left by a lodesman-low that died");
  CHECK_THROWS_AS(SharedBlackboard::open(name, Role::kHigh, Duration::zero()), NotYetError);
  CHECK_FALSE(SharedBlackboard::observe(name, Duration::zero()).alive(Role::kLow));
  const auto low = SharedBlackboard::create(name);
  CHECK_NOTHROW(SharedBlackboard::open(name, Role::kHigh, Duration::zero()));
}

TEST_CASE("segment: a dead one that a high level still lives on is not cleared away",
          "[mid_level][blackboard]") {
  const auto name = own_name("cleared");
  {
    const Life low{[&] {
      const auto board = SharedBlackboard::create(name);
      wait_for_ever();
    }};
    const auto high = SharedBlackboard::open(name, Role::kHigh, kPatience);
    CHECK_FALSE(remove_dead_segment(name));
    low.end();
    CHECK_FALSE(remove_dead_segment(name));
    CHECK(exists(name));
  }
  CHECK(remove_dead_segment(name));
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
