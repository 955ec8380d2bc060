// SPDX-License-Identifier: Apache-2.0
// Runs gnuplot once to turn a script into one PNG file; the only place that knows how it is called.
// Any one thread; StartupError says in one line why there is no picture.
#pragma once

#include <filesystem>
#include <string>

namespace lodesman::cli {

struct PictureSize {
  int width_px = 1200;
  int height_px = 600;
};

// The script finds the terminal, the size and the output set. The picture takes its
// name when it is whole; one that fails leaves no file, or the one that was there.
void draw_picture(const std::filesystem::path& png, PictureSize size, const std::string& script);

// The same by a script that lies in a file, sets its own terminal and draws into `output`. It runs
// in the picture's directory, after `variables`, which are gnuplot's commands.
void draw_by_file(const std::filesystem::path& png, const std::filesystem::path& script,
                  const std::string& variables);

}  // namespace lodesman::cli
