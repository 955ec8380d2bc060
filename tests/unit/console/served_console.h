// SPDX-License-Identifier: Apache-2.0
// A console that listens, with a page of one file, a lasting token file, and beside it a command
// socket and a blackboard where a test wants them.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>

#include "deploy/operator/console/console_server.h"
#include "high_level/mission/command_socket.h"
#include "high_level/mission/token_file.h"
#include "tests/support/raw_viewer.h"

namespace lodesman::testing {

namespace fs = std::filesystem;

class ServedConsole {
 public:
  static std::string own_name() {
    static int count = 0;
    return "lodesman-test-console-" + std::to_string(getpid()) + "-" + std::to_string(++count);
  }

  explicit ServedConsole(Duration stall_limit = std::chrono::seconds{10},
                         Duration header_limit = std::chrono::seconds{5})
      : name_{own_name()}, place_{fs::temp_directory_path() / name_} {
    fs::create_directories(place_ / "page");
    std::ofstream{place_ / "page" / "index.html"} << "<!doctype html><title>page</title>";
    std::ofstream{place_ / "secret.txt"} << "secret";
    make_token_file(place_ / "token");
    tokens = read_tokens(place_ / "token");
    const CommandSocketOptions socket_options{"127.0.0.1",
                                              0,
                                              random_tokens(),
                                              std::chrono::seconds{2},
                                              std::chrono::seconds{60},
                                              std::chrono::seconds{5},
                                              tokens};
    socket_ = std::make_unique<CommandSocket>(
        socket_options, [this](const CommandRequest& request) { return answer(request); });
    run_file_ = std::make_unique<TokenFile>(socket_->port(), socket_options.tokens);
    run_tokens = socket_options.tokens;
    console::ServerOptions server;
    server.address = "127.0.0.1";
    server.command_address = "127.0.0.1";
    server.stall_limit = stall_limit;
    server.header_limit = header_limit;
    console::ConsoleOptions options;
    options.boat = "test boat";
    options.segment = name_;
    options.command_port = socket_->port();
    options.lasting_tokens = (place_ / "token").string();
    options.page = place_ / "page";
    server_ = std::make_unique<console::ConsoleServer>(server, options);
    one_time_token = server_->make_one_time_token();
    server_->start();
  }
  ServedConsole(const ServedConsole&) = delete;
  ServedConsole& operator=(const ServedConsole&) = delete;
  ~ServedConsole() {
    server_.reset();
    run_file_.reset();
    socket_.reset();
    fs::remove_all(place_);
  }

  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  [[nodiscard]] const std::string& segment() const { return name_; }
  // The Cookie header of a session by that token.
  [[nodiscard]] std::string signed_in(const std::string& token) const {
    RawViewer viewer{port()};
    const RawReply reply = viewer.ask("POST", "/session", "", R"({"token":")" + token + "\"}");
    REQUIRE(reply.status == 204);
    const std::string cookie = reply.header("Set-Cookie");
    return "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n";
  }
  // What the boat was told.
  [[nodiscard]] int told(const std::string& command) const {
    const std::lock_guard lock{mutex_};
    int count = 0;
    for (const std::string& word : words_) {
      count += word == command ? 1 : 0;
    }
    return count;
  }
  [[nodiscard]] int told_but_status() const {
    const std::lock_guard lock{mutex_};
    int count = 0;
    for (const std::string& word : words_) {
      count += word != "status" ? 1 : 0;
    }
    return count;
  }

  CommandTokens tokens;      // lasting
  CommandTokens run_tokens;  // of this run
  std::string one_time_token;

 private:
  Answer answer(const CommandRequest& request) {
    const bool may = request.scope == Scope::kCommand ||
                     (request.scope == Scope::kAbort && stops_the_boat(request.command)) ||
                     request.command == "status";
    if (may) {
      const std::lock_guard lock{mutex_};
      words_.push_back(request.command);
    }
    const std::string reply = may ? R"({"ok":true,"state":"idle"})"
                                  : refusal("this token is not good for " + request.command);
    return [reply] { return std::optional{reply}; };
  }

  std::string name_;
  fs::path place_;
  mutable std::mutex mutex_;
  std::vector<std::string> words_;
  std::unique_ptr<CommandSocket> socket_;
  std::unique_ptr<TokenFile> run_file_;
  std::unique_ptr<console::ConsoleServer> server_;
};

}  // namespace lodesman::testing
