// SPDX-License-Identifier: Apache-2.0
// The black box on real runs: whole in real time and in lock-step, readable however it ended, and
// read by its format's own makers.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/catch.h"
#include "tests/support/node_packages.h"
#include "tests/system/program.h"
#include "tests/system/recording_contents.h"

using namespace lodesman;
using namespace lodesman::testing;
using nlohmann::json;

namespace {

// In lock-step nothing is missing from the first publication on.
void check_whole(const Contents& contents) {
  check_told(contents);
  CHECK(contents.gaps.empty());
  for (const auto& [channel, numbers] : contents.numbers) {
    INFO(channel);
    CHECK(told_by(numbers).first == 1);
  }
}

[[nodiscard]] json result_of(const fs::path& run) {
  return json::parse(std::ifstream{run / "result.json"});
}

// 50 by hand, as docs/recording.md has it; each takes some two seconds.
[[nodiscard]] int kills() {
  const char* told = std::getenv("LODESMAN_KILLS");  // NOLINT(concurrency-mt-unsafe): nobody writes
  return told == nullptr ? 8 : std::atoi(told);
}

// A disk that is small is no disk that is full.
constexpr const char* kAnyDisk = "recorder.free_floor_mib=0";

// A recorder of a boat's segment.
struct Recorder {
  Recorder(const Boat& boat, const fs::path& out) : part{DiskFile::part_of(out)}, file{out} {
    auto arguments = boat.arguments;
    arguments.insert(arguments.end(), {"--out", out.string(), "--set", kAnyDisk});
    program.emplace(program_directory() / "lodesman-recorder", arguments);
  }
  // Waits until it has what a boat under way publishes.
  [[nodiscard]] bool is_at_work() const {
    return eventually([&] {
      if (!fs::exists(part)) {
        return false;
      }
      const Contents contents = contents_of(part);
      return contents.count("raw/vehicle_state") > 0 &&
             contents.numbers.size() >= kChannelsUnderWay;
    });
  }

  fs::path part;
  fs::path file;
  std::optional<Program> program;
};

constexpr const char* kMakersReader = "@mcap/core";

// What it says of files.
[[nodiscard]] json read_by_makers(const std::vector<fs::path>& files) {
  std::string command = "node '" LODESMAN_MCAP_READER "' '" LODESMAN_MCAP_PACKAGES "'";
  for (const fs::path& file : files) {
    command += " '" + file.string() + "'";
  }
  std::FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  std::array<char, 4096> piece{};
  for (std::size_t size = 1; size > 0;) {
    size = std::fread(piece.data(), 1, piece.size(), pipe);
    output.append(piece.data(), size);
  }
  CHECK(pclose(pipe) == 0);
  return json::parse(output);
}

}  // namespace

TEST_CASE("recorder: a run in lock-step is recorded whole, and its hash is the same without",
          "[system]") {
  const Scratch scratch{"recorder"};
  const auto scenario = scratch.file("scenario.toml", scenario_text(80.0));
  const auto sail = [&](const char* name, std::vector<std::string> more) {
    more.insert(more.end(), {"--lockstep", "--quiet", "--time-limit", "12", "--set", kAnyDisk});
    const fs::path out = scratch.file(name);
    Program run{program("lodesman"), sim(scenario, out, more)};
    CHECK(run.status() == 1);  // the time limit
    return out;
  };
  const fs::path with = sail("with", {"--record"});
  const fs::path without = sail("without", {});
  CHECK(result_of(with)["recording_hash"] == result_of(without)["recording_hash"]);
  CHECK_FALSE(fs::exists(without / "mission.mcap"));
  const Contents contents = contents_of(with / "mission.mcap");
  CHECK(contents.ending == McapEnding::kWhole);
  check_whole(contents);
  CHECK(contents.count("raw/sonar_ping") >= 110);
  CHECK(contents.count("raw/vehicle_state") >= 240);
  CHECK(contents.about.at("boat") != "");
  CHECK(contents.attachments.at("scenario.toml").find("short") != std::string::npos);
  CHECK(contents.attachments.at("config.toml").find("[recorder]") != std::string::npos);
  // The shipped layout shows what there is.
  const json layout = json::parse(std::ifstream{LODESMAN_VIEWER_LAYOUT})["configById"];
  std::vector<std::string> shown{layout["Image!sonar"]["imageMode"]["imageTopic"],
                                 layout["RosOut!log"]["topicToRender"]};
  for (const auto& [topic, how] : layout["3D!scene"]["topics"].items()) {
    shown.push_back(topic);
  }
  CHECK(shown.size() == 4);
  for (const std::string& topic : shown) {
    INFO(topic);
    CHECK(contents.count(topic) > 0);
  }
}

TEST_CASE("recorder: a run in real time is recorded to the last publication of each channel",
          "[system]") {
  const Scratch scratch{"recorder"};
  const auto scenario = scratch.file("scenario.toml", scenario_text(80.0));
  const fs::path out = scratch.file("run");
  Program run{program("lodesman"),
              sim(scenario, out, {"--record", "--quiet", "--time-limit", "20", "--set", kAnyDisk})};
  const SharedBlackboard board = under_way(run);
  CHECK(run.status() == 1);  // the time limit
  const Contents contents = contents_of(out / "mission.mcap");
  CHECK(contents.ending == McapEnding::kWhole);
  // A machine that is busy may start the recorder after the boat; from then on all is told.
  check_told(contents);
  for_each_channel(*board, [&](const ChannelInfo& info, const auto& channel) {
    INFO(info.name);
    CHECK(told_by(contents.numbers_of(info.name)).last == channel.head.newest.load());
  });
}

TEST_CASE("recorder: killed at random times every file can be read, and is closed by recover",
          "[system]") {
  const Scratch scratch{"recorder"};
  const Boat boat{scratch, "default", scenario_text(80.0)};
  std::mt19937_64 random{20260926};
  std::vector<fs::path> parts;
  for (int i = 0; i < kills(); ++i) {
    INFO("kill " << i);
    const fs::path out = scratch.file("kill-" + std::to_string(i) + ".mcap");
    Recorder recorder{boat, out};
    REQUIRE(recorder.is_at_work());
    std::this_thread::sleep_for(milliseconds{random() % 1200});
    kill(recorder.program->pid(), SIGKILL);
    CHECK(recorder.program->status() == 128 + SIGKILL);
    CHECK_FALSE(fs::exists(out));
    const Contents before = contents_of(recorder.part);
    CHECK(before.ending == McapEnding::kCutOff);
    CHECK(before.chunks >= 1);
    check_told(before);
    // As a recovery that was killed itself leaves it.
    const fs::path left_over =
        scratch.file(out.filename().string() + ".recovering.part", "cut off");
    Program recover{program("lodesman"), {"recover", recorder.part.string(), "--quiet"}};
    CHECK(recover.status() == 0);
    CHECK_FALSE(fs::exists(left_over));
    const Contents after = contents_of(out);
    CHECK(after.ending == McapEnding::kWhole);
    CHECK(after.count("raw/attitude") == before.count("raw/attitude"));
    CHECK(after.attachments == before.attachments);
    parts.push_back(recorder.part);
  }
  if (!has_node_package(LODESMAN_MCAP_PACKAGES, kMakersReader)) {
    return;
  }
  const json said = read_by_makers(parts);
  CHECK(said["complaints"] == json::array());
  for (const fs::path& part : parts) {
    CHECK(said["files"][part.string()]["topics"]["raw/attitude"] ==
          contents_of(part).count("raw/attitude"));
  }
}

TEST_CASE("recorder: what is still being written is not recovered, and a whole file is left alone",
          "[system]") {
  const Scratch scratch{"recorder"};
  const Boat boat{scratch, "default", scenario_text(80.0)};
  Recorder recorder{boat, scratch.file("live.mcap")};
  REQUIRE(recorder.is_at_work());
  Program early{program("lodesman"), {"recover", recorder.part.string()}};
  CHECK(early.status() == 2);
  kill(recorder.program->pid(), SIGTERM);
  CHECK(recorder.program->status() == 0);
  CHECK_FALSE(fs::exists(recorder.part));
  const Contents contents = contents_of(recorder.file);
  CHECK(contents.ending == McapEnding::kWhole);
  check_told(contents);
  Program late{program("lodesman"), {"recover", recorder.file.string(), "--quiet"}};
  CHECK(late.status() == 0);
  CHECK_FALSE(fs::exists(scratch.file("live-recovered.mcap")));
}

TEST_CASE("recorder: when the low level is started anew the recording goes on", "[system]") {
  const Scratch scratch{"recorder"};
  Boat boat{scratch, "default", scenario_text(80.0)};
  Recorder recorder{boat, scratch.file("boat.mcap")};
  REQUIRE(recorder.is_at_work());
  boat.low.reset();  // ends, and with it its segment
  boat.start_low();
  const fs::path second = scratch.file("boat-2.mcap");
  REQUIRE(eventually([&] {
    return fs::exists(DiskFile::part_of(second)) &&
           contents_of(DiskFile::part_of(second)).count("raw/vehicle_state") > 0;
  }));
  kill(recorder.program->pid(), SIGTERM);
  CHECK(recorder.program->status() == 0);
  CHECK(contents_of(recorder.file).ending == McapEnding::kWhole);
  const Contents after = contents_of(second);
  CHECK(after.ending == McapEnding::kWhole);
  CHECK(told_by(after.numbers_of("attitude")).first == 1);
  check_told(after);
}

// A limit of the file's size fails as a full disk does, and needs no disk of the test's own.
TEST_CASE("recorder: a disk that is full costs what did not fit, which the next file tells",
          "[system]") {
  constexpr rlim_t kDisk_bytes = 200'000;
  const Scratch scratch{"recorder"};
  const Boat boat{scratch, "default", scenario_text(80.0)};
  auto arguments = boat.arguments;
  const fs::path out = scratch.file("full.mcap");
  arguments.insert(arguments.end(), {"--out", out.string(), "--set", kAnyDisk});
  Program recorder{program_directory() / "lodesman-recorder", arguments, [] {
                     const rlimit limit{kDisk_bytes, kDisk_bytes};
                     setrlimit(RLIMIT_FSIZE, &limit);
                   }};
  // Some seconds after the error another file is tried.
  const fs::path second = scratch.file("full-2.mcap");
  REQUIRE(eventually([&] {
    const fs::path part = DiskFile::part_of(second);
    return fs::exists(part) && contents_of(part).chunks > 0;
  }));
  kill(recorder.pid(), SIGTERM);
  CHECK(recorder.status() == 4);
  const auto left_of = [](const fs::path& file) {
    return fs::exists(file) ? file : DiskFile::part_of(file);
  };
  CHECK(fs::file_size(left_of(out)) <= kDisk_bytes);
  const Contents before = contents_of(left_of(out));
  CHECK(before.chunks > 0);
  check_told(before);
  const Contents after = contents_of(left_of(second));
  const auto gap = std::find_if(after.gaps.begin(), after.gaps.end(), [](const json& g) {
    return g["channel"] == "attitude" && g["cause"] == "not_written";
  });
  REQUIRE(gap != after.gaps.end());
  CHECK((*gap)["first"] > before.topics.at("raw/attitude").last);
  Numbers both = before.numbers_of("attitude");
  const Numbers later = after.numbers_of("attitude");
  both.insert(both.end(), later.begin(), later.end());
  CHECK(told_by(both).unbroken);
}

TEST_CASE("recorder: without a boat it ends with not yet, and without a place to write refuses",
          "[system]") {
  const Scratch scratch{"recorder"};
  Program lonely{program_directory() / "lodesman-recorder",
                 {"--segment", "lodesman-test-nobody", "--out", scratch.file("x.mcap").string()}};
  CHECK(lonely.status() == 75);
  CHECK_FALSE(fs::exists(scratch.file("x.mcap.part")));
  const fs::path nowhere = scratch.file("missing") / "x.mcap";
  Program homeless{program_directory() / "lodesman-recorder",
                   {"--segment", "lodesman-test-nobody", "--out", nowhere.string()}};
  CHECK(homeless.status() == 2);
}

TEST_CASE("recorder: the makers' own reader reads all of it with every CRC, cut off or whole",
          "[system]") {
  if (is_skipped_without(LODESMAN_MCAP_PACKAGES, kMakersReader)) {
    return;
  }
  const Scratch scratch{"recorder"};
  const auto scenario = scratch.file("scenario.toml", scenario_text(80.0));
  const fs::path out = scratch.file("run");
  Program run{program("lodesman"),
              sim(scenario, out,
                  {"--record", "--lockstep", "--quiet", "--time-limit", "12", "--set", kAnyDisk})};
  CHECK(run.status() == 1);
  const fs::path whole = out / "mission.mcap";
  const auto size = fs::file_size(whole);
  std::vector<fs::path> files{whole};
  for (const double share : {0.3, 0.7, 0.95}) {
    files.push_back(scratch.file("cut-" + std::to_string(files.size()) + ".mcap"));
    fs::copy_file(whole, files.back());
    fs::resize_file(files.back(), static_cast<std::uintmax_t>(share * static_cast<double>(size)));
  }
  const json said = read_by_makers(files);
  CHECK(said["complaints"] == json::array());
  for (const fs::path& file : files) {
    const json& seen = said["files"][file.string()];
    const Contents contents = contents_of(file);
    INFO(file.string());
    CHECK(seen["done"] == (file == whole));
    std::uint64_t messages = 0;
    for (const auto& [name, topic] : contents.topics) {
      CHECK(seen["topics"][name] == topic.count);
      messages += topic.count;
    }
    if (file == whole) {
      CHECK(seen["indexed"]["messages"] == messages);
      CHECK(seen["indexed"]["statistics"] == messages);
      CHECK(seen["indexed"]["metadata"]["lodesman"]["version"] != nullptr);
      CHECK(seen["indexed"]["attachments"]["config.toml"] ==
            contents.attachments.at("config.toml").size());
    }
  }
}
