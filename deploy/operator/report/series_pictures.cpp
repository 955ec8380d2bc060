// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>

#include "deploy/operator/report/gnuplot.h"
#include "deploy/operator/report/numbers.h"
#include "deploy/operator/report/plot_script.h"
#include "deploy/operator/report/plots.h"
#include "deploy/operator/report/titles.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

constexpr std::array kSeries{"inoffensive_distance", "heading", "thrust"};

// What the rows of a trajectory do not hold.
std::string variables_of(const RunResult& result) {
  std::string variables = "title = " + plot_text(picture_title(result)) + "; ";
  if (result.min_inoffensive_distance_m && result.time_of_min_inoffensive_distance_s) {
    variables += "minimum_m = " + fixed(*result.min_inoffensive_distance_m, 4) +
                 "; minimum_s = " + fixed(*result.time_of_min_inoffensive_distance_s, 4) + "; ";
  }
  return variables;
}

}  // namespace

void draw_pictures(const std::filesystem::path& directory, const RunRecord& record,
                   const std::filesystem::path& scripts) {
  std::string fault;
  const auto attempt = [&fault](const auto& draw) {
    try {
      draw();
    } catch (const StartupError& error) {
      fault = fault.empty() ? error.what() : fault;
    }
  };
  attempt([&] { draw_world(directory / "world.png", record); });
  for (const std::string name : kSeries) {
    attempt([&] {
      draw_by_file(directory / (name + ".png"), scripts / (name + ".gp"),
                   variables_of(record.result));
    });
  }
  if (!fault.empty()) {
    throw StartupError(fault);
  }
}

}  // namespace lodesman::cli
