// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/token_command.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "deploy/operator/cli/common_options.h"
#include "high_level/mission/token_file.h"

namespace lodesman::cli {

void add_token_command(CLI::App& root, int& exit_status) {
  struct TokenOptions {
    CommonOptions common;
    std::string file;
  };
  const auto options = std::make_shared<TokenOptions>();
  CLI::App* command =
      root.add_subcommand("token", "Make the file of tokens that commands a boat from ashore");
  command->add_option("--new", options->file, "Where there is no file yet; none is replaced")
      ->required()
      ->type_name("FILE");
  add_common_options(*command, options->common);
  command->footer(
      "Example: lodesman token --new /etc/lodesman/boat.token\n\n"
      "Three lines, each good for what the ones after it are good for: to command, to abort, to\n"
      "view. [command_socket] token_file of the boat names it; a copy goes ashore by a safe way.");
  command->callback([options, &exit_status] {
    make_token_file(options->file);
    if (options->common.json) {
      using Json = nlohmann::ordered_json;
      const Json document{{"file", options->file}};
      fmt::print("{}\n", document.dump(-1, ' ', false, Json::error_handler_t::replace));
    } else if (!options->common.quiet) {
      fmt::print("{}: three new tokens, to command, to abort, to view\n", options->file);
    }
    exit_status = kExitDone;
  });
}

}  // namespace lodesman::cli
