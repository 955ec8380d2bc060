// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/thin_line.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lodesman {
namespace {

double distance_m(const Vertex& p, const Vertex& a, const Vertex& b) noexcept {
  const double along_x = b.x_m - a.x_m;
  const double along_y = b.y_m - a.y_m;
  const double length = std::hypot(along_x, along_y);
  if (length <= 0.0) {
    return std::hypot(p.x_m - a.x_m, p.y_m - a.y_m);
  }
  return std::abs(along_x * (p.y_m - a.y_m) - along_y * (p.x_m - a.x_m)) / length;
}

// Marks the points that a line within the tolerance needs (Ramer, Douglas and Peucker), ends
// included, and gives their number.
std::uint32_t mark_needed(std::span<const Vertex> line, double tolerance_m,
                          std::span<bool> needed) noexcept {
  struct Part {
    std::uint32_t from;
    std::uint32_t to;
  };
  std::array<Part, kMostLinePoints> parts{};
  std::size_t waiting = 0;
  const auto last = static_cast<std::uint32_t>(line.size() - 1);
  std::fill(needed.begin(), needed.end(), false);
  needed.front() = needed.back() = true;
  std::uint32_t count = last > 0 ? 2 : 1;
  parts[waiting++] = {0, last};
  while (waiting > 0) {
    const Part part = parts[--waiting];
    double worst_m = tolerance_m;
    std::uint32_t worst = part.from;
    for (std::uint32_t i = part.from + 1; i < part.to; ++i) {
      const double off_m = distance_m(line[i], line[part.from], line[part.to]);
      if (off_m > worst_m) {
        worst_m = off_m;
        worst = i;
      }
    }
    if (worst > part.from) {
      needed[worst] = true;
      ++count;
      parts[waiting++] = {part.from, worst};
      parts[waiting++] = {worst, part.to};
    }
  }
  return count;
}

}  // namespace

std::uint32_t thin_out(std::span<Vertex> line, double tolerance_m, std::uint32_t most) noexcept {
  std::array<bool, kMostLinePoints> needed{};
  const std::span<bool> marks = std::span{needed}.first(line.size());
  while (mark_needed(line, tolerance_m, marks) > most) {
    tolerance_m *= 1.5;
  }
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (marks[i]) {
      line[kept++] = line[i];
    }
  }
  return kept;
}

}  // namespace lodesman
