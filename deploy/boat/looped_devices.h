// SPDX-License-Identifier: Apache-2.0
// "loop:nmea" and "loop:delta_t": the real driver at one end of a line in memory, at the other what
// stands in for its device. What follows the name has the settings of the driver, `wire=instant`
// for a line without any delay, and, where it is a line of bytes, `batch_s` of an adapter. Used by
// the device contracts alone.
#pragma once

#include "deploy/boat/device_contract.h"

namespace lodesman {

// Reads the settings as driver and stand-in will, and makes nothing. Throw StartupError.
void check_looped_position(const std::string& address);
void check_looped_sonar(const std::string& address);
// Whether the looped sonar of that address, which was checked, is told to send images, or left to
// do so as its user set it.
[[nodiscard]] bool looped_sonar_sends_images(const std::string& address);

[[nodiscard]] std::unique_ptr<PositionSensor> make_looped_position(const Workshop& shop,
                                                                   const std::string& address);
[[nodiscard]] std::unique_ptr<ImagingSonar> make_looped_sonar(const Workshop& shop,
                                                              const std::string& address);

}  // namespace lodesman
