#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Looks over an installation: what its headers and its guide point to is there, its examples compile
# against it, its programs run.
# usage: installed.sh COMPILER PREFIX LIBDIR OUTPUT_DIR [PROGRAM...]
set -eu
compiler=$1 prefix=$2 libdir=$3 output=$4
shift 4
doc=$prefix/share/doc/sobb

mentioned=$(cat "$prefix"/include/sobb/*.h | grep -o 'docs/[a-z-]*\.md' | sort -u)
linked=$(grep -o '](\.\./[^)#]*\|]([a-z-]*\.md' "$doc/docs/c-api.md" | sed 's|](|docs/|' | sort -u)
for file in $mentioned $linked README.md LICENSE; do
  [ -e "$doc/$file" ] || { echo "not installed: $doc/$file" >&2; exit 1; }
done
echo "installed: $mentioned $linked" | xargs

mkdir -p "$output"
export PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig"
# The flags are words, so they stand unquoted.
for example in quickstart depth_map; do
  "$compiler" -std=c99 -Wall -Wextra -pedantic -Werror "$doc/capi/examples/$example.c" \
    -o "$output/$example" $(pkg-config --cflags --libs sobb_scene sobb) -lm \
    -Wl,-rpath,"$prefix/$libdir"
done
(cd "$output" && ./quickstart && ./depth_map builtin:city:2000 >depths)

for program in "$@"; do
  "$prefix/bin/$program" --help >"$output/help"
done
