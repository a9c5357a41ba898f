// SPDX-License-Identifier: Apache-2.0
// Parses the words of a text file as numbers.
#pragma once

#include <cstdint>
#include <string_view>
#include <system_error>

namespace sobb {

// Parses a word in any notation of C's but hexadecimal, with nan and inf; exponents may be those of
// Fortran (1.5D+00, 1.5+100), and nan and inf those of Microsoft's C of old (1.#QNAN). False where
// it is no number. Rounded once, to the nearest; beyond the type's range: the largest float, or
// zero.
bool parse_number(std::string_view word, float& value);
bool parse_number(std::string_view word, double& value);

// Parses a word that is a whole number. Errors: invalid_argument, result_out_of_range.
std::errc parse_integer(std::string_view word, int64_t& value);
std::errc parse_integer(std::string_view word, uint64_t& value);

// The double, or the largest float for finite doubles beyond float's range.
double within_float(double value);

}  // namespace sobb
