// SPDX-License-Identifier: Apache-2.0
// Draws an ellipse into a bitmap of rows and one of columns, bit for bit as EllipsePx::contains()
// says. A pure function of its arguments; any thread.
#pragma once

#include "low_level/path/bit_lines.h"
#include "low_level/path/zone.h"

namespace lodesman {

void draw(const EllipsePx& ellipse, BitLines& rows, BitLines& columns) noexcept;

}  // namespace lodesman
