# Sourced by the scripts beside it: where the repository is, and how it is configured and built.
# shellcheck shell=bash
set -euo pipefail
exec </dev/null # nothing here is interactive, and a closed stdin would hand descriptor 0 to the next file

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$root"
export CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"

# Runs a command and keeps its output to itself unless the command fails.
quietly() {
  local log status=0
  log="$(mktemp)"
  "$@" >"$log" 2>&1 || status=$?
  if [[ $status -ne 0 ]]; then cat "$log" >&2; fi
  rm -f "$log"
  return "$status"
}

# The same for a log, with a line at least every 30 s: the last one that the command said.
reporting() {
  local log status=0 pid told=$SECONDS line
  log="$(mktemp)"
  "$@" >"$log" 2>&1 &
  pid=$!
  while kill -0 "$pid" 2>/dev/null; do
    if ((SECONDS - told >= 25)); then
      line="$(tail -n 1 "$log")"
      echo "$((SECONDS / 60)):$(printf %02d $((SECONDS % 60))) ${line:0:100}"
      told=$SECONDS
    fi
    sleep 1
  done
  wait "$pid" || status=$?
  if [[ $status -ne 0 ]]; then cat "$log" >&2; fi
  rm -f "$log"
  return "$status"
}

# Where ccache is installed, another clone's objects are found again, wherever it is. Call it after ci/setup.
use_compiler_cache() { # [FOLDER of the sources]
  if ! command -v ccache >/dev/null; then return; fi
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_BASEDIR="${1:-$root}" CCACHE_NOHASHDIR=1
  # What precompiled headers need.
  export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
}

# build PRESET CONFIGURE_OPTIONS... [-- TARGETS...]
build() {
  local preset="$1" options=()
  shift
  while [[ $# -gt 0 && "$1" != -- ]]; do
    options+=("$1")
    shift
  done
  shift $(($# > 0)) # the --
  use_compiler_cache
  quietly cmake --preset "$preset" -DGLOVEBENCH_PEERS=OFF "${options[@]}"
  cmake --build --preset "$preset" ${1:+--target "$@"}
}

# How each command of the project says that it lacks something.
fail() {
  echo "$(basename "$0"): $1" >&2
  exit 2
}
