// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lodesman::bench {
namespace {

using Json = nlohmann::ordered_json;

// The value that a share of the frames does not exceed.
double quantile(std::span<const FrameTimes> frames, Column column, double share) {
  std::vector<double> us;
  for (const FrameTimes& frame : frames) {
    us.push_back(frame.us[static_cast<std::size_t>(column)]);
  }
  std::sort(us.begin(), us.end());
  const auto place = static_cast<std::size_t>(std::ceil(share * static_cast<double>(us.size())));
  return us.empty() ? 0.0 : us[std::clamp<std::size_t>(place, 1, us.size()) - 1];
}

std::vector<FrameTimes> of_kind(std::span<const FrameTimes> frames, std::size_t kind) {
  std::vector<FrameTimes> some;
  std::copy_if(
      frames.begin(), frames.end(), std::back_inserter(some),
      [&](const FrameTimes& frame) { return static_cast<std::size_t>(frame.kind) == kind; });
  return some;
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), value < 100.0 ? "%.1f" : "%.0f", value);
  return text.data();
}

std::string row(const std::string& name, std::span<const FrameTimes> frames, double share) {
  std::array<double, kColumns> us{};
  std::string text = "| " + name;
  for (std::size_t i = 0; i < kColumns; ++i) {
    us[i] = quantile(frames, static_cast<Column>(i), share);
    text += " | " + number(us[i]);
  }
  const auto at = [&us](Column column) { return us[static_cast<std::size_t>(column)]; };
  const double step = at(Column::kStep);
  return text + " | " + number(at(Column::kReference) / step) + " | " +
         number(at(Column::kBoost) / step) + " | " +
         number(at(Column::kReference) / at(Column::kSearch)) + " | " +
         number(step / at(Column::kCopy)) + " |\n";
}

}  // namespace

double reference_per_step(std::span<const FrameTimes> frames, double share) {
  return quantile(frames, Column::kReference, share) / quantile(frames, Column::kStep, share);
}

Json to_json(std::span<const FrameTimes> frames) {
  Json json;
  const auto all = [](std::span<const FrameTimes> some) {
    Json columns;
    for (std::size_t i = 0; i < kColumns; ++i) {
      const auto column = static_cast<Column>(i);
      columns[std::string{kColumnNames[i]}] = {{"median_us", quantile(some, column, 0.5)},
                                               {"p99_us", quantile(some, column, 0.99)},
                                               {"worst_us", quantile(some, column, 1.0)}};
    }
    return columns;
  };
  json["frames"] = frames.size();
  json["all"] = all(frames);
  for (std::size_t kind = 0; kind < testing::kFrameKindNames.size(); ++kind) {
    json[std::string{testing::kFrameKindNames[kind]}] = all(of_kind(frames, kind));
  }
  return json;
}

Json to_json(std::span<const Growth> growth) {
  Json json = Json::array();
  for (const Growth& line : growth) {
    json.push_back({{"name", line.name},
                    {"size", line.size},
                    {"step_median_us", quantile(line.frames, Column::kStep, 0.5)},
                    {"search_median_us", quantile(line.frames, Column::kSearch, 0.5)}});
  }
  return json;
}

std::string summary_of(std::span<const FrameTimes> frames) {
  const std::string head =
      "| frames | our step us | our search us | reference A* us | Boost A* us "
      "| OMPL RRTConnect us | copy us | reference / step | Boost / step | reference / search "
      "| step / copy |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  return head + row("all, median", frames, 0.5) + row("all, p99", frames, 0.99) +
         row("all, worst", frames, 1.0);
}

std::string table_of(std::span<const FrameTimes> frames) {
  std::string text = summary_of(frames);
  for (std::size_t kind = 0; kind < testing::kFrameKindNames.size(); ++kind) {
    text +=
        row(std::string{testing::kFrameKindNames[kind]} + ", median", of_kind(frames, kind), 0.5);
  }
  return text;
}

std::string table_of(std::span<const Growth> growth) {
  std::string text =
      "| | step median us | exponent | search median us | exponent |\n|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < growth.size(); ++i) {
    text += "| " + growth[i].name;
    for (const Column column : {Column::kStep, Column::kSearch}) {
      const double us = quantile(growth[i].frames, column, 0.5);
      std::string exponent = "-";
      if (i > 0) {
        const double before = quantile(growth[i - 1].frames, column, 0.5);
        exponent = number(std::log(us / before) / std::log(growth[i].size / growth[i - 1].size));
      }
      text += " | " + number(us) + " | " + exponent;
    }
    text += " |\n";
  }
  return text;
}

}  // namespace lodesman::bench
