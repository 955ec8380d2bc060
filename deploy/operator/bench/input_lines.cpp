// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/input_lines.h"

#include <charconv>
#include <cmath>
#include <fstream>

namespace lodesman::cli {

std::vector<std::string> read_lines(const std::filesystem::path& file, std::size_t max_bytes) {
  const LinePlace top{file, 1};
  std::error_code error;
  if (!std::filesystem::exists(file, error) || std::filesystem::is_directory(file, error)) {
    top.refuse("file", "cannot be read");
  }
  std::ifstream stream{file, std::ios::binary};
  if (!stream) {
    top.refuse("file", "cannot be read");
  }
  std::vector<std::string> lines;
  std::size_t bytes = 0;
  std::string line;
  // A character at a time, because a line may be longer than the whole file is allowed to be.
  for (auto from = std::istreambuf_iterator<char>{stream}; from != std::istreambuf_iterator<char>{};
       ++from) {
    if (++bytes > max_bytes) {
      top.refuse("file", "is larger than " + std::to_string(max_bytes >> 20U) + " MiB");
    }
    if (*from != '\n') {
      line.push_back(*from);
      continue;
    }
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    lines.push_back(std::move(line));
    line.clear();
  }
  if (!line.empty()) {
    lines.push_back(std::move(line));
  }
  return lines;
}

void LinePlace::refuse(const std::string& key, const std::string& reason) const {
  throw StartupError(file.string(), line, key, reason);
}

std::int64_t whole_number(const LinePlace& place, const std::string& key, std::string_view text,
                          std::int64_t min, std::int64_t max) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    place.refuse(key, "must be a whole number");
  }
  if (value < min || value > max) {
    place.refuse(key, "must be from " + std::to_string(min) + " to " + std::to_string(max));
  }
  return value;
}

double finite_number(const LinePlace& place, const std::string& key, std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    place.refuse(key, "must be a finite number");
  }
  return value;
}

}  // namespace lodesman::cli
