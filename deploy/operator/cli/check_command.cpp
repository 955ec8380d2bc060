// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/check_command.h"

#include <fmt/format.h>

#include <memory>

#include "deploy/boat/configuration.h"
#include "deploy/operator/bench/file_check.h"
#include "deploy/operator/cli/common_options.h"

namespace lodesman::cli {
namespace {

struct CheckOptions {
  CommonOptions common;
  std::vector<std::string> files;
};

[[nodiscard]] int check(const CheckOptions& options) {
  (void)load_configuration("default", options.common);  // so that no file is blamed for it
  using Json = nlohmann::ordered_json;
  Json files = Json::array();
  int exit_status = kExitDone;
  for (const std::string& file : options.files) {
    const FileCheck result = check_file(file, options.common);
    files.push_back(result.to_json());
    if (!result.ok()) {
      exit_status = kExitRefused;
      fmt::print(stderr, "{}\n", result.error);
    } else if (!options.common.json && !options.common.quiet) {
      fmt::print("{}: ok\n", file);
    }
  }
  if (options.common.json) {
    const Json document{{"files", std::move(files)}};
    fmt::print("{}\n", document.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  return exit_status;
}

}  // namespace

void add_check_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      root.add_subcommand("check", "Validate configuration, mission and scenario files");
  command
      ->add_option(
          "FILE", options->files,
          "A file with [mission] is a scenario, one with [vessel] the vessel; any other is laid "
          "over default.toml")
      ->required();
  add_common_options(*command, options->common);
  command->footer("Example: lodesman check boat.toml scenarios/*.toml");
  command->callback([options, &exit_status] { exit_status = check(*options); });
}

}  // namespace lodesman::cli
