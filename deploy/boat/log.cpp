// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/log.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <memory>
#include <string_view>
#include <vector>

#include "deploy/boat/nonblocking_stream.h"

namespace lodesman {
namespace {

// As syslog(3) counts.
[[nodiscard]] int priority_of(spdlog::level::level_enum level) {
  switch (level) {
    case spdlog::level::critical: return 2;
    case spdlog::level::err: return 3;
    case spdlog::level::warn: return 4;
    case spdlog::level::info: return 6;
    default: return 7;
  }
}

// Nothing in it changes from line to line, so any thread may log; a line is one write.
class StandardErrorSink final : public spdlog::sinks::sink {
 public:
  void log(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    if (is_journal_) {
      fmt::format_to(std::back_inserter(line), "<{}>{}\n", priority_of(message.level),
                     std::string_view{message.payload.data(), message.payload.size()});
    } else {
      spdlog::pattern_formatter{}.format(message, line);
    }
    // What is lost is lost: there is no other place to say it.
    static_cast<void>(stream_.write({line.data(), line.size()}));
  }
  void flush() override {}
  void set_pattern(const std::string& /*pattern*/) override {}
  void set_formatter(std::unique_ptr<spdlog::formatter> /*formatter*/) override {}

 private:
  NonblockingStream stream_{STDERR_FILENO};
  bool is_journal_ = leads_to_the_journal(STDERR_FILENO);
};

}  // namespace

void log_without_blocking() {
  const auto level = spdlog::get_level();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("", std::make_shared<StandardErrorSink>()));
  spdlog::set_level(level);
}

void log_with_fields(LineLevel line_level, const std::string& line,
                     std::span<const JournalField> fields) {
  const auto level = line_level == LineLevel::kInfo ? spdlog::level::info : spdlog::level::warn;
  if (!spdlog::should_log(level)) {
    return;
  }
  std::vector<JournalField> all{{"MESSAGE", line},
                                {"PRIORITY", std::to_string(priority_of(level))},
                                {"SYSLOG_IDENTIFIER", program_invocation_short_name}};
  all.insert(all.end(), fields.begin(), fields.end());
  if (!leads_to_the_journal(STDERR_FILENO) || !send_to_journal(all)) {
    spdlog::log(level, "{}", line);
  }
}

void say(const std::string& line) {
  static_cast<void>(NonblockingStream{STDERR_FILENO}.write(line + "\n"));
}

}  // namespace lodesman
