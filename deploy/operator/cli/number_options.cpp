// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/number_options.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace lodesman::cli {
namespace {

// Empty where the text is such a number, else what it must be. Written so that what is not a number
// is in no range.
[[nodiscard]] std::string fault_of(std::string_view text, double low, double high, double& value) {
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  const bool number = parsed.ec == std::errc{} && parsed.ptr == end;
  return number && value >= low && value <= high
             ? ""
             : fmt::format("must be a number from {} to {}", low, high);
}

}  // namespace

CLI::Validator number_from(double low, double high) {
  return {[low, high](std::string& text) {
            double value = 0.0;
            return fault_of(text, low, high, value);
          },
          fmt::format("{} to {}", low, high)};
}

CLI::Option* add_pair_option(CLI::App& command, const std::string& name,
                             std::optional<std::array<double, 2>>& pair, double low, double high,
                             const std::string& description) {
  return command.add_option_function<std::string>(
      name,
      [name, &pair, low, high](const std::string& text) {
        std::array<double, 2> values{};
        const auto comma = text.find(',');
        const std::string_view whole{text};
        if (comma == std::string::npos) {
          throw CLI::ValidationError(name, "must be two numbers with a comma between them");
        }
        for (const auto& [part, value] : {std::pair{whole.substr(0, comma), &values[0]},
                                          std::pair{whole.substr(comma + 1), &values[1]}}) {
          if (const std::string fault = fault_of(part, low, high, *value); !fault.empty()) {
            throw CLI::ValidationError(name, "each " + fault);
          }
        }
        pair = values;
      },
      description);
}

}  // namespace lodesman::cli
