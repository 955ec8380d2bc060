// SPDX-License-Identifier: Apache-2.0
// Which files `lodesman segment` reads: those that it is told, and of a directory its frames in
// their order. The main thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lodesman::cli {

// A directory stands for its PGM, PNG and JPEG files, by name, numbers in a name as numbers: frame
// 9 comes before frame 10. What is in directories below it is not looked at. Throws StartupError
// where one cannot be read or has no frames. A file that is not there is not noticed here.
[[nodiscard]] std::vector<std::string> frame_files(const std::vector<std::string>& named);

}  // namespace lodesman::cli
