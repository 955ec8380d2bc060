// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/hull_check.h"

#include <fstream>
#include <sstream>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

[[nodiscard]] std::string shipped_text() {
  std::ostringstream text;
  text << std::ifstream{LODESMAN_VESSEL}.rdbuf();
  return text.str();
}

// The shipped file with other values, on their lines; what it is refused for, or nothing.
[[nodiscard]] std::string refusal(std::initializer_list<std::pair<std::string, std::string>> set) {
  std::istringstream lines{shipped_text()};
  std::string text;
  std::string line;
  std::size_t changed = 0;
  while (std::getline(lines, line)) {
    for (const auto& [key, value] : set) {
      if (line.starts_with(key + " = ")) {
        line = key;
        line += " = " + value;
        ++changed;
      }
    }
    text += line + "\n";
  }
  REQUIRE(changed == set.size());
  try {
    const TomlDocument document = TomlDocument::from_text(text, "v.toml");
    (void)read_vessel_parameters(document.root().table("vessel"));
    document.require_all_keys_read();
  } catch (const StartupError& error) {
    return error.what();
  }
  return "";
}

[[nodiscard]] std::size_t line_of(const std::string& key) {
  std::istringstream lines{shipped_text()};
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.starts_with(key + " = ")) {
      return number;
    }
  }
  return 0;
}

struct Mistake {
  const char* key;
  const char* value;
  const char* reason;  // how it begins
};

TEST_CASE("hull check: wrong signs and wrong units are refused by line and key", "[hal_sim]") {
  REQUIRE(refusal({}).empty());
  const Mistake mistakes[] = {
      {"mass_kg", "-95.0", "must be"},
      {"mass_kg", "95000.0", "a hull of this length and beam would float"},  // grams
      {"mass_kg", "0.095", "a hull of this length and beam would float"},    // tonnes
      {"yaw_inertia_kg_m2", "26000.0", "its radius of gyration would be"},
      {"yaw_inertia_kg_m2", "0.026", "its radius of gyration would be"},
      {"surge_added_mass_kg", "-5.0", "must be"},
      {"surge_added_mass_kg", "110.0", "is more than mass_kg"},
      {"sway_added_mass_kg", "-110.0", "must be"},  // Y_vdot itself is negative
      {"sway_added_mass_kg", "110000.0", "is more than 5 times mass_kg"},
      {"yaw_added_inertia_kg_m2", "1800.0", "is more than 5 times"},
      {"centre_of_gravity_ahead_m", "1.2", "lies outside the hull"},
      {"hull_length_m", "2040.0", "of more than 30 m"},  // millimetres
      {"hull_beam_m", "120.0", "is more than hull_length_m"},
      {"thruster_offset_m", "45.0", "is more than hull_beam_m"},
      {"thruster_offset_m", "-0.45", "must be"},
      {"thrust_ahead_n", "6.1e4", "full thrust would push it with"},
      {"thrust_ahead_n", "-60.0", "must be"},
      {"thrust_astern_n", "120.0", "is much more than thrust_ahead_n"},
      {"propeller_ahead_rad_s", "1.7", "is no propeller's full speed"},  // a part of full speed
      {"surge_drag_n_s_per_m", "-41.3", "must be"},
      {"surge_drag_n_s_per_m", "41300.0", "full thrust would settle at"},
      {"yaw_drag_n_m_s", "0.0", "must be"},
      {"lift_saturation_deg", "0.15", "must be"},  // radians
      {"lift_ahead_m", "-102.0", "lies outside the hull"},
      {"cross_flow_draught_m", "20.0", "is more than hull_length_m"},
      {"cross_flow_coefficient", "-1.0", "must be"},
      {"trim_force_n", "500.0", "is more than a tenth of the weight"},
      {"drift_moment_kg", "110000.0", "is more than 5 times mass_kg"},
      {"heel_mass_kg", "200.0", "is more than mass_kg"},
  };
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.key << " = " << mistake.value);
    const std::string expected = "v.toml:" + std::to_string(line_of(mistake.key)) + ": vessel." +
                                 mistake.key + ": " + mistake.reason;
    const std::string said = refusal({{mistake.key, mistake.value}});
    INFO(said);
    CHECK(said.starts_with(expected));
  }
}

TEST_CASE("hull check: a yaw drag a degree a second is told from one a radian", "[hal_sim]") {
  // 57 times too small, and too large.
  CHECK(refusal({{"yaw_drag_n_m_s", "1.05"}, {"yaw_drag_n_m_s2", "0.003"}})
            .find("vessel.yaw_drag_n_m_s: full thrust to both sides would turn it at") !=
        std::string::npos);
  CHECK(refusal({{"yaw_drag_n_m_s", "3440.0"}, {"yaw_drag_n_m_s2", "32800.0"}})
            .find("vessel.yaw_drag_n_m_s: full thrust to both sides would turn it at") !=
        std::string::npos);
}

TEST_CASE("hull check: a mass matrix that is not positive definite is refused", "[hal_sim]") {
  // 95 kg by 44 kg m^2 bear a coupling of less than 64.7 kg m.
  CHECK(refusal({{"sway_yaw_added_mass_kg_m", "60.0"}}).find("mass matrix") == std::string::npos);
  for (const char* coupling : {"65.0", "-65.0"}) {
    CHECK(refusal({{"sway_yaw_added_mass_kg_m", coupling}})
              .find("vessel.sway_yaw_added_mass_kg_m: makes the mass matrix not positive "
                    "definite") != std::string::npos);
  }
}

TEST_CASE("hull check: a hull that turns out of its course by itself has to say so", "[hal_sim]") {
  const std::string said = refusal({{"yaw_drag_n_m_s", "25.0"}});
  CHECK(said.starts_with("v.toml:" + std::to_string(line_of("yaw_drag_n_m_s")) +
                         ": vessel.yaw_drag_n_m_s: is too little for a straight course: from "));
  CHECK(refusal({{"yaw_drag_n_m_s", "25.0\nstraight_line_unstable = true"}}).empty());
  // Who says so without need has mistaken something too.
  CHECK(refusal({{"yaw_drag_n_m_s", "60.0\nstraight_line_unstable = true"}})
            .find("vessel.straight_line_unstable: is true, and by these values") !=
        std::string::npos);
  CHECK(refusal({{"lift_ahead_m", "1.02"}}).find(" with lift the hull turns out of it") !=
        std::string::npos);
}

TEST_CASE("hull check: nothing to hold it sideways with lift is refused", "[hal_sim]") {
  CHECK(refusal({{"sway_drag_n_s_per_m", "0.0"},
                 {"sway_drag_n_s2_per_m2", "0.0"},
                 {"lift_drag_n_s2_per_m2", "0.0"},
                 {"lift_kg_per_m", "0.0"}})
            .find("vessel.sway_drag_n_s_per_m: nothing holds the hull") != std::string::npos);
}

TEST_CASE("hull check: every shipped hull is right", "[hal_sim]") {
  int hulls = 0;
  for (const auto& entry : std::filesystem::directory_iterator{LODESMAN_VESSELS}) {
    CHECK_NOTHROW(load_vessel(entry.path()));
    ++hulls;
  }
  CHECK(hulls == 2);
}

}  // namespace
}  // namespace lodesman
