// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_line.h"

#include "tests/support/catch.h"

using namespace lodesman;

TEST_CASE("command line: a command with the token may be obeyed", "[high_level][mission]") {
  for (const char* line : {R"({"command":"start","token":"secret"})",
                           R"({"token":"secret","protocol":2,"command":"start","more":[]})"}) {
    const CommandLine read = read_command_line(line, {"secret", "", ""});
    CHECK(read.request.command == "start");
    CHECK(read.refusal.empty());
  }
}

TEST_CASE("command line: the guard is overridden by a word of its own alone",
          "[high_level][mission]") {
  const auto read = [](const std::string& more) {
    return read_command_line(R"({"command":"manual","token":"secret","surge":20)" + more + "}",
                             {"secret", "", ""});
  };
  CHECK_FALSE(read("").request.overrides_guard);
  CHECK_FALSE(read(R"(,"override":false)").request.overrides_guard);
  CHECK(read(R"(,"override":true)").request.overrides_guard);
  CHECK_FALSE(read(R"(,"override":1)").refusal.empty());
}

TEST_CASE("command line: without the token nothing may, not even where the token is empty",
          "[high_level][mission]") {
  for (const std::string token : {"secret", ""}) {
    for (const char* line :
         {R"({"command":"start"})", R"({"command":"start","token":""})",
          R"({"command":"start","token":"secre"})", R"({"command":"start","token":"secret "})",
          R"({"command":"start","token":5})", R"({"command":"start","token":null})"}) {
      const CommandLine read = read_command_line(line, {token, "", ""});
      CHECK(read.request.command.empty());
      CHECK(read.refusal == R"({"ok":false,"error":"wrong or missing token"})");
    }
  }
}

TEST_CASE("command line: another protocol is refused", "[high_level][mission]") {
  for (const char* protocol : {"0", "1", "1.5", "\"1\"", "null", "true", "[1]"}) {
    const std::string line =
        std::string{R"({"command":"abort","token":"secret","protocol":)"} + protocol + "}";
    CHECK(read_command_line(line, {"secret", "", ""}).refusal ==
          R"({"ok":false,"error":"this is protocol 2"})");
  }
}

TEST_CASE("command line: what is no command is refused", "[high_level][mission]") {
  for (const char* line : {"", "start", "[]", "{}", R"({"command":5,"token":"secret"})",
                           "\xff\xfe{", "POST / HTTP/1.1\r", "Host: 127.0.0.1:7447\r",
                           R"({"command":"start","token":"secret"} x)"}) {
    const CommandLine read = read_command_line(line, {"secret", "", ""});
    CHECK(read.request.command.empty());
    CHECK(read.refusal.find("a command is a line") != std::string::npos);
  }
}

TEST_CASE("command line: where a token was proved none is shown, and its scope is the proof's",
          "[high_level][mission]") {
  const CommandLine read = read_command_line(R"({"command":"hold","protocol":2})", Scope::kAbort);
  CHECK(read.refusal.empty());
  CHECK(read.request.command == "hold");
  CHECK(read.request.scope == Scope::kAbort);
  for (const char* token : {R"("secret")", R"("")", "null"}) {
    const std::string line = std::string{R"({"command":"hold","token":)"} + token + "}";
    CHECK(read_command_line(line, Scope::kCommand).refusal.find("a token is never sent") !=
          std::string::npos);
  }
  CHECK_FALSE(read_command_line("{}", Scope::kCommand).refusal.empty());
  CHECK_FALSE(
      read_command_line(R"({"command":"hold","protocol":1})", Scope::kCommand).refusal.empty());
}
