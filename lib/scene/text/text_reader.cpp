// SPDX-License-Identifier: Apache-2.0
// See text_reader.h.
#include "scene/text/text_reader.h"

#include <algorithm>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <system_error>

#include "base/error.h"
#include "scene/input/ascii.h"
#include "scene/input/number.h"

namespace sobb {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

}  // namespace

TextReader::TextReader(std::string_view bytes, SceneWriter& writer)
    : at_(bytes.data()),
      end_(bytes.data() + bytes.size()),
      progress_(bytes, &writer),
      writer_(&writer) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kByteOrderMark)) at_ += kByteOrderMark.size();
}

void TextReader::refuse_wide_characters() const {
  using namespace std::string_view_literals;
  const std::string_view text(at_, bytes_left());
  const auto refuse = [this](int bits) {
    fail_here(SOBB_ERROR_SCENE_UNSUPPORTED, "text in UTF-%d: only ASCII and UTF-8 are read", bits);
  };
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv)) refuse(32);
  if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv)) refuse(16);
  // Without a mark, every other byte of letters is zero.
  const auto zero = [text](size_t i) { return text[i] == '\0'; };
  if (text.size() < 4 || zero(0) == zero(1)) return;
  if (zero(0) == zero(2) && zero(1) == zero(3)) refuse(16);
}

const char* TextReader::line_end(const char* from) const {
  while (from != end_ && !is_line_end(*from)) ++from;
  return from;
}

const char* TextReader::after_line_end(const char* line_end) const {
  if (line_end == end_) return end_;
  const bool two = *line_end == '\r' && line_end + 1 != end_ && line_end[1] == '\n';
  return line_end + (two ? 2 : 1);
}

bool TextReader::next_line() {
  if (line_ > 0) at_ = after_line_end(line_end(at_));
  if (at_ == end_) return false;
  progress_.at(at_);
  ++line_;
  return true;
}

bool TextReader::next_line_with_words() {
  while (next_line()) {
    if (!at_line_end()) return true;
  }
  return false;
}

void TextReader::next_item(std::string_view item, uint64_t index, uint64_t count) {
  if (next_line_with_words()) return;
  fail_here(SOBB_ERROR_SCENE_SYNTAX, "the file ends before %s %llu of %llu", quote(item).c_str(),
            static_cast<unsigned long long>(index), static_cast<unsigned long long>(count));
}

bool TextReader::ends_with_cr() const {
  const char* end = line_end(at_);
  return end != end_ && *end == '\r' && after_line_end(end) == end + 1;
}

bool TextReader::ends_word(const char* p) const {
  if (p == end_ || is_blank(*p) || is_line_end(*p)) return true;
  return *p == '\\' && (p + 1 == end_ || is_line_end(p[1]));
}

void TextReader::skip_blanks() {
  progress_.at(at_);
  for (; at_ != end_ && !is_line_end(*at_) && ends_word(at_); ++at_) {
    if (*at_ != '\\' || at_ + 1 == end_) continue;
    at_ = after_line_end(at_ + 1) - 1;
    ++line_;
  }
}

bool TextReader::at_line_end() {
  skip_blanks();
  return at_ == end_ || is_line_end(*at_) || *at_ == '#';
}

void TextReader::pass(size_t characters) {
  skip_blanks();
  at_ += characters;
}

std::string_view TextReader::word() {
  if (at_line_end()) return {};
  const char* begin = at_;
  while (!ends_word(at_)) ++at_;
  return {begin, static_cast<size_t>(at_ - begin)};
}

std::string_view TextReader::word_of_any_line() {
  if (at_line_end() && !next_line_with_words()) return {};
  return word();
}

std::string_view TextReader::required_word(const char* what) {
  const std::string_view found = word();
  if (found.empty()) refuse_word(found, what);
  return found;
}

std::string_view TextReader::rest_of_line() {
  while (at_ != end_ && is_blank(*at_)) ++at_;
  const char* begin = at_;
  at_ = line_end(at_);
  const char* last = at_;
  while (last != begin && is_blank(last[-1])) --last;
  return {begin, static_cast<size_t>(last - begin)};
}

template <class T>
T TextReader::parse(const char* what) {
  skip_blanks();
  T value = 0;
  // Most numbers need no second look; the others are read again, with care.
  const auto result = std::from_chars(at_, end_, value);
  if (result.ec == std::errc() && ends_word(result.ptr)) {
    at_ = result.ptr;
    return value;
  }
  const std::string_view text = word();
  if (!parse_number(text, value)) refuse_word(text, what);
  return value;
}

float TextReader::number(const char* what) { return parse<float>(what); }

double TextReader::coordinate(const char* what) {
  return writer_->has_origin() ? within_float(parse<double>(what)) : parse<float>(what);
}

std::array<double, 3> TextReader::position() {
  return {coordinate("x"), coordinate("y"), coordinate("z")};
}

uint64_t TextReader::count(const char* what, uint64_t max) {
  const std::string_view text = word();
  uint64_t value = 0;
  const std::errc error = parse_integer(text, value);
  if (error == std::errc::result_out_of_range || (error == std::errc() && value > max)) {
    fail_here(SOBB_ERROR_SCENE_SYNTAX, "%s is %s, more than can be", what, quote(text).c_str());
  }
  if (error != std::errc()) refuse_word(text, what);
  return value;
}

uint64_t TextReader::vertex_index(uint64_t vertices) {
  const std::string_view text = word();
  int64_t value = 0;
  const std::errc error = parse_integer(text, value);
  if (error == std::errc::invalid_argument) refuse_word(text, "the index of a vertex");
  if (error != std::errc() || value < 0 || static_cast<uint64_t>(value) >= vertices) {
    fail_here(SOBB_ERROR_INDEX, "there is no vertex %s: they are %llu, from 0", quote(text).c_str(),
              static_cast<unsigned long long>(vertices));
  }
  return static_cast<uint64_t>(value);
}

void TextReader::skip(uint64_t words, const char* what) {
  for (; words > 0; --words) required_word(what);
}

void TextReader::expect_line_end() {
  if (!at_line_end()) refuse_word(word(), "the line's end");
}

void TextReader::pass_surplus() {
  while (!at_line_end()) note_surplus(word());
}

void TextReader::pass_surplus_numbers() {
  for (TextReader ahead = *this; !ahead.at_line_end(); *this = ahead) {
    float value = 0;
    const std::string_view surplus = ahead.word();
    if (!parse_number(surplus, value)) return;
    note_surplus(surplus);
  }
}

void TextReader::note_surplus(std::string_view word) const {
  writer_->note(SOBB_NOTE_SURPLUS, [&] {
    return place() + ": \"" + quote(word) + "\" is more than the file declares";
  });
}

void TextReader::pass_surplus_lines() {
  while (next_line_with_words()) pass_surplus();
}

bool TextReader::take_word(std::string_view expected) {
  TextReader ahead = *this;
  const bool same = is_word(ahead.word(), expected);
  if (same) *this = ahead;
  return same;
}

void TextReader::expect_word(std::string_view expected) {
  if (!take_word(expected)) refuse_word(word(), std::string(expected).c_str());
}

std::string_view TextReader::text_after_line() const {
  const char* next = after_line_end(line_end(at_));
  return {next, static_cast<size_t>(end_ - next)};
}

std::string_view TextReader::text_after_cr() const {
  const char* end = line_end(at_);
  const char* next = end == end_ ? end : end + 1;
  return {next, static_cast<size_t>(end_ - next)};
}

std::string TextReader::place() const {
  return "line " + std::to_string(std::max<uint64_t>(line_, 1));
}

void TextReader::fail_here(sobb_status status, const char* format, ...) const {
  char message[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  throw Error(status, writer_->name() + ": " + place() + ": " + message);
}

void TextReader::refuse_word(std::string_view word, const char* what) const {
  if (word.empty()) {
    fail_here(SOBB_ERROR_SCENE_SYNTAX, "the line ends where %s should be", what);
  }
  fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" where %s should be", quote(word).c_str(), what);
}

bool is_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return ascii_lower(a) == b; });
}

std::string quote(std::string_view word) {
  constexpr size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return word.size() > kLongest ? text + "..." : text;
}

}  // namespace sobb
