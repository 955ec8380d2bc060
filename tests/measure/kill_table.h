// SPDX-License-Identifier: Apache-2.0
// What was measured after each kind of event, against its bound.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lodesman::measure {

class KillTable {
 public:
  // A row: what happened, until what, and the bound; none where nothing is promised. [s]
  void begin(const std::string& event, const std::string& until, std::optional<double> bound_s);
  void add(double seconds);  // to the row begun last
  void print() const;
  [[nodiscard]] bool keeps_all_bounds() const;

 private:
  struct Row {
    std::string event;
    std::string until;
    std::optional<double> bound_s;
    std::vector<double> seconds;
  };
  std::vector<Row> rows_;
};

}  // namespace lodesman::measure
