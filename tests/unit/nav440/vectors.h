// SPDX-License-Identifier: Apache-2.0
// Frames of the family, by number: A-1 is the manual's own example, A-28 another author's, A-29 and
// A-30 are recorded; the others were made by a script, apart from this code. A letter counts the
// frames of one row.
#pragma once

#include <array>
#include <string_view>

namespace lodesman::testing {

struct Vector {
  std::string_view number;
  std::string_view hex;
};

inline constexpr std::array kVectors{
    Vector{"A-1", "55 55 50 4B 00 9E F4"},
    Vector{"A-2", "55 55 43 48 03 41 42 43 24 C3"},
    Vector{"A-3", "55 55 47 50 02 41 31 84 A6"},
    Vector{"A-4", "55 55 47 50 02 49 44 23 3D"},
    Vector{"A-5", "55 55 47 50 02 56 52 42 87"},
    Vector{"A-6", "55 55 47 50 02 54 30 68 01"},
    Vector{"A-7", "55 55 53 46 05 01 00 01 00 02 60 C3"},
    Vector{"A-8", "55 55 53 46 03 01 00 01 EF 6A"},
    Vector{"A-9", "55 55 53 46 05 01 00 01 00 00 40 81"},
    Vector{"A-10", "55 55 53 46 05 01 00 03 41 31 36 6E"},
    Vector{"A-10a", "55 55 53 46 03 01 00 03 CF 28"},
    Vector{"A-11", "55 55 53 46 09 02 00 01 00 02 00 03 41 31 AD 90"},
    Vector{"A-12", "55 55 47 46 07 03 00 01 00 02 00 03 04 80"},
    Vector{"A-13", "55 55 47 46 0D 03 00 01 00 02 00 02 00 02 00 03 41 31 84 E5"},
    Vector{"A-14", "55 55 57 46 05 01 00 01 00 04 0F 68"},
    Vector{"A-14a", "55 55 57 46 03 01 00 01 E9 CB"},
    Vector{"A-15", "55 55 15 15 02 53 46 6C AF"},
    Vector{"A-16", "55 55 15 15 02 47 50 D1 EF"},
    Vector{"A-17", "55 55 57 43 02 00 0C D9 84"},
    Vector{"A-17a", "55 55 57 43 02 00 09 89 21"},
    Vector{"A-17b", "55 55 57 43 02 00 0B A9 63"},
    Vector{"A-17c", "55 55 57 43 02 00 0E F9 C6"},
    Vector{"A-18", "55 55 56 52 05 14 02 01 00 0A 95 AD"},
    Vector{"A-19", "55 55 43 48 07 55 55 50 4B 00 9E F4 A7 79"},
    Vector{"A-20",
           "55 55 49 44 1B 1A 3B C0 40 4E 41 56 34 34 30 20 32 2E 30 2E 31 20 38 33 35 30 "
           "2D 32 30 30 30 00 10 92"},
    Vector{"A-21",
           "55 55 41 31 20 01 11 FE 94 C0 00 00 1A FF F3 02 08 00 62 FF BE F3 33 20 00 00 "
           "00 2C CD 28 00 07 5B CD 15 00 00 A9 C3"},
    Vector{"A-22",
           "55 55 41 31 20 00 00 00 00 27 F7 00 00 00 00 00 00 00 00 00 00 F3 33 20 00 00 "
           "00 2C CD 20 00 00 00 03 E8 11 00 C6 BF"},
    Vector{"A-23",
           "55 55 41 31 20 55 55 55 55 00 00 00 00 00 00 00 00 00 00 00 00 F3 33 20 00 00 "
           "00 2C CD 20 00 00 00 00 00 00 00 BB C0"},
    Vector{"A-24",
           "55 55 41 31 20 80 00 7F FF FF FF 00 00 00 00 7F FF 00 00 00 00 F3 33 20 00 00 "
           "00 2C CD 80 00 24 0C 83 FF FF FF 72 35"},
    Vector{"A-25",
           "55 55 41 30 1E 00 00 00 00 40 00 00 00 00 00 00 00 00 00 00 00 F3 33 20 00 00 "
           "00 2C CD 19 9A FF FF 00 00 94 39"},
    Vector{"A-26",
           "55 55 41 32 1E 07 1C FC 72 00 00 00 00 00 00 00 9C 00 00 00 00 F3 33 20 00 20 "
           "00 20 00 00 00 13 88 00 00 3D B7"},
    Vector{"A-27",
           "55 55 4E 30 20 00 00 00 00 C0 00 00 00 00 00 00 68 00 40 FF E0 00 00 62 C5 F9 "
           "2C 18 E8 81 D6 00 32 03 E8 00 00 37 C1"},
    Vector{"A-28",
           "55 55 4E 31 2A 00 B6 01 6C 02 22 00 34 00 68 00 9C 0C CC 0C CC 0C CC 00 80 01 "
           "00 01 80 5A 75 7C 53 18 9C 73 DF 01 90 01 47 00 00 00 00 00 00 3F 51"},
    Vector{"A-29",
           "55 55 53 31 18 FF E0 00 16 0C C0 FF FE FF F9 FF FF 27 EB 27 EB 27 EB 27 F7 28 "
           "F5 00 02 23 BC"},
    Vector{"A-30",
           "55 55 53 31 18 FF E4 00 12 0C C8 FF FA FF F9 FF FE 27 FA 27 FA 27 FA 27 FD 35 "
           "C2 00 02 C8 D6"},
    Vector{"A-31",
           "55 55 53 31 18 00 00 00 00 F3 33 00 00 00 00 00 34 19 9A 19 9A 19 9A 1C 29 00 "
           "07 00 00 DC 04"},
    Vector{"A-32",
           "55 55 54 30 1C 00 05 00 00 00 00 00 00 00 02 00 00 00 02 00 00 00 00 00 00 00 "
           "00 00 00 00 00 00 00 AE AB"},
    Vector{"A-33", "55 55 41 52 00 53 4C"},
    Vector{"A-33a", "55 55 53 52 00 7E 4F"},
    Vector{"A-34", "55 55 43 48 03 55 55 55 53 73"},
};

[[nodiscard]] constexpr std::string_view vector_of(std::string_view number) {
  for (const Vector& vector : kVectors) {
    if (vector.number == number) {
      return vector.hex;
    }
  }
  return {};
}

}  // namespace lodesman::testing
