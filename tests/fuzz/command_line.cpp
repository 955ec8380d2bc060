// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_line.h"

#include <nlohmann/json.hpp>

#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {

void command_line(std::string_view input) {
  using nlohmann::json;
  for (const std::string token : {"", "secret"}) {
    bool handled = false;
    const std::string reply = reply_to(std::string{input}, token, [&](const std::string& command) {
      handled = true;
      return json{{"ok", true}, {"did", command}}.dump();
    });
    const json read = json::parse(reply, nullptr, false);
    require(read.is_object() && reply.find('\n') == std::string::npos,
            "a reply is no JSON document on one line");
    require(read.at("ok") == handled, "a reply is not the handler's, or not a refusal");
    require(!handled || token.empty() || json::parse(input).at("token") == token,
            "a command is served without its token");
  }
}

}  // namespace lodesman::fuzz
