# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts: the packages that the project needs, how they come, and the compilers'
# cache. Debian 12 and 13 have them by the same names, clang and its tools by names without a version.

# Compilers, tools and libraries of a release build, and Python's virtual environments.
build_packages="g++ cmake ninja-build ccache pkg-config
  libembree-dev libtbb-dev libhwy-dev libxxhash-dev libtinygltf-dev nlohmann-json3-dev
  libopenmesh-dev libdraco-dev libmeshoptimizer-dev libbenchmark-dev libcli11-dev python3-venv"

# What scripts/test.sh needs besides.
test_packages="git libgtest-dev"

# What scripts/test.sh --all needs besides: the sanitizers' compiler, clang-tidy, and a browser for
# the report's pages.
sanitizer_packages="clang libclang-rt-dev"
check_packages="clang-tidy chromium"

# What scripts/coverage.sh needs besides.
coverage_packages="llvm"

# Installs those of the packages named that are missing; needs root or sudo only then.
need_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "This is no Debian: install by yourself what the packages $* contain." >&2
    return
  fi
  local missing=() package
  for package in "$@"; do
    if [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
      missing+=("$package")
    fi
  done
  ((${#missing[@]} == 0)) && return
  echo "Installing with apt-get: ${missing[*]}"
  local root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "Run as root, or install sudo." >&2; return 1; }
    root=(sudo)
  fi
  "${root[@]}" apt-get update -qq
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
}

# Compiles through ccache, if there is one; what it keeps serves every clone of the repository.
use_ccache() {
  command -v ccache >/dev/null || return 0
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
}
