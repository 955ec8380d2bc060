// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/recover_command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
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

// Gives a file its own name: 0, or the error's number. Never over one that came meanwhile.
[[nodiscard]] int rename_new(const fs::path& from, const fs::path& to) {
  if (link(from.c_str(), to.c_str()) == 0) {
    unlink(from.c_str());
    return 0;
  }
  if (errno == EEXIST) {
    return EEXIST;
  }
  // Where there are no links (FAT), and where there is not that either, a look and a rename.
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) {
    return 0;
  }
  if (errno != EINVAL && errno != ENOSYS) {
    return errno;
  }
  std::error_code error;
  if (fs::exists(fs::symlink_status(to, error))) {
    return EEXIST;
  }
  return rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

// Of a recovery that was killed; throws StartupError where one is still at it.
void remove_left_over(const fs::path& part) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(part, error))) {
    return;
  }
  if (!fs::is_regular_file(fs::symlink_status(part, error))) {
    throw StartupError(part.string() + ": is in the way");
  }
  if (McapFileSource{part.string()}.is_being_written()) {
    throw StartupError(part.string() + ": another recovery writes it");
  }
  fs::remove(part, error);
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
  remove_left_over(DiskFile::part_of(beside));
  remove_left_over(beside);
  DiskFile file{beside};
  McapWriter writer{file, std::string{"lodesman recover "} + kVersion};
  McapRecovery recovery = recover(source, writer);
  const int failed = writer.fault() != 0 ? writer.fault() : file.keep();
  if (failed != 0) {
    refuse(failed);
  }
  if (const int kept = rename_new(beside, out); kept != 0) {
    refuse(kept);
  }
  return recovery;
}

// [s] since the machine's start; nothing where there is no message.
[[nodiscard]] nlohmann::ordered_json seconds_json(const McapRecovery& recovery, std::uint64_t ns) {
  return recovery.messages == 0 ? nlohmann::ordered_json{}
                                : nlohmann::ordered_json(static_cast<double>(ns) * 1e-9);
}

void print_json(const RecoverOptions& options, const McapRecovery& recovery, bool is_whole,
                const fs::path& out) {
  nlohmann::ordered_json json{{"file", options.file}, {"whole", is_whole}};
  json["out"] = is_whole ? nlohmann::ordered_json{} : nlohmann::ordered_json{out.string()};
  json["reason"] = is_whole ? nlohmann::ordered_json{} : nlohmann::ordered_json{recovery.reason};
  json["messages"] = recovery.messages;
  json["chunks"] = recovery.chunks;
  json["damaged"] = recovery.damaged;
  json["lost_bytes"] = recovery.lost_bytes;
  json["first_s"] = seconds_json(recovery, recovery.first_ns);
  json["last_s"] = seconds_json(recovery, recovery.last_ns);
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print(const RecoverOptions& options, const McapRecovery& recovery, const fs::path& out) {
  const bool is_whole = recovery.ending == McapEnding::kWhole && recovery.damaged == 0;
  if (options.common.json) {
    print_json(options, recovery, is_whole, out);
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
  if (recovery.messages > 0) {
    fmt::print("of {:.3f} s to {:.3f} s since the machine's start\n",
               static_cast<double>(recovery.first_ns) * 1e-9,
               static_cast<double>(recovery.last_ns) * 1e-9);
  }
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
