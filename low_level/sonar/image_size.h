// SPDX-License-Identifier: Apache-2.0
// How large a PNG or JPEG says it is, read before anything is decoded: a hundred bytes may ask for
// gigabytes. A pure function; any thread.
#pragma once

#include <cstdint>
#include <span>

namespace lodesman {

// [px] columns x rows, the largest that the file declares; 0 where it declares none.
[[nodiscard]] std::uint64_t declared_pixels(std::span<const std::uint8_t> file) noexcept;

}  // namespace lodesman
