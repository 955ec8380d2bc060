// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_line.h"

#include <nlohmann/json.hpp>

#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {

void command_line(std::string_view input) {
  using nlohmann::json;
  for (const std::string token : {"", "secret"}) {
    const CommandLine read = read_command_line(std::string{input}, {token, "", ""});
    if (read.refusal.empty()) {
      const json request = json::parse(input);
      require(!token.empty() && request.at("token") == token,
              "a command is served without its token");
      require(request.at("command") == read.request.command,
              "another command is served than was given");
      continue;
    }
    const json reply = json::parse(read.refusal, nullptr, false);
    require(reply.is_object() && read.refusal.find('\n') == std::string::npos,
            "a refusal is no JSON document on one line");
    require(reply.at("ok") == false && read.request.command.empty(), "what is refused is served");
  }
}

}  // namespace lodesman::fuzz
