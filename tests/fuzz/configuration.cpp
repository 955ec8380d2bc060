// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "deploy/boat/configuration.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/outside_file.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {
namespace {

// Other processes are handed the whole configuration as a text: it must say the same there.
void require_handed_on(const BoatConfig& accepted) {
  const std::string text = accepted.to_text();
  try {
    const OutsideFile file{text};
    CommonOptions options;
    options.config_files = {file.path()};
    require(load_configuration("default", options).to_text() == text,
            "a configuration changes when it is handed on");
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
