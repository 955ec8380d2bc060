// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/ping_player.h"

#include <fstream>
#include <memory>

#include "mid_level/base/startup_error.h"
#include "mid_level/messages/sane.h"
#include "tests/support/catch.h"
#include "tests/support/delta_t_records.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman {
namespace {

using delta_t::BeamSign;
using delta_t::Header;
using delta_t::RecordKind;
using std::chrono::milliseconds;
using testing::ByteList;

// A record of that kind, written so many milliseconds after noon.
[[nodiscard]] ByteList record(RecordKind kind, std::uint32_t number, int after_ms) {
  Header h = testing::usual_header(kind, number);
  h.samples = 40;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "12:%02d:%02d", after_ms / 60000, after_ms / 1000 % 60);
  testing::set_text(h.time, text.data());
  std::snprintf(text.data(), text.size(), ".%03d", after_ms % 1000);
  testing::set_text(h.milliseconds, text.data());
  return kind == RecordKind::kImage ? testing::usual_image(h) : testing::usual_profile(h);
}

void write(const std::filesystem::path& file, const std::vector<ByteList>& records) {
  std::ofstream stream{file, std::ios::binary};
  for (const ByteList& bytes : records) {
    for (const std::uint8_t byte : bytes) {
      stream.put(static_cast<char>(byte));
    }
  }
}

struct Given {
  std::int64_t after_ms;
  PingKind kind;
  std::uint64_t number;

  friend bool operator==(const Given&, const Given&) = default;
};

// Polled every millisecond.
[[nodiscard]] std::vector<Given> played(PingPlayer& player, int span_ms) {
  const auto ping = std::make_unique<SonarPing>();
  const Time begin{std::chrono::seconds{50}};
  std::vector<Given> all;
  for (int ms = 0; ms <= span_ms; ++ms) {
    const Time now = begin + milliseconds{ms};
    if (player.poll(now, *ping) == ReadStatus::kFresh) {
      REQUIRE(sane(*ping));
      REQUIRE(ping->captured == now);
      all.push_back({ms, ping->kind, ping->number});
    }
  }
  return all;
}

constexpr PingKind kImage = PingKind::kImage;
constexpr PingKind kProfile = PingKind::kProfile;

TEST_CASE("ping player: files are played one after another, at the times that they carry",
          "[drivers]") {
  const testing::TemporaryDirectory folder;
  write(folder.path() / "b.83P", {record(RecordKind::kProfile, 4, 700)});
  write(folder.path() / "a.83b",
        {record(RecordKind::kImage, 1, 100), record(RecordKind::kImage, 2, 250),
         record(RecordKind::kImage, 3, 300)});
  write(folder.path() / "notes.txt", {{1, 2, 3}});
  PingPlayer player{folder.path(), BeamSign::kStarboard};
  CHECK(player.pings() == 4);
  CHECK(player.length() == milliseconds{600});
  CHECK(played(player, 1000) ==
        std::vector<Given>{{0, kImage, 1}, {150, kImage, 2}, {200, kImage, 3}, {600, kProfile, 4}});
  CHECK(player.skipped_bytes() == 0);
}

TEST_CASE("ping player: times that stand, run back or leave a long gap cost one repetition",
          "[drivers]") {
  const testing::TemporaryDirectory folder;
  write(folder.path() / "a.83P",
        {record(RecordKind::kProfile, 1, 1000), record(RecordKind::kProfile, 2, 1000),
         record(RecordKind::kProfile, 3, 500), record(RecordKind::kProfile, 4, 650),
         record(RecordKind::kProfile, 5, 60000), record(RecordKind::kProfile, 6, 60010)});
  PingPlayer player{folder.path(), BeamSign::kStarboard};
  CHECK(played(player, 1000) == std::vector<Given>{{0, kProfile, 1},
                                                   {100, kProfile, 2},
                                                   {200, kProfile, 3},
                                                   {350, kProfile, 4},
                                                   {450, kProfile, 5},
                                                   {460, kProfile, 6}});
}

TEST_CASE("ping player: of several that are due the newest is given, and the others are a gap",
          "[drivers]") {
  const testing::TemporaryDirectory folder;
  write(folder.path() / "a.83P",
        {record(RecordKind::kProfile, 1, 0), record(RecordKind::kProfile, 2, 100),
         record(RecordKind::kProfile, 3, 200)});
  PingPlayer player{folder.path(), BeamSign::kStarboard};
  const auto ping = std::make_unique<SonarPing>();
  const Time begin{std::chrono::seconds{50}};
  REQUIRE(player.poll(begin, *ping) == ReadStatus::kFresh);
  CHECK(ping->number == 1);
  REQUIRE(player.poll(begin + milliseconds{250}, *ping) == ReadStatus::kFresh);
  CHECK(ping->number == 3);
  CHECK(ping->captured == begin + milliseconds{200});
  CHECK(player.poll(begin + std::chrono::hours{1}, *ping) == ReadStatus::kNothingNew);
}

TEST_CASE("ping player: what is no record between records is skipped and counted", "[drivers]") {
  const testing::TemporaryDirectory folder;
  ByteList cut = record(RecordKind::kImage, 3, 200);
  cut.resize(1000);
  ByteList comment(200, '#');
  write(folder.path() / "a.83B",
        {record(RecordKind::kImage, 1, 0), comment, record(RecordKind::kImage, 2, 100), cut});
  PingPlayer player{folder.path(), BeamSign::kStarboard};
  CHECK(player.pings() == 2);
  CHECK(player.skipped_bytes() == 1200);
  CHECK(played(player, 300).size() == 2);
}

TEST_CASE("ping player: the beam sign is of the mounting, in a file too", "[drivers]") {
  const testing::TemporaryDirectory folder;
  write(folder.path() / "a.83P", {record(RecordKind::kProfile, 1, 0)});
  PingPlayer player{folder.path(), BeamSign::kPort};
  const auto ping = std::make_unique<SonarPing>();
  REQUIRE(player.poll(Time{std::chrono::seconds{1}}, *ping) == ReadStatus::kFresh);
  CHECK(ping->points[89].range_m > 0.0);
}

TEST_CASE("ping player: what is no recording is refused", "[drivers]") {
  const testing::TemporaryDirectory folder;
  const auto refuses = [&] {
    CHECK_THROWS_AS((PingPlayer{folder.path(), BeamSign::kStarboard}), StartupError);
  };
  CHECK_THROWS_AS((PingPlayer{folder.path() / "absent", BeamSign::kStarboard}), StartupError);
  refuses();  // empty
  write(folder.path() / "notes.txt", {record(RecordKind::kImage, 1, 0)});
  refuses();
  write(folder.path() / "a.83B", {});
  refuses();
  write(folder.path() / "a.83B", {ByteList(5000, '8')});
  refuses();
  write(folder.path() / "a.83B", {{0}, record(RecordKind::kImage, 1, 0)});
  refuses();
  write(folder.path() / "a.83B", {record(RecordKind::kImage, 1, 0)});
  CHECK(PingPlayer{folder.path(), BeamSign::kStarboard}.pings() == 1);
  CHECK_THROWS_AS((PingPlayer{folder.path() / "a.83B", BeamSign::kStarboard}), StartupError);
}

}  // namespace
}  // namespace lodesman
