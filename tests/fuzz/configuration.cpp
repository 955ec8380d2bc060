// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "deploy/boat/configuration.h"
#include "deploy/boat/level_options.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/outside_file.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {
namespace {

// Other processes are handed the whole configuration as a text: it must say the same there.
void require_handed_on(const TomlDocument& accepted) {
  const std::string text = accepted.to_text();
  try {
    const TomlDocument handed_on = TomlDocument::from_text(text, "handed-on.toml");
    (void)read_low_level_options(handed_on.root());
    (void)read_high_level_options(handed_on.root());
    (void)command_socket_settings(handed_on);
    (void)device_addresses(handed_on);
    (void)simulation_settings(handed_on);
    handed_on.require_all_keys_read();
    require(handed_on.to_text() == text, "a configuration changes when it is handed on");
  } catch (const StartupError& error) {
    throw Violation{std::string{"an accepted configuration is refused when handed on: "} +
                    error.what()};
  }
}

void load(const CommonOptions& options) {
  // Where the shipped configuration lies, wherever this program does.
  static const int kSet = setenv("LODESMAN_SHARE", LODESMAN_SOURCE_DIR, 1);
  require(kSet == 0, "no environment");
  accepted_or_refused([&] { require_handed_on(load_configuration("default", options)); });
}

}  // namespace

void configuration(std::string_view input) {
  const OutsideFile file{input};
  CommonOptions options;
  options.config_files = {file.path()};
  load(options);
}

void setting(std::string_view input) {
  CommonOptions options;
  options.sets = {std::string{input}};
  load(options);
}

}  // namespace lodesman::fuzz
