// SPDX-License-Identifier: Apache-2.0
// See number.h.
#include "scene/input/number.h"

#include <algorithm>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <string>

#include "scene/input/ascii.h"

namespace sobb {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return plus ? word.substr(1) : word;
}

// Returns whether a well-formed number that is out of double's range is below it rather than above:
// the power of ten of its first digit other than zero decides.
bool is_tiny(std::string_view number) {
  int64_t power = 0;
  bool point = false;
  bool significant = false;
  for (size_t i = 0; i < number.size(); ++i) {
    const char c = number[i];
    if (ascii_lower(c) == 'e') {
      const std::string_view digits = without_plus(number.substr(i + 1));
      int64_t exponent = 0;
      const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
      if (end.ec != std::errc()) return digits.front() == '-';
      return power + exponent < 0;
    }
    point |= c == '.';
    if (!is_digit(c)) continue;
    significant |= c != '0';
    if (significant && !point) ++power;
    if (!significant && point) --power;
  }
  return power < 0;
}

template <class T>
std::errc parse_integer_as(std::string_view word, T& value) {
  const std::string_view digits = without_plus(word);
  const char* end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, value);
  return result.ptr == end ? result.ec : std::errc::invalid_argument;
}

}  // namespace

std::errc parse_integer(std::string_view word, int64_t& value) {
  return parse_integer_as(word, value);
}

std::errc parse_integer(std::string_view word, uint64_t& value) {
  return parse_integer_as(word, value);
}

namespace {

// The notations of numbers that std::from_chars does not take: exponents of Fortran's, as in
// 1.5D+00 and 1.5+100, or with the sign before the letter, and what Microsoft's C once wrote for
// not-a-number and infinity, as in -1.#IND.
template <class T>
bool parse_other_notation(std::string_view word, T& value) {
  constexpr size_t kLongest = 64;
  if (word.size() > kLongest) return false;
  std::string number;
  for (const char c : word) number += ascii_lower(c) == 'd' ? 'e' : ascii_lower(c);
  const size_t hash = number.find(".#");
  if (hash != std::string::npos) {
    const bool infinite = number.compare(hash, 5, ".#inf") == 0;
    number = infinite ? number.front() == '-' ? "-inf" : "inf" : "nan";
  }
  const size_t sign = number.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && number[sign - 1] != 'e') {
    if (sign + 1 < number.size() && number[sign + 1] == 'e') number.erase(sign + 1, 1);
    number.insert(sign, 1, 'e');
  }
  return number != word && parse_number(number, value);
}

template <class T>
bool parse_number_as(std::string_view word, T& value) {
  const std::string_view number = without_plus(word);
  const char* end = number.data() + number.size();
  const auto direct = std::from_chars(number.data(), end, value);
  if (direct.ptr != end || direct.ec == std::errc::invalid_argument) {
    return parse_other_notation(word, value);
  }
  if (direct.ec == std::errc()) return true;
  double wide = 0;
  if (std::from_chars(number.data(), end, wide).ec == std::errc::result_out_of_range) {
    wide = is_tiny(number) ? 0.0 : number.front() == '-' ? -DBL_MAX : DBL_MAX;
  }
  value = static_cast<T>(within_float(wide));
  return true;
}

}  // namespace

bool parse_number(std::string_view word, float& value) { return parse_number_as(word, value); }

bool parse_number(std::string_view word, double& value) { return parse_number_as(word, value); }

double within_float(double value) {
  return std::isfinite(value) ? std::clamp<double>(value, -FLT_MAX, FLT_MAX) : value;
}

}  // namespace sobb
