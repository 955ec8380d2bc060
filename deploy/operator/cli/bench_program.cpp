// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/bench_program.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "deploy/boat/exit_status.h"
#include "deploy/operator/cli/plot_command.h"
#include "deploy/operator/cli/replay_command.h"
#include "deploy/operator/cli/segment_command.h"
#include "deploy/operator/cli/sim_command.h"

namespace lodesman::cli {
namespace {

struct Word {
  std::string_view name;
  const char* description;
};

constexpr std::array kWords{Word{"sim", kSimDescription}, Word{"hil", kHilDescription},
                            Word{"segment", kSegmentDescription}, Word{"plot", kPlotDescription},
                            Word{"replay", kReplayDescription}};

}  // namespace

void name_bench_commands(CLI::App& root) {
  for (const Word& word : kWords) {
    root.add_subcommand(std::string{word.name}, word.description);
  }
}

bool is_bench_command(int argc, char** argv) {
  return argc > 1 && std::any_of(kWords.begin(), kWords.end(),
                                 [&](const Word& word) { return word.name == argv[1]; });
}

int go_on_as_bench(char** argv) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  std::string program = (self.parent_path() / "lodesman-bench").string();
  const char* word = argv[1];
  argv[0] = program.data();
  execv(program.c_str(), argv);
  std::fprintf(stderr, "lodesman %s: %s cannot be run (%s): is the package lodesman-bench there?\n",
               word, program.c_str(), std::generic_category().message(errno).c_str());
  return kExitRefused;
}

}  // namespace lodesman::cli
