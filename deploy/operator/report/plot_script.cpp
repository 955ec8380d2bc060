// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/plot_script.h"

#include <cmath>

#include "deploy/operator/report/numbers.h"

namespace lodesman::cli {
namespace {

constexpr int kDecimals = 4;

std::string blocks_of(const std::vector<Line>& lines) {
  std::string text;
  const auto interrupt = [&text] {
    if (!text.ends_with("\n\n") && !text.empty()) {
      text += '\n';
    }
  };
  for (const Line& line : lines) {
    for (const Point& point : line) {
      if (std::isfinite(point[0]) && std::isfinite(point[1])) {
        text += fixed(point[0], kDecimals) + ' ' + fixed(point[1], kDecimals) + '\n';
      } else {
        interrupt();
      }
    }
    interrupt();
  }
  return text;
}

}  // namespace

std::string plot_text(std::string_view text) {
  std::string literal = "'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    literal += byte < 0x20 || byte == 0x7f ? ' ' : c;
    if (c == '\'') {
      literal += '\'';
    }
  }
  return literal + '\'';
}

void PlotScript::command(const std::string& text) { commands_ += text + '\n'; }

void PlotScript::layer(const std::vector<Line>& lines, const std::string& style,
                       std::string_view title) {
  const std::string blocks = blocks_of(lines);
  const std::string shown = title.empty() ? " notitle" : " title " + plot_text(title);
  if (blocks.empty()) {
    layers_ += title.empty() ? "" : ", NaN " + style + shown;
    return;
  }
  const std::string name = "$d" + std::to_string(++blocks_);
  data_ += name + " << END\n" + blocks + "END\n";
  layers_ += ", " + name + " using 1:2 " + style + shown;
}

void PlotScript::plot() {
  // The first is there for the case that no other is.
  commands_ += "plot NaN notitle" + layers_ + '\n';
  layers_.clear();
}

}  // namespace lodesman::cli
