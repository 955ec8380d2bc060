// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/decode_command.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "deploy/operator/bench/file_check.h"
#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/decode/delta_t_lines.h"
#include "deploy/operator/decode/maestro_lines.h"
#include "deploy/operator/decode/nav440_lines.h"
#include "deploy/operator/decode/nmea_lines.h"
#include "deploy/operator/decode/roboclaw_lines.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

struct Protocol {
  const char* name;
  DecodeCounts (*lines)(std::span<const std::uint8_t> bytes,
                        const std::function<void(const nlohmann::ordered_json&)>& line);
};
constexpr std::array kProtocols{
    Protocol{"nav440", nav440_lines},   Protocol{"delta_t", delta_t_lines},
    Protocol{"maestro", maestro_lines}, Protocol{"roboclaw", roboclaw_lines},
    Protocol{"nmea", nmea_lines},
};

struct DecodeOptions {
  CommonOptions common;
  std::string protocol;
  std::string file;
};

// A day of a line at 57600 Bd is half of it.
constexpr std::size_t kMaxBytes = std::size_t{1} << 30U;

[[nodiscard]] std::vector<std::uint8_t> bytes_in(std::istream& stream, const std::string& name) {
  std::vector<std::uint8_t> bytes;
  std::array<char, 65536> piece{};
  do {
    stream.read(piece.data(), piece.size());
    const auto count = static_cast<std::size_t>(stream.gcount());
    if (count > kMaxBytes - bytes.size()) {
      throw StartupError(name + ": is larger than 1 GiB");
    }
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + stream.gcount());
  } while (stream);
  if (stream.bad()) {
    throw StartupError(name + ": cannot be read");
  }
  return bytes;
}

[[nodiscard]] std::vector<std::uint8_t> bytes_of(const std::string& file) {
  if (file == "-") {
    return bytes_in(std::cin, "standard input");
  }
  std::error_code error;
  std::ifstream stream{file, std::ios::binary};
  if (!stream || std::filesystem::is_directory(file, error)) {
    throw StartupError(file + ": cannot be read");
  }
  return bytes_in(stream, file);
}

[[nodiscard]] int decode(const DecodeOptions& options) {
  refuse_bad_configuration(options.common);
  const std::vector<std::uint8_t> bytes = bytes_of(options.file);
  for (const Protocol& protocol : kProtocols) {
    if (options.protocol == protocol.name) {
      const DecodeCounts counts = protocol.lines(bytes, [](const auto& line) {
        fmt::print("{}\n",
                   line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
      });
      if (!options.common.quiet) {
        fmt::print(stderr, "{}: {} packets, {} bytes skipped, {} packets refused\n", protocol.name,
                   counts.packets, counts.skipped_bytes, counts.refused);
      }
    }
  }
  return kExitDone;
}

}  // namespace

void add_decode_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<DecodeOptions>();
  CLI::App* command = root.add_subcommand("decode", "Say what recorded bytes of a device mean");
  std::vector<std::string> names;
  names.reserve(kProtocols.size());
  for (const Protocol& protocol : kProtocols) {
    names.emplace_back(protocol.name);
  }
  command->add_option("PROTOCOL", options->protocol, "What the device speaks")
      ->required()
      ->check(CLI::IsMember(names));
  command
      ->add_option("FILE", options->file,
                   "Its bytes, as they were on the line; - is standard input")
      ->required();
  add_common_options(*command, options->common);
  command->footer(
      "A JSON line a packet whose check holds; what was skipped on standard error.\n"
      "Example: lodesman decode nav440 ahrs.raw");
  command->callback([options, &exit_status] { exit_status = decode(*options); });
}

}  // namespace lodesman::cli
