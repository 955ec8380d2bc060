// SPDX-License-Identifier: Apache-2.0
// What reads bytes from outside, each reader behind one function that may be given any bytes. A
// target returns where they are accepted or refused as documented, and throws anything else.
#pragma once

#include <span>
#include <string_view>

namespace lodesman::fuzz {

void command_line(std::string_view input);   // a line of the command socket
void configuration(std::string_view input);  // an overlay, as of --config
void delta_t(std::string_view input);        // what a sonar's program sends, to driver and decode
void frames(std::string_view input);         // lodesman plan --frames
void gpsd(std::string_view input);           // what gpsd says, to its driver
void handshake(std::string_view input);      // what either end of a session beyond loopback is told
void image(std::string_view input);          // an image of lodesman segment
void maestro(std::string_view input);        // answers of a thruster box to its driver
void map(std::string_view input);            // lodesman plan --map
void map_queries(std::string_view input);    // lodesman plan --scen
void message(std::string_view input);        // changes to a message in shared memory
void nav440(std::string_view input);         // what an AHRS says, to its driver and to decode
void nmea(std::string_view input);           // what a receiver says, to its driver and to decode
void roboclaw(std::string_view input);       // answers of the other box
void scenario(std::string_view input);       // a scenario file
void segment_header(std::string_view input);  // changes to a good header of shared memory
void setting(std::string_view input);         // one --set
void thruster_lines(std::string_view input);  // what was said to such a box, for lodesman decode

struct Target {
  std::string_view name;  // of its folder in the corpus too
  void (*run)(std::string_view input);
  std::string_view shipped;     // a directory of the tree whose files are seeds too; or empty
  std::size_t mutations = 500;  // of each seed, in every build; fewer where a run builds a boat
};

[[nodiscard]] std::span<const Target> targets();

}  // namespace lodesman::fuzz
