// SPDX-License-Identifier: Apache-2.0
// Draws an ellipse into a bitmap of rows or of columns, bit for bit as EllipsePx::contains() says.
// A pure function of its arguments; any thread.
#pragma once

#include "low_level/path/bit_lines.h"
#include "low_level/path/zone.h"

namespace lodesman {

void draw_in_rows(const EllipsePx& ellipse, BitLines& rows) noexcept;
void draw_in_columns(const EllipsePx& ellipse, BitLines& columns) noexcept;

}  // namespace lodesman
