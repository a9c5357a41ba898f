#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compiles the C blocks of a document, one after the other as one C99 file.
# usage: doc_snippets.sh COMPILER INCLUDE_DIR DOCUMENT
set -eu
awk '/^```/ { inside = ($0 == "```c"); print ""; next } { print inside ? $0 : "" }' "$3" |
  "$1" -std=c99 -Wall -Wextra -pedantic -Werror -I"$2" -fsyntax-only -x c -
