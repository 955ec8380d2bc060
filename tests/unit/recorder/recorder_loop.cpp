// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/recorder/recorder_loop.h"

#include <atomic>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/recording/mcap_reader.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/memory_file.h"

using namespace lodesman;
using namespace lodesman::cli;
using namespace lodesman::testing;
using nlohmann::json;

namespace {

// A disk that takes nothing until it is told to.
class StuckFile final : public MemoryFile {
 public:
  StuckFile(Disk& disk, const std::atomic<bool>& is_stuck)
      : MemoryFile{disk}, is_stuck_{is_stuck} {}

  [[nodiscard]] int write(std::span<const std::byte> bytes) noexcept override {
    while (is_stuck_.load()) {
      std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    return MemoryFile::write(bytes);
  }

 private:
  const std::atomic<bool>& is_stuck_;
};

// How often each number of the sonar's channel is told, as a message or in a gap; causes of gaps.
struct Told {
  std::map<std::uint64_t, int> times;
  std::map<std::string, std::uint64_t> gaps;
};

[[nodiscard]] Told told_of_pings(const Disk& disk) {
  McapBytesSource source{disk.bytes};
  McapReader reader{source};
  Told told;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item != McapItem::kMessage) {
      continue;
    }
    const McapMessage& message = reader.message();
    const std::string& topic = reader.channel_by_id(message.channel)->topic;
    if (topic == "raw/sonar_ping") {
      ++told.times[message.sequence];
    } else if (topic == kGapsTopic) {
      const json gap = json::parse(
          std::string{reinterpret_cast<const char*>(message.data.data()), message.data.size()});
      REQUIRE(gap["channel"] == "sonar_ping");
      told.gaps[gap["cause"]] += gap["count"].get<std::uint64_t>();
      for (std::uint64_t i = gap["first"]; i <= gap["last"].get<std::uint64_t>(); ++i) {
        ++told.times[i];
      }
    }
  }
  CHECK(reader.ending() == McapEnding::kWhole);
  return told;
}

}  // namespace

TEST_CASE(
    "recorder loop: while the disk is stuck the boat is looked at, and what is too much is told",
    "[recorder]") {
  constexpr std::uint64_t kPings = 40;  // of half a megabyte, where there is room for seven
  const auto board = std::make_unique<Blackboard>();
  Disk disk;
  std::atomic<bool> is_stuck{true};
  SeriesOptions options;
  options.first = "boat.mcap";
  options.chunk_span = std::chrono::milliseconds{50};
  FileSeries series{
      options,
      {},
      [&](const std::filesystem::path&) { return std::make_unique<StuckFile>(disk, is_stuck); },
      [] { return UINT64_MAX / 2; }};
  BoardTap tap{*board};
  std::jthread freeing;
  {
    const RecorderLoop loop{tap, RecorderLoop::Board::kTheSame, series,
                            PublicationQueue::kLeast_bytes, [](const std::string&) {}};
    auto pings = writer_of(*board, board->sonar_ping, Role::kLow);
    const auto ping = std::make_unique<SonarPing>();
    ping->range_m = 30.0;
    ping->make_image(kMaxBeams, kMaxBins, 2.0);
    for (std::uint64_t i = 1; i <= kPings; ++i) {
      ping->number = i;
      pings.publish(*ping, SteadyClock{}.now());
      std::this_thread::sleep_for(2 * RecorderLoop::kPollPeriod);
    }
    // Once the last look has found the queue full.
    freeing = std::jthread{[&is_stuck] {
      std::this_thread::sleep_for(20 * RecorderLoop::kPollPeriod);
      is_stuck.store(false);
    }};
  }
  series.close();
  const Told told = told_of_pings(disk);
  CHECK(told.gaps.count("queue_full") == 1);
  for (std::uint64_t i = 1; i <= kPings; ++i) {
    INFO("ping " << i);
    CHECK(told.times.count(i) == 1);
    CHECK(told.times.at(i) == 1);
  }
  CHECK(series.recorded() + series.lost() == kPings);
  CHECK(series.recorded() >= 4);
}
