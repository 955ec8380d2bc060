// SPDX-License-Identifier: Apache-2.0
// The commands that read files, end to end: what they take from a command line, and what they do
// with the rest where one file is bad.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "low_level/sonar/view_colours.h"
#include "tests/support/rgb_picture.h"
#include "tests/system/program_bench.h"

namespace lodesman::testing {
namespace {

using Words = std::vector<std::string>;

// A polar frame of 120 beams by 500 bins with nothing in it.
[[nodiscard]] std::string empty_frame() {
  return "P5\n120 500\n255\n" + std::string(120 * 500, '\0');
}

// The same with a bright patch straight ahead, from bin 200 on: 12 m at 30 m.
[[nodiscard]] std::string frame_with_a_patch() {
  std::string frame = empty_frame();
  for (std::size_t bin = 200; bin < 220; ++bin) {
    std::fill_n(frame.end() - 120 * 500 + static_cast<std::ptrdiff_t>(bin * 120 + 56), 8, '\xc8');
  }
  return frame;
}

constexpr const char* kOverlay = "[zones]\nmargin_m = 0.9\n";
const Words kSonar{"--range-m", "30", "--sector-deg", "120"};

[[nodiscard]] Words segment_of(const Words& words) {
  Words all{"segment", "--json"};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

[[nodiscard]] Words files_in(const Outcome& outcome, const char* list) {
  Words files;
  const auto document = nlohmann::json::parse(outcome.out, nullptr, false);
  for (const auto& entry : document.value(list, nlohmann::json::array())) {
    files.push_back(entry.at("file"));
  }
  return files;
}

TEST_CASE("file commands: a number that is none or out of range is refused by its option",
          "[system]") {
  const std::vector<std::pair<std::string, Words>> options{{"--range-m", {"--sector-deg", "120"}},
                                                           {"--sector-deg", {"--range-m", "30"}},
                                                           {"--threshold", kSonar},
                                                           {"--radius-px", kSonar}};
  for (const auto& [option, others] : options) {
    for (const std::string value : {"nan", "-nan", "inf", "1e999", "-1", "1e9", "", "ten", "3 "}) {
      INFO(option << " '" << value << "'");
      Bench bench;
      bench.write("a.pgm", empty_frame());
      Words words{"a.pgm", option, value};
      words.insert(words.end(), others.begin(), others.end());
      const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(words));
      CHECK(outcome.status == 2);
      CHECK(outcome.out.empty());
      CHECK(outcome.error.find(option) != std::string::npos);
      CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
    }
  }
}

TEST_CASE("file commands: a pair that is not two numbers in range is refused by its option",
          "[system]") {
  for (const std::string option : {"--apex-px", "--plan"}) {
    for (const std::string value :
         {"nan,nan", "0,nan", "inf,1", "1e300,1", "5", "5,", ",5", "1,2,3", "1;2", ""}) {
      INFO(option << " '" << value << "'");
      Bench bench;
      bench.write("a.pgm", empty_frame());
      Words words{"a.pgm", "--layout", "fan", option, value};
      words.insert(words.end(), kSonar.begin(), kSonar.end());
      const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(words));
      CHECK(outcome.status == 2);
      CHECK(outcome.error.find(option) != std::string::npos);
      CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
    }
  }
}

TEST_CASE("file commands: an option takes one value and leaves the files to the command",
          "[system]") {
  const std::vector<Words> options{
      {"--config", "over.toml"}, {"--set", "segmentation.threshold=60.0"},
      {"--plan", "0,3"},         {"--plan", "-3.5,-2"},
      {"--apex-px", "60,499"},   {"--config", "over.toml", "--config", "over.toml"}};
  for (const Words& option : options) {
    INFO(option[0]);
    Bench bench;
    bench.write("over.toml", kOverlay);
    bench.write("a.pgm", empty_frame());
    bench.write("b.pgm", empty_frame());
    Words words = kSonar;
    words.insert(words.end(), option.begin(), option.end());
    words.insert(words.end(), {"a.pgm", "b.pgm"});
    const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(words));
    CHECK(outcome.status == 0);
    CHECK(files_in(outcome, "frames") == Words{"a.pgm", "b.pgm"});
  }
  Bench bench;
  bench.write("over.toml", kOverlay);
  bench.write("second.toml", kOverlay);
  const Outcome outcome = bench.run(
      LODESMAN_PROGRAM, {"check", "--json", "--config", "over.toml", "second.toml", "over.toml"});
  CHECK(outcome.status == 0);
  CHECK(files_in(outcome, "files") == Words{"second.toml", "over.toml"});
}

TEST_CASE("file commands: a frame that cannot be read is named and the others are read",
          "[system]") {
  Bench bench;
  bench.write("a.pgm", empty_frame());
  bench.write("bad.pgm", "P5 120 500 255\nabc");
  bench.write("b.pgm", empty_frame());
  Words words{"a.pgm", "bad.pgm", "gone.pgm", "b.pgm"};
  words.insert(words.end(), kSonar.begin(), kSonar.end());
  words.push_back("--quiet");
  const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(words));
  CHECK(outcome.status == 2);
  CHECK(files_in(outcome, "frames") == Words{"a.pgm", "b.pgm"});
  CHECK(outcome.error ==
        "bad.pgm:1: image: the image is truncated\ngone.pgm:1: image: no such file\n");
}

TEST_CASE("file commands: a directory's frames are a sequence whose overlays show tracks and water",
          "[system]") {
  constexpr int kBesideColumn = 383;  // 3 m to port, 12 m ahead
  constexpr int kBesideRow = 299;
  const auto is_hatched = [](const RgbPicture& picture) {
    return picture.count_near(kBesideColumn, kBesideRow, 9, view_colours::kHatch) > 20;
  };
  const auto is_tracked = [](const RgbPicture& picture) {
    return picture.count_near(433, 290, 30, view_colours::kTrack) > 20;
  };
  Bench bench;
  Words words{"--overlay", "out", "--quiet", "frames"};
  for (const std::string name : {"f10.pgm", "f9.PGM", "f8.pgm", "f7.pgm"}) {
    bench.write("frames/" + name, frame_with_a_patch());
  }
  bench.write("frames/notes.txt", "no frame");
  words.insert(words.end(), kSonar.begin(), kSonar.end());
  const auto last = [&](const Words& more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(all));
    REQUIRE(outcome.status == 0);
    CHECK(files_in(outcome, "frames") ==
          Words{"frames/f7.pgm", "frames/f8.pgm", "frames/f9.PGM", "frames/f10.pgm"});
    return RgbPicture{bench.left_in("out/f10.png")};
  };
  const RgbPicture tracked = last({"--track"});
  CHECK(tracked.columns() == 866);
  CHECK_FALSE(is_hatched(tracked));
  CHECK(is_tracked(tracked));
  CHECK(is_hatched(RgbPicture{bench.left_in("out/f7.png")}));  // one look is no proof

  CHECK(is_tracked(last({"--track", "--layers", "tracks"})));
  CHECK_FALSE(is_tracked(last({"--track", "--layers", "echoes,water"})));
  CHECK_FALSE(is_tracked(last({})));
}

TEST_CASE("file commands: a directory without frames is refused", "[system]") {
  Bench bench;
  bench.write("frames/notes.txt", "no frame");
  Words words{"frames"};
  words.insert(words.end(), kSonar.begin(), kSonar.end());
  const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(words));
  CHECK(outcome.status == 2);
  CHECK(outcome.error == "frames:1: image: the directory has no PGM, PNG or JPEG file\n");
}

TEST_CASE("file commands: of a frame one is told the time it took, and of a track its number",
          "[system]") {
  Bench bench;
  Words words{"--track", "frames"};
  for (const std::string name : {"f1.pgm", "f2.pgm", "f3.pgm"}) {
    bench.write("frames/" + name, frame_with_a_patch());
  }
  words.insert(words.end(), kSonar.begin(), kSonar.end());
  const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(words));
  const auto document = nlohmann::json::parse(outcome.out, nullptr, false);
  REQUIRE(document.value("frames", nlohmann::json::array()).size() == 3);
  std::vector<unsigned> ids;
  for (const auto& frame : document["frames"]) {
    CHECK(frame.at("us") > 0.0);
    REQUIRE(frame.at("obstacles").size() == 1);
    ids.push_back(frame["obstacles"][0].at("id"));
    CHECK(frame["obstacles"][0].at("surely_moves") == false);
  }
  CHECK(ids[0] > 0);
  CHECK(ids == std::vector<unsigned>(3, ids[0]));
}

TEST_CASE("file commands: layers that there are not are refused by their option", "[system]") {
  const std::vector<Words> rows{{"--overlay", "out", "--layers", "everything"},
                                {"--overlay", "out", "--layers", "echoes,,water"},
                                {"--overlay", "out", "--layers", "bright"},  // by contrast
                                {"--layers", "echoes"}};
  for (const Words& row : rows) {
    INFO(row.back());
    Bench bench;
    bench.write("a.pgm", empty_frame());
    Words words = kSonar;
    words.insert(words.end(), row.begin(), row.end());
    words.emplace_back("a.pgm");
    const Outcome outcome = bench.run(LODESMAN_PROGRAM, segment_of(words));
    CHECK(outcome.status == 2);
    CHECK(outcome.error.find("--layers") != std::string::npos);
    CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
    CHECK(bench.untouched());
  }
}

TEST_CASE("file commands: check has a word for a file that says nothing", "[system]") {
  for (const std::string text : {"", "\n\n", "# nothing but a remark\n"}) {
    Bench bench;
    bench.write("a.toml", text);
    const Outcome outcome = bench.run(LODESMAN_PROGRAM, {"check", "a.toml"});
    CHECK(outcome.status == 2);
    CHECK(outcome.error == "a.toml:1: file: says nothing\n");
  }
}

}  // namespace
}  // namespace lodesman::testing
