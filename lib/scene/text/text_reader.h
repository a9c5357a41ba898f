// SPDX-License-Identifier: Apache-2.0
// TextReader is a text file as its readers see it: lines, the words and numbers on them, and
// "line N" for messages.
//
// The room text/ reads the formats that are text or begin with some: OBJ, OFF, PLY, STL. Each has a
// header with its contract, and one function of the same form, which load_scene() finds by the
// file's ending (formats.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "scene/input/read_progress.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// A cursor over text, which never goes past its end and never back, so that reading takes linear
// time. It may be copied, to read a part twice.
//
// Lines end with LF, CR LF or CR. Words are separated by blanks; a backslash before a line's end is
// a blank that joins two lines (OBJ); a word that begins with # ends the line (OBJ, OFF). In the
// data lines of PLY and STL neither occurs.
class TextReader {
 public:
  // Reads the file that `writer` is named for; the writer learns how far reading is. All arguments
  // are borrowed.
  TextReader(std::string_view bytes, SceneWriter& writer);

  // Throws SCENE_UNSUPPORTED where the text is UTF-16 or UTF-32, by its first bytes.
  void refuse_wide_characters() const;

  // Moves to the next line, at first to line 1; false at the end of the text. What is left of the
  // current line is passed over, without regard to backslashes.
  bool next_line();
  // Moves to the next line that has a word; false where there is none.
  bool next_line_with_words();
  // Moves to such a line, for item `index` of `count`. SCENE_SYNTAX, naming the item, where the
  // text ends.
  void next_item(std::string_view item, uint64_t index, uint64_t count);

  // Returns whether the current line ends with a CR that no LF follows.
  bool ends_with_cr() const;

  // The next word of the line; empty at the line's end.
  std::string_view word();
  // The next word of this or a later line; empty at the end of the text.
  std::string_view word_of_any_line();
  // The next word; SCENE_SYNTAX at the line's end. `what` is what was expected there, as below.
  std::string_view required_word(const char* what);
  // The line from here, without blanks around it, # and backslashes included.
  std::string_view rest_of_line();
  bool at_line_end();
  // Passes over so many characters of the next word.
  void pass(size_t characters);

  // The next word as a number; SCENE_SYNTAX where it is none. `what` is what was expected there.
  // Beyond float's range: the largest float, which the scene's limit then refuses.
  float number(const char* what);
  // The next word as a coordinate: a number in double where the writer has an origin to subtract
  // from it, else one that number() returns.
  double coordinate(const char* what);
  // The next three words as coordinates x, y and z.
  std::array<double, 3> position();
  // The next word as a number from 0 to `max`, where more is SCENE_SYNTAX too.
  uint64_t count(const char* what, uint64_t max);
  // The next word as the index of one of `vertices` vertices; INDEX where there is no such vertex.
  uint64_t vertex_index(uint64_t vertices);
  // Passes over `words` words; SCENE_SYNTAX where the line has fewer.
  void skip(uint64_t words, const char* what);

  void expect_line_end();
  // Passes over the words that the line has left, with a note of SOBB_NOTE_SURPLUS.
  void pass_surplus();
  // Passes over the numbers that come next on the line likewise.
  void pass_surplus_numbers();
  // Passes over the lines that follow likewise.
  void pass_surplus_lines();
  void expect_word(std::string_view expected);  // ASCII letters in either case
  bool take_word(std::string_view expected);    // false where it is not next, and stays before it

  // The text after the current line; the second for a line that ends with CR, whatever follows.
  std::string_view text_after_line() const;
  std::string_view text_after_cr() const;
  // Bytes from here to the end of the text.
  uint64_t bytes_left() const { return static_cast<uint64_t>(end_ - at_); }

  std::string place() const;
  // Throws with the source's name and the place.
  [[noreturn]] __attribute__((format(printf, 3, 4))) void fail_here(sobb_status status,
                                                                    const char* format, ...) const;

 private:
  template <class T>
  T parse(const char* what);
  const char* line_end(const char* from) const;
  const char* after_line_end(const char* line_end) const;
  bool ends_word(const char* p) const;
  void skip_blanks();
  void note_surplus(std::string_view word) const;
  [[noreturn]] void refuse_word(std::string_view word, const char* what) const;

  const char* at_;
  const char* end_;
  ReadProgress progress_;
  SceneWriter* writer_;
  uint64_t line_ = 0;  // 0 before the first
};

// Returns whether a word is that of a format, `lower`, in letters of either case.
bool is_word(std::string_view word, std::string_view lower);

// A word for a message: cut where it is long, bytes that are no letters replaced.
std::string quote(std::string_view word);

}  // namespace sobb
