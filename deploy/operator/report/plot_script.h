// SPDX-License-Identifier: Apache-2.0
// Builds the text of a gnuplot script, its data inside it. A plain value; any one thread.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace lodesman::cli {

using Point = std::array<double, 2>;  // [x, y]
using Line = std::vector<Point>;

// As a string literal of gnuplot, whatever is in it; control characters become spaces.
[[nodiscard]] std::string plot_text(std::string_view text);

class PlotScript {
 public:
  // One command on its own line.
  void command(const std::string& text);

  // Keeps a layer for the next plot(): every line drawn in that style ("with lines lw 2"), with
  // an entry in the legend when `title` is not empty. A point that is not finite interrupts its
  // line; nothing to draw draws nothing, but its title still shows.
  void layer(const std::vector<Line>& lines, const std::string& style, std::string_view title = {});

  // Draws the kept layers, the first one lowest. Ranges must be set: there may be no data.
  void plot();

  [[nodiscard]] std::string text() const { return data_ + commands_; }

 private:
  std::string data_;  // before every command: no data block may begin inside a plot
  std::string commands_;
  std::string layers_;
  int blocks_ = 0;
};

}  // namespace lodesman::cli
