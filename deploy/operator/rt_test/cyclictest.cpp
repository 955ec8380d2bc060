// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/cyclictest.h"

#include <charconv>
#include <map>
#include <nlohmann/json.hpp>

namespace lodesman::cli {
namespace {

using nlohmann::json;

// [us] What is later is counted by cyclictest as an overflow and shows in its maximum alone.
constexpr std::int64_t kLongest_us = 100'000;

using Histogram = std::map<std::int64_t, std::uint64_t>;  // by microseconds

void add(const json& histogram, Histogram& counts) {
  for (const auto& [key, count] : histogram.items()) {
    std::int64_t late_us = 0;
    const char* end = key.data() + key.size();
    const auto parsed = std::from_chars(key.data(), end, late_us);
    if (parsed.ec == std::errc{} && parsed.ptr == end && late_us >= 0 && late_us <= kLongest_us &&
        count.is_number_unsigned()) {
      counts[late_us] += count.get<std::uint64_t>();
    }
  }
}

[[nodiscard]] Duration at_share(const Histogram& counts, std::uint64_t all, double share) {
  double seen = 0.0;
  for (const auto& [late_us, count] : counts) {
    seen += static_cast<double>(count);
    if (seen >= share * static_cast<double>(all)) {
      return std::chrono::microseconds{late_us};
    }
  }
  return {};
}

}  // namespace

std::vector<std::string> cyclictest_words(int priority, const std::filesystem::path& file) {
  return {"cyclictest",
          "--default-system",
          "--quiet",
          "--mlockall",
          "--threads=1",
          "--interval=1000",
          "--priority=" + std::to_string(priority),
          "--histogram=" + std::to_string(kLongest_us),
          "--json=" + file.string()};
}

std::optional<CyclictestFigures> read_cyclictest(std::string_view text) {
  const json document = json::parse(text, nullptr, false);
  if (!document.is_object() || !document.contains("thread") || !document["thread"].is_object()) {
    return std::nullopt;
  }
  Histogram counts;
  CyclictestFigures figures;
  for (const auto& [name, thread] : document["thread"].items()) {
    if (!thread.is_object()) {
      continue;
    }
    if (const auto histogram = thread.find("histogram");
        histogram != thread.end() && histogram->is_object()) {
      add(*histogram, counts);
    }
    if (const auto worst = thread.find("max");
        worst != thread.end() && worst->is_number_unsigned()) {
      constexpr std::uint64_t kHour_us = 3'600'000'000;
      const auto us = std::min(worst->get<std::uint64_t>(), kHour_us);
      figures.worst = std::max<Duration>(figures.worst,
                                         std::chrono::microseconds{static_cast<std::int64_t>(us)});
    }
  }
  for (const auto& [late_us, count] : counts) {
    figures.wakes += count;
    figures.late[late_bucket(std::chrono::microseconds{late_us})] += count;
  }
  figures.median = at_share(counts, figures.wakes, 0.5);
  figures.p99 = at_share(counts, figures.wakes, 0.99);
  return figures.wakes > 0 ? std::optional{figures} : std::nullopt;
}

}  // namespace lodesman::cli
