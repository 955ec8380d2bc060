// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/recover_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "deploy/boat/version.h"
#include "deploy/operator/bench/file_check.h"
#include "deploy/operator/cli/common_options.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/recording/mcap_recover.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

struct RecoverOptions {
  CommonOptions common;
  std::string file;
  std::string out;
};

// What was never given its name gets it; what has one gets another beside it.
[[nodiscard]] fs::path name_for(const fs::path& file) {
  if (file.extension() == ".part") {
    return file.parent_path() / file.stem();
  }
  return file.parent_path() / (file.stem().string() + "-recovered" + file.extension().string());
}

// A finished file beside the old one. Throws StartupError where it cannot be written.
[[nodiscard]] McapRecovery write_to(const fs::path& out, McapSource& source) {
  // Not the name of the old one with `.part` behind it, which may be the old one itself.
  const fs::path beside = out.string() + ".recovering";
  const auto refuse = [&](int error) {
    std::error_code ignored;
    fs::remove(DiskFile::part_of(beside), ignored);
    fs::remove(beside, ignored);
    throw std::system_error(error, std::generic_category(), out.string());
  };
  std::error_code error;
  if (fs::exists(fs::symlink_status(out, error))) {
    throw StartupError(out.string() + ": is there already; --out names another");
  }
  DiskFile file{beside};
  McapWriter writer{file, std::string{"lodesman recover "} + kVersion};
  const McapRecovery recovery = recover(source, writer);
  const int failed = writer.fault() != 0 ? writer.fault() : file.keep();
  if (failed != 0) {
    refuse(failed);
  }
  // link() never writes over a file that came meanwhile.
  fs::create_hard_link(beside, out, error);
  if (error) {
    refuse(error.value());
  }
  fs::remove(beside, error);
  return recovery;
}

void print(const RecoverOptions& options, const McapRecovery& recovery, const fs::path& out) {
  const bool is_whole = recovery.ending == McapEnding::kWhole;
  if (options.common.json) {
    nlohmann::ordered_json json{{"file", options.file}, {"whole", is_whole}};
    json["out"] = is_whole ? nlohmann::ordered_json{} : nlohmann::ordered_json{out.string()};
    json["reason"] = is_whole ? nlohmann::ordered_json{} : nlohmann::ordered_json{recovery.reason};
    json["messages"] = recovery.messages;
    json["chunks"] = recovery.chunks;
    json["damaged"] = recovery.damaged;
    json["lost_bytes"] = recovery.lost_bytes;
    fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  if (options.common.quiet) {
    return;
  }
  if (is_whole) {
    fmt::print("{}: is whole: {} messages, nothing to do\n", options.file, recovery.messages);
    return;
  }
  fmt::print("{}: {}\n{}: {} messages from {} chunks; {} bytes at the end could not be used\n",
             options.file, recovery.reason, out.string(), recovery.messages, recovery.chunks,
             recovery.lost_bytes);
  if (recovery.damaged > 0) {
    fmt::print("{} records or chunks failed their checks and are left out\n", recovery.damaged);
  }
}

[[nodiscard]] int recover_file(const RecoverOptions& options) {
  refuse_bad_configuration(options.common);
  McapFileSource source{options.file};
  if (source.is_being_written()) {
    throw StartupError(options.file + ": is still being written");
  }
  const McapRecovery before = look_through(source);
  if (before.ending == McapEnding::kWhole && before.damaged == 0) {
    print(options, before, {});
    return kExitDone;
  }
  if (before.chunks == 0 && before.messages == 0 && before.ending == McapEnding::kDamaged) {
    throw StartupError(options.file + ": " + before.reason);
  }
  const fs::path out = options.out.empty() ? name_for(options.file) : fs::path{options.out};
  print(options, write_to(out, source), out);
  return kExitDone;
}

}  // namespace

void add_recover_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<RecoverOptions>();
  CLI::App* command =
      root.add_subcommand("recover", "Close a recording that was cut off, in a file beside it");
  command->add_option("FILE", options->file, "The recording")->required();
  command
      ->add_option("--out", options->out,
                   "The new file [without .part, or with -recovered in its name]")
      ->type_name("FILE");
  add_common_options(*command, options->common);
  command->footer(
      "All that is whole is taken over; FILE stays as it is. A file that is whole is left alone.\n"
      "Example: lodesman recover runs/pond/mission.mcap.part");
  command->callback([options, &exit_status] { exit_status = recover_file(*options); });
}

}  // namespace lodesman::cli
