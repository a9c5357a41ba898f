#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compiles the consumer with what pkg-config says of an installed package, and runs it.
# usage: pkg_config.sh COMPILER LIBDIR OUTPUT_DIR [--static]
set -eu
compiler=$1 libdir=$2 output=$3 static=${4:-}

export PKG_CONFIG_PATH="$libdir/pkgconfig"
flags=$(pkg-config $static --cflags --libs sobb_scene sobb)
echo "flags: $flags"
mkdir -p "$output"
# The flags are words, so they stand unquoted.
"$compiler" -std=c99 -Wall -Wextra -pedantic -Werror \
  "$(dirname "$0")/main.c" -o "$output/consumer" $flags -Wl,-rpath,"$libdir"
"$output/consumer" "$output/consumer.sobb"
