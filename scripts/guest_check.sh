#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Proves that the library is a good guest in the builds of other projects: tests/consumer/parent
# takes it in, in several ways, and its program has to print the same hashes of hits and files in
# each. The release build has to be there: it is one of the ways, and its objects in the compilers'
# cache serve most of the others. Prints what each case took.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh
use_ccache

parent=tests/consumer/parent
log=$(mktemp)
trap 'rm -f "$log"' EXIT
expected=

fail() {
  echo "$*" >&2
  exit 1
}

# check NAME COMMAND...: runs one case in a shell of its own, whose output is shown if it fails.
check() {
  local name=$1 start=$SECONDS status
  shift
  set +e # in a condition, the shell would pass over what fails within
  (
    set -e
    "$@"
  ) >"$log" 2>&1
  status=$?
  set -e
  if ((status != 0)); then
    cat "$log" >&2
    fail "$name: FAILED"
  fi
  echo "$name: passed, $((SECONDS - start)) s"
}

# absent PATTERN FILE: the file has no such line; prints those that it has.
absent() {
  if grep -A9 -e "$1" "$2"; then return 1; fi
}

# configure BUILD OPTION...: configures the parent, without a warning. With SOBB_WERROR the
# library's commands are the release build's, so that the cache has its objects.
configure() {
  local build=$1
  shift
  rm -rf "$build"
  cmake -S $parent -B "$build" -D CMAKE_BUILD_TYPE=Release -D CMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -D SOBB_SOURCE="$PWD" "$@" 2>&1 | tee "$build.log"
  absent 'CMake.*Warning' "$build.log"
}

# Builds a configured parent, runs its program, and compares what it prints with the other parents'.
build_and_run() {
  cmake --build "$1" --parallel "$(nproc)"
  "$1/parent" >"$1.hashes"
  [[ -z $expected ]] || diff <(echo "$expected") "$1.hashes"
}

# flags BUILD SOURCE: the words of the command that compiles a file of the library.
flags() {
  grep '"command"' "$1/compile_commands.json" | grep -F "/lib/$2\"" | tr ' ' '\n'
}

# The release build's folder, found as a package.
build_tree() {
  configure build/guest-package -G Ninja -D PARENT_TAKES=package -D sobb_DIR="$PWD/build/release"
  build_and_run build/guest-package
}

# By FetchContent, with nothing asked for: a static core and nothing else, built as the parent is.
# The parent compares its own variables, policies and the like before and after.
fetched() {
  local build=build/guest-fetched
  configure $build -G Ninja -D PARENT_TAKES=fetch -D SOBB_WERROR=ON
  build_and_run $build
  [[ $(find $build -name '*.a' -printf '%f\n' | sort | xargs) == "libparent_library.a libsobb.a" ]]
  [[ -z $(find $build -name CTestTestfile.cmake) ]]
  cmake --install $build --prefix $build/prefix
  [[ $(find $build/prefix -type f -printf '%P') == lib/libparent_library.a ]]
}

# A shared library with the importers, installed with the parent by its wish.
shared() {
  local build=build/guest-shared
  configure $build -G Ninja -D BUILD_SHARED_LIBS=ON -D SOBB_INSTALL=ON -D SOBB_BUILD_SCENE=ON \
    -D SOBB_WERROR=ON
  build_and_run $build
  move_and_use $build
  [[ -f $build.moved/lib/libparent_library.so ]]
}

# Static libraries of a build by themselves.
static() {
  local build=build/guest-static
  rm -rf $build
  cmake -S . -B $build -G Ninja -D BUILD_SHARED_LIBS=OFF -D SOBB_BUILD_TESTS=OFF \
    -D SOBB_BUILD_BENCH=OFF -D SOBB_BUILD_EXAMPLES=OFF -D SOBB_WERROR=ON
  cmake --build $build
  use_package $build/consumer-here -D sobb_DIR="$PWD/$build"
  move_and_use $build --static
}

# Installs a build, moves the installation, and uses it by CMake and by pkg-config.
move_and_use() {
  local build=$1
  shift
  rm -rf "$build.moved"
  cmake --install "$build" --prefix "$build/prefix"
  mv "$build/prefix" "$build.moved"
  use_package "$build/consumer" -D CMAKE_PREFIX_PATH="$PWD/$build.moved"
  tests/consumer/pkg_config.sh cc "$PWD/$build.moved/lib" "$build/pkg_config" "$@"
}

# use_package BUILD OPTION: builds the consumer of a package there, and runs it.
use_package() {
  cmake -S tests/consumer -B "$1" -G Ninja "${@:2}"
  cmake --build "$1"
  (cd "$1" && ctest --output-on-failure --no-tests=error)
}

# A parent of C alone, with Makefiles, without optimisation, in a folder with spaces in its name,
# from sources that nobody may write to.
c_alone() {
  local house="build/a guest's house" source
  [[ ! -e $house ]] || chmod -R u+w "$house"
  rm -rf "$house"
  source="$PWD/$house/source"
  mkdir -p "$source"
  git ls-files -z --cached --others --exclude-standard CMakeLists.txt capi cmake lib |
    tar --create --null --files-from=- | tar --extract --directory="$source"
  chmod -R a-w "$source"
  checksums "$source" >"$house/before"
  configure "$house/build" -G 'Unix Makefiles' -D PARENT_LANGUAGES=C -D CMAKE_BUILD_TYPE=Debug \
    -D SOBB_SOURCE="$source"
  build_and_run "$house/build"
  checksums "$source" | diff "$house/before" - # root may write all the same
}

checksums() {
  (cd "$1" && find . -type f -print0 | sort -z | xargs -0 sha256sum)
}

# A parent that asks of all code what the library cannot stand: fast arithmetic, no exceptions,
# C++17, unity builds, link-time optimisation, warnings as errors, headers of the library's names.
rough() {
  local build=build/guest-rough
  configure $build -G Ninja -D PARENT_IS_ROUGH=ON
  flags $build trace/kernels.cpp | grep -x -e -flto.*
  build_and_run $build
}

# Where flags come behind the library's own, and ask for other arithmetic, it does not compile.
refused() {
  local flag
  set +o pipefail # it is the compiler that fails
  for flag in -ffast-math -Ofast -ffinite-math-only -funsafe-math-optimizations -freciprocal-math \
    -fno-signed-zeros -mfpmath=387; do
    g++ -std=c++20 $flag -I lib -I capi/include -fsyntax-only lib/base/scheduler.cpp 2>&1 |
      grep -F '#error "sobb needs IEEE 754 arithmetic'
  done
}

# The core alone at top level, by the one option; a plain build does not turn warnings into errors.
core_alone() {
  local build=build/guest-core
  rm -rf $build
  cmake -S . -B $build -G Ninja -D SOBB_BUILD_SCENE=OFF -D CMAKE_EXPORT_COMPILE_COMMANDS=ON
  absent ' -Werror' $build/compile_commands.json
  cmake -D SOBB_WERROR=ON $build
  cmake --build $build
  (cd $build && ctest --output-on-failure --no-tests=error -R '^(base|docs|example|exports|layout)')
  set +o pipefail # the consumer wants the importers, too
  cmake -S tests/consumer -B $build/consumer -D sobb_DIR="$PWD/$build" 2>&1 | tr -s ' \n' ' ' |
    grep -F 'it was built without the importers, component scene'
}

[[ -f build/release/sobbTargets.cmake ]] || fail "scripts/setup.sh makes the release build first."
check "package in a build folder" build_tree
expected=$(<build/guest-package.hashes)
check "fetched, static" fetched
check "shared, with importers, installed and moved" shared
check "static by itself, in its build folder, installed and moved" static
check "parent of C alone, Makefiles, Debug, spaces, sources read-only" c_alone
check "core alone at top level" core_alone
check "rough parent: fast arithmetic, link-time optimisation and more" rough
check "arithmetic refused" refused
