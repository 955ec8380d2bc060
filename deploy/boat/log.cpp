// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>

#include "deploy/boat/nonblocking_stream.h"

namespace lodesman {
namespace {

// Nothing in it changes from line to line, so any thread may log; a line is one write.
class StandardErrorSink final : public spdlog::sinks::sink {
 public:
  void log(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    spdlog::pattern_formatter{}.format(message, line);
    // What is lost is lost: there is no other place to say it.
    static_cast<void>(stream_.write({line.data(), line.size()}));
  }
  void flush() override {}
  void set_pattern(const std::string& /*pattern*/) override {}
  void set_formatter(std::unique_ptr<spdlog::formatter> /*formatter*/) override {}

 private:
  NonblockingStream stream_{STDERR_FILENO};
};

}  // namespace

void log_without_blocking() {
  const auto level = spdlog::get_level();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("", std::make_shared<StandardErrorSink>()));
  spdlog::set_level(level);
}

void say(const std::string& line) {
  static_cast<void>(NonblockingStream{STDERR_FILENO}.write(line + "\n"));
}

}  // namespace lodesman
