// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/targets.h"

#include <array>

namespace lodesman::fuzz {

std::span<const Target> targets() {
  static constexpr std::array kTargets{
      Target{"command_line", command_line, ""},
      Target{"configuration", configuration, "deploy/config"},
      Target{"delta_t", delta_t, "", 100},
      Target{"frames", frames, ""},
      Target{"gpsd", gpsd, ""},
      Target{"handshake", handshake, ""},
      Target{"image", image, ""},
      Target{"maestro", maestro, "", 60},
      Target{"map", map, ""},
      Target{"map_queries", map_queries, ""},
      Target{"message", message, "", 40},
      Target{"nav440", nav440, "", 200},
      Target{"nmea", nmea, ""},
      Target{"roboclaw", roboclaw, "", 60},
      Target{"scenario", scenario, "hal_sim/scenarios"},
      Target{"segment_header", segment_header, ""},
      Target{"setting", setting, ""},
      Target{"thruster_lines", thruster_lines, ""},
  };
  return kTargets;
}

}  // namespace lodesman::fuzz
