// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "low_level/sonar/ping_image.h"
#include "mid_level/base/heading.h"
#include "tests/fuzz/oracle.h"
#include "tests/fuzz/outside_file.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {

void image(std::string_view input) {
  static const auto ping = std::make_unique<SonarPing>();
  accepted_or_refused([&] {
    const OutsideFile file{input};
    const GreyImage read = read_grey_image(file.path());
    require(read.columns > 0 && read.rows > 0 &&
                read.pixels.size() == std::size_t{read.columns} * read.rows,
            "an image has other pixels than its sides say");
    ping->range_m = 30.0;
    ping->sector_rad = to_rad(120.0);
    fan_to_ping(read, whole_image_fan(read, true), *ping);
    require(ping->echo_count <= ping->echo.size(), "a fan overfills its ping");
    polar_to_ping(read, file.path(), *ping);
    require(ping->echo_count == read.pixels.size(), "a polar image loses pixels");
  });
}

}  // namespace lodesman::fuzz
