#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compiles uses of the headers as C and as C++ with every compiler that is there: initialisers have
# no warning, an ignored status has one, and on Windows functions are imported, exported or neither.
# usage: headers.sh COMPILER INCLUDE_DIR
set -eu
own=$1 include=$2
folder=$(dirname "$0")
failed=0

complain() {
  echo "$*" >&2
  failed=1
}

for compiler in "$own" gcc clang clang-14 clang-19; do
  command -v "$compiler" >/dev/null || continue
  for standard in c99 c11 c2x c++11 c++17 c++20; do
    language=c
    case $standard in c++*) language=c++ ;; esac
    compile="$compiler -x $language -std=$standard -Wall -Wextra -Wpedantic -Werror -I$include -fsyntax-only"
    $compile "$folder/initialisers.c" || complain "$compile: refuses initialisers"
    $compile "$folder/ignored_status.c" 2>/dev/null && complain "$compile: lets a status be ignored"
  done
done

# windows "CORE SCENE" FLAGS...: how sobb_build() and sobb_scene_load() are declared there.
windows() {
  expected=$1
  shift
  found=$(printf '#include <sobb/scene.h>\n' | "$own" -E -P -x c -D_WIN32 "$@" -I"$include" - |
    sed -n 's/.*__declspec(\([a-z]*\)) sobb_status sobb_\(build\|scene_load\)(.*/\1/p' | xargs)
  [ "$found" = "$expected" ] || complain "on Windows with '$*': $found, not $expected"
}
windows "dllimport dllimport"
windows "dllexport dllimport" -DSOBB_EXPORTS
windows "dllimport dllexport" -DSOBB_SCENE_EXPORTS
windows "" -DSOBB_STATIC
exit $failed
