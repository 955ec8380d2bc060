// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/file_series.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "mid_level/base/startup_error.h"
#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/raw_codec.h"
#include "tests/support/catch.h"
#include "tests/unit/recording/memory_file.h"
#include "tests/unit/recording/support.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// Sequences by topic, and gaps as they are told.
struct Contents {
  std::map<std::string, std::vector<std::uint32_t>> sequences;
  std::vector<nlohmann::json> gaps;
  std::map<std::string, std::string> about;
  McapEnding ending = McapEnding::kOpen;
};

[[nodiscard]] Contents contents_of(const std::vector<std::byte>& bytes) {
  McapBytesSource source{bytes};
  McapReader reader{source};
  Contents contents;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item == McapItem::kMetadata) {
      contents.about = reader.metadata().values;
    }
    if (item != McapItem::kMessage) {
      continue;
    }
    const std::string topic = reader.channel_by_id(reader.message().channel)->topic;
    contents.sequences[topic].push_back(reader.message().sequence);
    if (topic == kGapsTopic) {
      const auto data = reader.message().data;
      contents.gaps.push_back(nlohmann::json::parse(
          std::string{reinterpret_cast<const char*>(data.data()), data.size()}));
    }
  }
  contents.ending = reader.ending();
  return contents;
}

// One write fails, and those after it do not.
class OnceFailingFile final : public MemoryFile {
 public:
  OnceFailingFile(Disk& disk, int& next_error) noexcept
      : MemoryFile{disk}, next_error_{next_error} {}

  [[nodiscard]] int write(std::span<const std::byte> bytes) noexcept override {
    const int error = std::exchange(next_error_, 0);
    return error != 0 ? error : MemoryFile::write(bytes);
  }

 private:
  int& next_error_;
};

// A series whose files are in memory.
struct Shelf {
  std::map<std::string, Disk> disks;
  std::uint64_t free_bytes = std::uint64_t{1} << 40;
  std::uint64_t room_bytes = UINT64_MAX;  // of each new file
  SeriesOptions options;

  Shelf() {
    options.first = "boat.mcap";
    options.chunk_span = std::chrono::seconds{1};
  }
  [[nodiscard]] FileSeries series() {
    return {options,
            {"test", {{"boat", "b"}}, {{"config.toml", "x = 1"}}},
            [this](const std::filesystem::path& path) {
              Disk& disk = disks[path.string()];
              disk.room_bytes = room_bytes;
              return std::make_unique<MemoryFile>(disk);
            },
            [this] { return free_bytes; }};
  }
};

void publish(FileSeries& series, const char* channel, std::uint64_t sequence, Time now) {
  const Attitude attitude;
  std::vector<std::byte> raw(used_bytes(attitude));
  encode_raw(attitude, raw);
  series.add(
      Publication{channel_named(channel), static_cast<std::uint32_t>(raw.size()), now, sequence},
      raw, now);
}

}  // namespace

TEST_CASE("file series: a file begins with the first publication and is closed with its name",
          "[recording]") {
  Shelf shelf;
  {
    FileSeries series = shelf.series();
    series.tick(at(10));
    CHECK(shelf.disks.empty());
    publish(series, "attitude", 1, at(20));
    publish(series, "attitude", 2, at(40));
    CHECK(series.state() == SeriesState::kRecording);
    CHECK(series.recorded() == 2);
  }
  REQUIRE(shelf.disks.size() == 1);
  const Disk& disk = shelf.disks.at("boat.mcap");
  CHECK(disk.kept);
  const Contents contents = contents_of(disk.bytes);
  CHECK(contents.ending == McapEnding::kWhole);
  CHECK(contents.sequences.at("raw/attitude") == std::vector<std::uint32_t>{1, 2});
  CHECK(contents.about.at("boat") == "b");
  CHECK(contents.about.at("part") == "1");
}

TEST_CASE("file series: a chunk is on the disk within a second of its first message",
          "[recording]") {
  Shelf shelf;
  FileSeries series = shelf.series();
  std::uint64_t sequence = 0;
  for (std::int64_t ms = 1000; ms <= 5000; ms += 20) {
    publish(series, "attitude", ++sequence, at(ms));
    series.tick(at(ms));
    // As a power cut would leave it.
    const Contents contents = contents_of(shelf.disks.at("boat.mcap").bytes);
    const auto found = contents.sequences.find("raw/attitude");
    const std::uint64_t there = found == contents.sequences.end() ? 0 : found->second.size();
    CHECK(sequence - there <= 50);
  }
  CHECK(shelf.disks.at("boat.mcap").syncs >= 4);
}

TEST_CASE("file series: a large or old file is followed by another, which says the mission again",
          "[recording][plain]") {
  Shelf shelf;
  shelf.options.rotate_bytes = 60'000;
  shelf.options.rotate_after = std::chrono::minutes{1};
  shelf.options.said_again = {"mission_definition"};
  FileSeries series = shelf.series();
  publish(series, "mission_definition", 1, at(0));
  std::uint64_t sequence = 0;
  for (std::int64_t ms = 0; ms <= 130'000; ms += 100) {
    publish(series, "attitude", ++sequence, at(ms));
    series.tick(at(ms));
  }
  series.close();
  REQUIRE(shelf.disks.size() >= 3);
  std::vector<std::uint32_t> all;
  for (unsigned i = 1; i <= shelf.disks.size(); ++i) {
    const std::string name = i == 1 ? "boat.mcap" : "boat-" + std::to_string(i) + ".mcap";
    const Contents contents = contents_of(shelf.disks.at(name).bytes);
    CHECK(contents.ending == McapEnding::kWhole);
    CHECK(contents.about.at("part") == std::to_string(i));
    CHECK(contents.sequences.at("raw/mission_definition") == std::vector<std::uint32_t>{1});
    const auto& part = contents.sequences.at("raw/attitude");
    all.insert(all.end(), part.begin(), part.end());
  }
  REQUIRE(all.size() == sequence);
  CHECK(std::is_sorted(all.begin(), all.end()));
}

TEST_CASE(
    "file series: of another blackboard nothing is said again, and each file has news of its own",
    "[recording]") {
  Shelf shelf;
  shelf.options.said_again = {"mission_definition"};
  int files = 0;
  shelf.options.renew_about = [&files](std::map<std::string, std::string>& about) {
    about["now"] = std::to_string(++files);
  };
  FileSeries series = shelf.series();
  publish(series, "mission_definition", 7, at(0));
  series.begin_anew();
  publish(series, "attitude", 1, at(100));
  series.close();
  const Contents before = contents_of(shelf.disks.at("boat.mcap").bytes);
  CHECK(before.ending == McapEnding::kWhole);
  CHECK(before.about.at("now") == "1");
  const Contents after = contents_of(shelf.disks.at("boat-2.mcap").bytes);
  CHECK(after.sequences.count("raw/mission_definition") == 0);
  CHECK(after.about.at("now") == "2");
}

TEST_CASE("file series: below the floor nothing is written until there is room again",
          "[recording]") {
  Shelf shelf;
  shelf.options.free_floor_bytes = std::uint64_t{1} << 30;
  FileSeries series = shelf.series();
  publish(series, "attitude", 1, at(1000));
  static_cast<void>(series.news());
  shelf.free_bytes = (std::uint64_t{1} << 30) - 1;
  series.tick(at(2500));
  CHECK(series.state() == SeriesState::kNoRoom);
  const auto news = series.news();
  REQUIRE(news.size() == 2);
  CHECK(news[0] == "recording stops: only 1023 MiB are free");
  CHECK(news[1] == "closed boat.mcap");
  publish(series, "attitude", 2, at(2600));
  publish(series, "attitude", 3, at(2700));
  shelf.free_bytes = std::uint64_t{1} << 30;  // not enough to go on
  series.tick(at(4000));
  CHECK(series.state() == SeriesState::kNoRoom);
  shelf.free_bytes = std::uint64_t{1} << 31;
  series.tick(at(6000));
  publish(series, "attitude", 4, at(6100));
  series.close();
  CHECK(contents_of(shelf.disks.at("boat.mcap").bytes).ending == McapEnding::kWhole);
  const Contents after = contents_of(shelf.disks.at("boat-2.mcap").bytes);
  CHECK(after.sequences.at("raw/attitude") == std::vector<std::uint32_t>{4});
  REQUIRE(after.gaps.size() == 1);
  CHECK(after.gaps[0]["channel"] == "attitude");
  CHECK(after.gaps[0]["first"] == 2);
  CHECK(after.gaps[0]["last"] == 3);
  CHECK(after.gaps[0]["cause"] == "not_written");
  CHECK(series.lost() == 2);
  CHECK(series.recorded() == 2);
}

TEST_CASE("file series: a disk that fails costs the last chunk, which the next file tells",
          "[recording]") {
  for (const int error : {ENOSPC, EIO}) {
    Shelf shelf;
    FileSeries series = shelf.series();
    publish(series, "attitude", 1, at(0));
    series.tick(at(1000));  // on the disk
    Disk& disk = shelf.disks.at("boat.mcap");
    disk.room_bytes = disk.bytes.size() + 50;
    disk.full_error = error;
    publish(series, "attitude", 2, at(1100));
    publish(series, "attitude", 3, at(1200));
    series.tick(at(2000));
    CHECK(series.state() == SeriesState::kNoRoom);
    const Contents before = contents_of(disk.bytes);
    CHECK(before.sequences.at("raw/attitude") == std::vector<std::uint32_t>{1});
    CHECK(before.ending == McapEnding::kCutOff);
    CHECK_FALSE(disk.kept);
    series.tick(at(20'000));  // it is tried again
    publish(series, "attitude", 4, at(20'100));
    series.close();
    const Contents after = contents_of(shelf.disks.at("boat-2.mcap").bytes);
    CHECK(after.sequences.at("raw/attitude") == std::vector<std::uint32_t>{4});
    REQUIRE(after.gaps.size() == 1);
    CHECK(after.gaps[0]["count"] == 2);
    CHECK(series.lost() == 2);
    CHECK(series.recorded() == 2);
  }
}

TEST_CASE("file series: what does not fit when a file is closed is told in the next",
          "[recording]") {
  Shelf shelf;
  int next_error = 0;
  FileSeries series{shelf.options,
                    {},
                    [&](const std::filesystem::path& path) {
                      return std::make_unique<OnceFailingFile>(shelf.disks[path.string()],
                                                               next_error);
                    },
                    [] { return std::uint64_t{1} << 40; }};
  publish(series, "attitude", 1, at(0));
  series.tick(at(1000));
  publish(series, "attitude", 2, at(1100));
  next_error = ENOSPC;
  series.close();
  const Disk& disk = shelf.disks.at("boat.mcap");
  CHECK(disk.kept);
  const Contents before = contents_of(disk.bytes);
  CHECK(before.ending == McapEnding::kWhole);
  CHECK(before.sequences.at("raw/attitude") == std::vector<std::uint32_t>{1});
  CHECK(series.has_failed());
  CHECK(series.failure().find("boat.mcap") == 0);
  CHECK(series.lost() == 1);
  CHECK(series.recorded() == 1);
  publish(series, "attitude", 3, at(1200));
  series.close();
  const Contents after = contents_of(shelf.disks.at("boat-2.mcap").bytes);
  REQUIRE(after.gaps.size() == 1);
  CHECK(after.gaps[0]["first"] == 2);
  CHECK(after.gaps[0]["last"] == 2);
}

TEST_CASE("file series: what a disk does not sync is told in the next file", "[recording]") {
  Shelf shelf;
  FileSeries series = shelf.series();
  publish(series, "attitude", 1, at(0));
  series.tick(at(1000));
  publish(series, "attitude", 2, at(1100));
  shelf.disks.at("boat.mcap").sync_error = EIO;
  series.tick(at(2100));
  CHECK(series.state() == SeriesState::kNoRoom);
  CHECK(series.lost() == 1);
  CHECK(series.recorded() == 1);
  series.tick(at(20'000));
  publish(series, "attitude", 3, at(20'100));
  series.close();
  const Contents after = contents_of(shelf.disks.at("boat-2.mcap").bytes);
  REQUIRE(after.gaps.size() == 1);
  CHECK(after.gaps[0]["first"] == 2);
  CHECK(after.gaps[0]["last"] == 2);
}

TEST_CASE("file series: what is said again is not lost with the file that says it again",
          "[recording]") {
  Shelf shelf;
  shelf.options.said_again = {"mission_definition"};
  FileSeries series = shelf.series();
  publish(series, "mission_definition", 1, at(0));
  publish(series, "attitude", 1, at(10));
  series.close();
  publish(series, "attitude", 2, at(100));
  Disk& disk = shelf.disks.at("boat-2.mcap");
  disk.room_bytes = disk.bytes.size() + 50;
  series.tick(at(2000));
  CHECK(series.state() == SeriesState::kNoRoom);
  CHECK(series.lost() == 1);
  CHECK(series.recorded() == 2);
}

TEST_CASE("file series: gaps of another blackboard are no gaps of this one, but are said",
          "[recording]") {
  Shelf shelf;
  shelf.options.free_floor_bytes = 1;
  shelf.free_bytes = 0;
  FileSeries series = shelf.series();
  publish(series, "attitude", 7, at(0));
  publish(series, "attitude", 8, at(10));
  static_cast<void>(series.news());
  series.begin_anew();
  const auto news = series.news();
  REQUIRE(news.size() == 1);
  CHECK(news[0].find("2 publications") == 0);
  shelf.free_bytes = std::uint64_t{1} << 40;
  series.tick(at(2000));
  publish(series, "attitude", 1, at(2100));
  series.close();
  CHECK(contents_of(shelf.disks.at("boat.mcap").bytes).gaps.empty());
  CHECK(series.lost() == 2);
}

TEST_CASE("file series: a gap that is handed on stands in the file", "[recording]") {
  Shelf shelf;
  FileSeries series = shelf.series();
  series.add(Gap{channel_named("sonar_ping"), GapCause::kQueueFull, 7, 9}, at(100));
  series.close();
  const Contents contents = contents_of(shelf.disks.at("boat.mcap").bytes);
  REQUIRE(contents.gaps.size() == 1);
  CHECK(contents.gaps[0]["channel"] == "sonar_ping");
  CHECK(contents.gaps[0]["count"] == 3);
  CHECK(contents.gaps[0]["cause"] == "queue_full");
  CHECK(series.lost() == 3);
}

TEST_CASE("file series: where no file can be made all is counted and tried again", "[recording]") {
  bool broken = true;
  Disk disk;
  SeriesOptions options;
  options.first = "boat.mcap";
  FileSeries series{options,
                    {},
                    [&](const std::filesystem::path&) -> std::unique_ptr<RecordFile> {
                      if (broken) {
                        throw StartupError("boat.mcap: cannot be made");
                      }
                      return std::make_unique<MemoryFile>(disk);
                    },
                    [] { return std::uint64_t{1} << 40; }};
  publish(series, "attitude", 1, at(0));
  CHECK(series.state() == SeriesState::kNoRoom);
  broken = false;
  series.tick(at(20'000));
  publish(series, "attitude", 2, at(20'001));
  series.close();
  CHECK(contents_of(disk.bytes).gaps.size() == 1);
}
