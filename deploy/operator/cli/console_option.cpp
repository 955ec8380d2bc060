// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/console_option.h"

#include <unistd.h>

#include <charconv>

namespace lodesman::cli {
namespace {

// 0 where it is none.
[[nodiscard]] std::uint16_t port_in(const std::string& text) noexcept {
  std::uint16_t port = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, port);
  return parsed.ec == std::errc{} && parsed.ptr == end ? port : std::uint16_t{0};
}

}  // namespace

void add_console_option(CLI::App& command, std::string& console) {
  command
      .add_option("--console", console,
                  "The page in a browser: a port, on, off [auto: on where standard error is a "
                  "terminal]")
      ->type_name("PORT")
      ->check([](const std::string& text) {
        const bool is_word = text == kConsoleAuto || text == "off" || text == "on";
        return is_word || port_in(text) != 0 ? std::string{} : "must be a port, on, off or auto";
      });
}

std::optional<ConsoleBeside> console_beside(const std::string& console, std::uint16_t configured,
                                            bool quiet) {
  if (const std::uint16_t port = port_in(console); port != 0) {
    return ConsoleBeside{port, false};
  }
  const bool wanted =
      console == "on" || (console == kConsoleAuto && !quiet && isatty(STDERR_FILENO) != 0);
  return wanted ? std::optional{ConsoleBeside{configured, true}} : std::nullopt;
}

}  // namespace lodesman::cli
