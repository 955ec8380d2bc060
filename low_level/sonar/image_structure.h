// SPDX-License-Identifier: Apache-2.0
// What a PNG or JPEG says of itself, read from part to part before anything is decoded: a hundred
// bytes may ask for gigabytes, and decoders fill what is cut off with grey, which is no echo that
// anybody measured. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <span>

namespace lodesman {

// [px] columns x rows, the largest that the file declares; 0 where it declares none.
[[nodiscard]] std::uint64_t declared_pixels(std::span<const std::uint8_t> file) noexcept;

// Whether the picture's own end is there. The end of a preview or of a text inside one of the
// file's parts is none.
[[nodiscard]] bool is_whole(std::span<const std::uint8_t> file) noexcept;

}  // namespace lodesman
