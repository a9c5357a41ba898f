#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Proves that the README's two commands work on a bare Debian, from a clean clone of the last commit:
# makes the system with debootstrap (minbase), enters it with chroot, runs both and prints their
# times. Needs root. The exit code is 0 where both passed.
# usage: scripts/other_systems.sh debian12|debian13 [FOLDER]
#   FOLDER   outside of the checkout, keeps Debian's and Python's packages and the compilers' cache
#            for the next run, which makes the system anew; by default a temporary one, removed at
#            the end
# The mirror is the one of this machine's apt, or the environment's DEBIAN_MIRROR. The system is given
# this machine's settings of apt and pip, its certificates, and the environment's PIP_*, proxies and
# CMAKE_BUILD_PARALLEL_LEVEL.
set -euo pipefail
folder=${2:+$(realpath -m "$2")} # named from where the caller is
cd "$(dirname "$0")/.."
source scripts/packages.sh

usage() {
  echo "usage: scripts/other_systems.sh debian12|debian13 [FOLDER]" >&2
  exit 2
}
case "${1:-}" in
  debian12) codename=bookworm ;;
  debian13) codename=trixie ;;
  *) usage ;;
esac
(($# <= 2)) || usage
((EUID == 0)) || { echo "Run as root: chroot and mount need it." >&2; exit 1; }
need_packages debootstrap git

inside=
if [[ -n $folder ]]; then
  removed=$folder/$1
  [[ $folder/ != "$(pwd -P)"/* ]] || { echo "$folder lies in the checkout." >&2; exit 2; }
else
  folder=$(mktemp -d)
  removed=$folder
fi

# The system's processes and mounts have namespaces of their own, which end with their first process:
# nothing stays mounted, however this script ends, and nothing mounted is in reach of rm.
clean_up() {
  if [[ -n $inside ]]; then
    { kill -KILL "$inside" && wait "$inside"; } 2>/dev/null || true
  fi
  rm -rf --one-file-system "$removed"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

export system=$1 codename target=$folder/$1 kept=$folder/$1-kept
export mirror=${DEBIAN_MIRROR:-}
if [[ -z $mirror ]]; then
  # shellcheck disable=SC2016 # apt's own placeholders
  mirror=$(apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's/^Debian //p' | head -n 1)
fi
[[ -n $mirror ]] || { echo "apt knows no mirror of Debian; set DEBIAN_MIRROR." >&2; exit 1; }

make_system() {
  echo "Making a bare $system in $target from $mirror"
  debootstrap --variant=minbase --cache-dir="$kept/apt" "$codename" "$target" "$mirror" \
    >"$kept/debootstrap.log" || { tail -n 20 "$kept/debootstrap.log" >&2; return 1; }
  local settings=$target/etc/apt/apt.conf.d/90host
  echo 'Dir::Cache::archives "/var/cache/kept/apt";' >"$settings"
  apt-config dump | { grep -E '^Acquire::(https?|Check|Retries)' || true; } >>"$settings"
  [[ ! -f /etc/pip.conf ]] || cp /etc/pip.conf "$target/etc"
  local certificates=${PIP_CERT:-/etc/ssl/certs/ca-certificates.crt}
  if [[ -f $certificates ]]; then
    install -D -m 644 "$certificates" "$target/etc/ssl/host.crt"
    echo 'Acquire::https::CAInfo "/etc/ssl/host.crt";' >>"$settings"
    export PIP_CERT=/etc/ssl/host.crt
  fi
  git clone -q --no-hardlinks . "$target/opt/sobb"

  mount -t proc proc "$target/proc"
  mount --rbind /dev "$target/dev"
  mount --rbind /sys "$target/sys"
  mkdir "$target/var/cache/kept"
  mount --bind "$kept" "$target/var/cache/kept"
}

# Runs a command in the clone, with nothing of the environment but what the head of this file names.
in_system() {
  local environment=(HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8
    CCACHE_DIR=/var/cache/kept/ccache PIP_CACHE_DIR=/var/cache/kept/pip) name
  for name in $(compgen -e); do
    case "$name" in
      PIP_* | *_proxy | *_PROXY | CMAKE_BUILD_PARALLEL_LEVEL) environment+=("$name=${!name}") ;;
    esac
  done
  chroot "$target" env -i "${environment[@]}" /bin/bash -c "cd /opt/sobb && exec $1"
}

prove() {
  local cache=empty report="" failures=0 command start result
  [[ ! -d $kept/ccache ]] || cache="from an earlier run"
  make_system
  for command in scripts/demo.sh scripts/test.sh; do
    printf '\n== %s: %s\n' "$system" "$command"
    start=$SECONDS
    result=passed
    in_system "$command" || { result=FAILED; failures=$((failures + 1)); }
    report+=$(printf '%-16s %s, %d s' "$command" "$result" $((SECONDS - start)))$'\n'
  done
  printf '\nDebian %s, bare; %d processors; the compilers'\'' cache was %s\n%s' \
    "$(<"$target/etc/debian_version")" "$(nproc)" "$cache" "$report"
  ((failures == 0))
}

mkdir -p "$kept/apt"
rm -rf --one-file-system "$target"
export -f make_system in_system prove
unshare --mount --pid --fork --kill-child bash -euo pipefail -c prove &
inside=$!
wait "$inside"
