// SPDX-License-Identifier: Apache-2.0
// docs/threads.md says what the program's own tables say.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mid_level/runtime/task_table.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

// The rows below a table's head in docs/threads.md, as they are written.
std::vector<std::string> documented_rows(const std::string& head) {
  std::ifstream file{LODESMAN_DOCS "/threads.md"};
  std::vector<std::string> rows;
  std::string line;
  while (std::getline(file, line) && line != head) {
  }
  std::getline(file, line);  // the rule below the head
  while (std::getline(file, line) && line.starts_with("|")) {
    rows.push_back(line);
  }
  return rows;
}

std::int64_t in_ms(Duration duration) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count();
}

std::int64_t in_us(Duration duration) {
  return std::chrono::duration_cast<std::chrono::microseconds>(duration).count();
}

// The channels, or devices, whose publications wake a task.
std::string woken_by(TaskId task) {
  std::string names;
  const auto add = [&](std::string_view name) {
    names += (names.empty() ? "" : ", ") + std::string{name};
  };
  for (const WakeEdge& edge : kWakeEdges) {
    if (edge.wakes == task) {
      add(edge.channel);
    }
  }
  for (const OrderEdge& edge : kOrderEdges) {
    if (edge.wakes == task) {
      add(edge.channel);
    }
  }
  return names.empty() ? "-" : names;
}

}  // namespace

TEST_CASE("docs: the table of tasks is the program's own", "[docs]") {
  std::vector<std::string> rows;
  for (const TaskSpec& spec : kTaskTable) {
    std::ostringstream row;
    row << "| " << to_string(spec.id) << " | " << in_ms(spec.period) << " | " << in_ms(spec.phase)
        << " | " << spec.fifo_priority << " | " << woken_by(spec.id) << " | "
        << in_us(spec.least_gap) << " | " << in_ms(spec.budget) << " | " << in_ms(spec.deadline)
        << " | " << in_us(spec.nominal) << " |";
    rows.push_back(row.str());
  }
  CHECK(
      documented_rows("| task | period ms | phase ms | priority | woken by | gap us | budget ms | "
                      "deadline ms | nominal us |") == rows);
}

TEST_CASE("docs: the table of channels is the program's own", "[docs]") {
  std::vector<std::string> rows;
  const auto board = std::make_unique<Blackboard>();
  for_each_channel(*board, [&](const ChannelInfo& info, const auto& channel) {
    std::ostringstream row;
    row << "| " << info.name << " | " << (info.writer == Role::kLow ? "low" : "high") << " | "
        << info.writer_task << " | " << channel.kSlots << " | "
        << (info.max_age == max_age::kNoLimit ? "-" : std::to_string(in_ms(info.max_age))) << " |";
    rows.push_back(row.str());
  });
  CHECK(documented_rows("| channel | process | task | slots | max age ms |") == rows);
}
