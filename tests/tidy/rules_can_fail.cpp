// SPDX-License-Identifier: Apache-2.0
#include "tests/support/catch.h"
#include "tests/tidy/rules.h"

namespace lodesman::tidy {
namespace {

// A rule, a file that breaks it in the line named, and one that keeps it.
struct Row {
  Findings (*check)(const SourceFile& file);
  const char* bad_path;
  std::string bad;
  std::size_t line;
  const char* good_path;
  std::string good;
};

const std::string kLicence = "// SPDX-License-Identifier: Apache-2.0\n";

[[nodiscard]] std::string include_of(const std::string& header) {
  return "#include \"" + header + "\"\n";
}

void check_rows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    INFO(row.bad_path << "\n" << row.bad);
    const Findings findings = row.check({row.bad_path, row.bad});
    REQUIRE(findings.size() == 1);
    CHECK(
        findings[0].starts_with(std::string{row.bad_path} + ":" + std::to_string(row.line) + ": "));
    CHECK(row.check({row.good_path, row.good}).empty());
  }
}

TEST_CASE("tidy: forbidden arrows are seen", "[tidy]") {
  const auto row = [](const char* from, const char* to, const char* good) {
    return Row{include_arrows, from, kLicence + include_of(to), 2, from, include_of(good)};
  };
  check_rows({
      row("mid_level/base/a.h", "mid_level/messages/path.h", "mid_level/base/time.h"),
      row("mid_level/messages/a.h", "mid_level/blackboard/channel.h", "mid_level/base/time.h"),
      row("mid_level/blackboard/a.h", "mid_level/runtime/task.h", "mid_level/messages/path.h"),
      row("mid_level/recording/a.h", "mid_level/runtime/task.h", "mid_level/blackboard/channel.h"),
      row("drivers/hal/a.h", "mid_level/blackboard/channel.h", "mid_level/messages/path.h"),
      row("low_level/path/a.cpp", "low_level/sonar/blob.h", "mid_level/messages/path.h"),
      row("low_level/sonar/a.cpp", "mid_level/base/clock.h", "mid_level/base/time.h"),
      row("low_level/thrust/a.cpp", "mid_level/runtime/task.h", "mid_level/messages/command.h"),
      row("low_level/tasks/a.cpp", "high_level/mission/mission.h", "drivers/hal/devices.h"),
      row("low_level/tasks/a.cpp", "mid_level/base/clock.h", "mid_level/base/stopwatch.h"),
      row("low_level/tasks/a.cpp", "mid_level/runtime/run_realtime.h", "mid_level/runtime/task.h"),
      row("low_level/tasks/a.cpp", "deploy/boat/main_low.h", "low_level/path/grid.h"),
      row("high_level/tasks/a.cpp", "drivers/hal/devices.h", "high_level/mission/mission.h"),
      row("high_level/tasks/a.cpp", "hal_sim/world/world.h", "mid_level/base/geodesy.h"),
      row("high_level/control/a.cpp", "high_level/guidance/waypoints.h", "mid_level/base/time.h"),
      row("hal_sim/world/a.cpp", "low_level/thrust/thrust_map.h", "drivers/hal/devices.h"),
      row("hal_sim/devices/a.cpp", "mid_level/runtime/task.h", "mid_level/blackboard/channel.h"),
      row("hal_sim/scenario/a.cpp", "hal_sim/world/vessel.h", "mid_level/config/toml_document.h"),
      row("deploy/boat/a.cpp", "deploy/operator/run/watcher.h", "hal_sim/world/world.h"),
      row("deploy/boat/main_low.cpp", "low_level/path/grid.h", "low_level/tasks/low_level.h"),
      row("deploy/operator/report/a.cpp", "mid_level/blackboard/channel.h",
          "mid_level/messages/path.h"),
      row("deploy/operator/cli/a.cpp", "tests/support/catch.h", "low_level/path/grid.h"),
      row("high_level/mission/a.cpp", "high_level/tasks/planner.h", "mid_level/base/time.h"),
  });
  CHECK(include_arrows({"nowhere/a.cpp", include_of("mid_level/base/time.h")}).size() == 1);
  CHECK(include_arrows({"low_level/tasks_too/a.cpp", include_of("low_level/path/grid.h")}).size() ==
        1);
}

TEST_CASE("tidy: libraries outside their rooms are seen", "[tidy]") {
  check_rows({
      {library_rooms, "low_level/path/a.h", "#include <opencv2/core.hpp>\n", 1,
       "low_level/sonar/a.h", "#include <opencv2/core.hpp>\n"},
      {library_rooms, "hal_sim/world/a.cpp", "#include <toml++/toml.h>\n", 1,
       "mid_level/config/a.cpp", "#include <toml++/toml.h>\n"},
      {library_rooms, "low_level/tasks/a.cpp", "#include <spdlog/spdlog.h>\n", 1,
       "deploy/boat/main_low.cpp", "#include <spdlog/spdlog.h>\n"},
  });
}

TEST_CASE("tidy: words that have no place in a room are seen", "[tidy]") {
  const std::string truth = "Reader<WorldTruth> r;\n";
  check_rows({
      {fences, "mid_level/blackboard/a.h", "std::atomic_thread_fence(o);\n", 1,
       "mid_level/blackboard/a.h", "head.store(1, std::memory_order_release);\n"},
      {fences, "low_level/path/a.cpp", "\nstd::atomic_signal_fence(o);\n", 2,
       "low_level/path/a.cpp", "// atomic_signal_fence\nauto s = \"atomic_thread_fence\";\n"},
      {chance_in_tests, "tests/unit/a.cpp", "int x = rand();\n", 1, "tests/unit/a.cpp",
       "int x = operand(1);\n"},
      {chance_in_tests, "tests/unit/a.cpp", "std::random_device d;\n", 1, "tests/unit/a.cpp",
       "std::mt19937_64 r{seed};\n"},
      {conditionals, "low_level/path/a.h", "#ifdef SIMULATION\n", 1, "low_level/path/a.h",
       "#pragma once\n// #if\n"},
      {truth_readers, "low_level/tasks/a.cpp", truth, 1, "high_level/tasks/estimator.cpp", truth},
      {truth_readers, "high_level/tasks/planner.cpp", "board.world_truth;\n", 1,
       "hal_sim/world/world_task.cpp", "board.world_truth;\n"},
      {numbers_from_outside, "deploy/operator/cli/a.cpp", "o->check(CLI::Range(1.0, 2.0));\n", 1,
       "deploy/operator/cli/a.cpp", "o->check(number_from(1.0, 2.0));\n"},
      {machine_paths, "docs/a.md",
       "see /ho"
       "me/me/a\n",
       1, "docs/a.md", "see /dev/ttyUSB0\n"},
      {machine_paths, "a.cpp",
       "\nauto p = \"/wo"
       "rk/x\";\n",
       2, "a.cpp", "auto p = \"home/x\";\n"},
      {unfinished, "docs/a.md",
       "a\nTO"
       "DO: b\n",
       2, "docs/a.md", "to do: b\n"},
      {unfinished, "a.cpp",
       "// FIX"
       "ME\n",
       1, "a.cpp", "// mend me\n"},
  });
}

TEST_CASE("tidy: a test that does not wait for what it reads or wants a port of its own is seen",
          "[tidy]") {
  const std::string read = "CHECK(plan.latest()->value.id == 3);\n";
  const std::string waited = "CHECK(await_first(plan).value.id == 3);\n";
  const std::string port = "auto o = \"command_socket.";
  check_rows({
      {hasty_tests, "tests/system/a.cpp", read, 1, "tests/unit/a.cpp", read},
      {hasty_tests, "tests/system/a.cpp", "\n" + read, 2, "tests/system/a.cpp", waited},
      {hasty_tests, "tests/system/a.cpp", port + "port=17447\";\n", 1, "tests/system/a.cpp",
       port + "port=0\";\n"},
  });
}

TEST_CASE("tidy: what is too long is seen", "[tidy]") {
  const auto lines = [](std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
      text += "  g();\n";
    }
    return text;
  };
  check_rows({
      {long_lines, "a.h", "\n" + std::string(101, 'x') + "\n", 2, "a.h",
       std::string(100, 'x') + "\n"},
      {long_files, "a.cpp", lines(401), 401, "a.cpp", lines(400)},
  });
}

TEST_CASE("tidy: a missing licence line or opening is seen", "[tidy]") {
  const std::string body = "#pragma once\n";
  check_rows({
      {licence_line, "a.cpp", "int x;\n", 1, "a.cpp", kLicence},
      {licence_line, "x/CMakeLists.txt", "add_library(x)\n", 1, "notes.txt", "add_library(x)\n"},
      {licence_line, ".ci/run", "#!/bin/sh\nset -eu\n", 2, ".ci/run",
       "#!/bin/sh\n# SPDX-License-Identifier: Apache-2.0\n"},
      {header_opening, "low_level/path/a.h", kLicence + "// One sentence.\n" + body, 2,
       "low_level/path/a.h", kLicence + "// What it is. Any thread.\n" + body},
      {header_opening, "low_level/path/a.h", kLicence + "// What it is. Any thread.\nint x;\n", 3,
       "tests/a.h", kLicence + "// What it is.\n" + body},
  });
}

TEST_CASE("tidy: a message's field without a unit is seen", "[tidy]") {
  const char* place = "mid_level/messages/a.h";
  check_rows({
      {message_units, place, "struct A {\n  double x_m = 0.0;  // the east\n};\n", 2, place,
       "struct A {\n  double x_m = 0.0;  // [m] east\n};\n"},
      {message_units, place, "struct A {\n  // [m]\n  double x = 0.0;\n  float y{};\n};\n", 4,
       place, "struct A {\n  // [m]\n  double x = 0.0;\n  Shape s;\n};\n"},
      {message_units, place, "struct A {\n  std::array<std::uint8_t, 4> e{};\n};\n", 2, place,
       "struct A {\n  int f() {\n    int local = 0;\n    return local;\n  }\n};\n"},
      {message_units, place, "struct A {\n  bool f() const { return true; }\n  Time at{};\n};\n", 3,
       place, "struct A {\n  bool f() const { return true; }\n  Time at{};  // [ns]\n};\n"},
  });
}

TEST_CASE("tidy: a source file that no list names is seen", "[tidy]") {
  const SourceFile list{"low_level/CMakeLists.txt", "room(x a.cpp path/b.cpp)\n"};
  const SourceFile named{"low_level/a.cpp", ""};
  const SourceFile below{"low_level/path/b.cpp", ""};
  const SourceFile lost{"low_level/aa.cpp", ""};
  const SourceFile elsewhere{"high_level/a.cpp", ""};
  CHECK(unlisted_sources({list, named, below}).empty());
  CHECK(unlisted_sources({list, lost}).size() == 1);
  CHECK(unlisted_sources({list, elsewhere}).size() == 1);
}

TEST_CASE("tidy: a cited test that does not exist is seen", "[tidy]") {
  const SourceFile tests{"tests/unit/a.cpp",
                         "TEST_CASE(\"path: one is\"\n  \" found\", \"[x]\") {}\n"
                         "TEMPLATE_TEST_CASE(\"pump: \\\"it\\\" runs\", \"\", int) {}\n"};
  const auto findings = [&](const std::string& text) {
    return missing_tests({tests, {"docs/a.md", text}}).size();
  };
  CHECK(findings("see `path: one is found` and `path: one\nis found`\n") == 0);
  CHECK(findings("`pump: \"it\" runs`\n") == 0);
  CHECK(findings("\n`path: one is lost`\n") == 1);
  CHECK(findings("`path: one is` `path: two are found`\n") == 2);
  CHECK(findings("`file:line: key: reason`, `a.b: c d`, `name: word`, path: one two\n") == 0);
}

TEST_CASE("tidy: a threat without a test is seen", "[tidy]") {
  const SourceFile tests{"tests/a.cpp", "TEST_CASE(\"path: one is found\", \"[x]\") {}\n"};
  const auto findings = [&](const std::string& rows) {
    const std::string head = "| who | could | test |\n|---|---|---|\n";
    return threats_without_tests({tests, {"docs/security.md", head + rows}}).size();
  };
  CHECK(findings("| a | b | `path: one is found` |\n| the same | c | the same, `d` |\n") == 0);
  CHECK(findings("| a | b | `path: two are found` |\n| c | d | |\n| e | `f`, | by hand |\n") == 3);
  CHECK(findings("\n| a | table without tests |\n") == 0);
}

TEST_CASE("tidy: comments, literals and blocks are told from code", "[tidy]") {
  const SourceFile file{"a.cpp",
                        "int a = 1'000; /* { */ // }\nauto b = \"{\\\"\"; auto c = '{';\n"};
  CHECK(file.code.find('{') == std::string::npos);
  CHECK(file.code.find("1'000") != std::string::npos);
  const auto blocks = blocks_of("namespace n {\nclass C : D {\n  int f() const {\n  }\n};\n}\n");
  REQUIRE(blocks.size() == 3);
  CHECK(blocks[0].kind == BlockKind::kFunction);
  CHECK(blocks[1].kind == BlockKind::kType);
  CHECK(blocks[2].kind == BlockKind::kNamespace);
}

}  // namespace
}  // namespace lodesman::tidy
