// SPDX-License-Identifier: Apache-2.0
#include "mid_level/messages/fields.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "mid_level/blackboard/blackboard.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

struct Names {
  std::vector<std::string> seen;
  template <class T>
  void operator()(const char* name, const T& /*value*/) {
    seen.emplace_back(name);
  }
  void operator()(const char* name, const std::uint8_t* /*data*/, std::size_t count) {
    seen.push_back(std::string{name} + ":" + std::to_string(count));
  }
};

struct DecisionNames : Names {
  static constexpr bool kSkipMeasured = true;
};

}  // namespace

TEST_CASE("fields: counted tails show only what is used", "[mid_level][messages]") {
  auto path = std::make_unique<SonarPath>();
  path->pixel_count = 2;
  Names names;
  visit_message(names, *path);
  CHECK(std::count(names.seen.begin(), names.seen.end(), "column") == 2);

  auto ping = std::make_unique<SonarPing>();
  ping->echo_count = 3;
  Names ping_names;
  visit_message(ping_names, *ping);
  CHECK(ping_names.seen.back() == "echo:3");
}

TEST_CASE("fields: measured wall times are no part of what a run decided",
          "[mid_level][messages]") {
  const auto path = std::make_unique<SonarPath>();
  Names all;
  DecisionNames decisions;
  visit_message(all, *path);
  visit_message(decisions, *path);
  CHECK(std::count(all.seen.begin(), all.seen.end(), "plan_time_ns") == 1);
  CHECK(std::count(decisions.seen.begin(), decisions.seen.end(), "plan_time_ns") == 0);
}

TEST_CASE("blackboard: every channel has a name of its own and a writer",
          "[mid_level][blackboard]") {
  const auto board = std::make_unique<Blackboard>();
  std::vector<std::string> names;
  std::size_t bytes = 0;
  for_each_channel(*board, [&](const ChannelInfo& info, const auto& channel) {
    names.emplace_back(info.name);
    bytes += sizeof(channel);
    CHECK(info.writer != Role::kNobody);
  });
  CHECK(bytes + sizeof(Blackboard::bells) == sizeof(Blackboard));  // none was forgotten
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}
