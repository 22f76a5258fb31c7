# Sourced by ci/planted-regressions and ci/false-alarms: a copy of HEAD that they may change, and its builds.
# shellcheck shell=bash
# shellcheck source=ci/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work="$(mktemp -d "${TMPDIR:-/tmp}/glovebench-campaign.XXXXXX")"
trap 'rm -rf "$work"' EXIT
source_folder="$work/source"
program="$source_folder/build/release/bin/glovebench"

export_head() {
  mkdir -p "$source_folder/build"
  git archive HEAD | tar -x -C "$source_folder"
  git -C "$source_folder" init --quiet # a repository of its own, so that git apply looks no further up
  ln -s "$root/build/assets" "$source_folder/build/assets"
}

# rebuild -- [CMAKE_OPTION...]
rebuild() {
  shift
  use_compiler_cache "$source_folder"
  (
    cd "$source_folder"
    # Warnings are errors as in .ci/run, so that the compiler cache has its objects.
    quietly cmake --preset release -DGLOVEBENCH_WERROR=ON -DGLOVEBENCH_TESTS=OFF -DGLOVEBENCH_BENCHMARKS=OFF "$@"
    quietly cmake --build --preset release --target glovebench
  )
}

# patched apply|revert PATCH...
patched() {
  local options=()
  if [[ "$1" == revert ]]; then options=(--reverse); fi
  shift
  git -C "$source_folder" apply "${options[@]}" "${@/#/$root/}"
}

# run_suite SUITE FOLDER [OPTION...]
run_suite() {
  local suite="$1" folder="$2"
  shift 2
  quietly "$program" run --suite "$suite" --output "$folder" --quiet "$@"
}

# make_baseline SUITE: the undisturbed result, with the noise floor that the project's own baseline has.
make_baseline() {
  local floor="ci/baselines/$1/noise_floor.json"
  [[ -f "$floor" ]] || fail "$floor is missing; run: glovebench calibrate noise --suite $1 --output ci/baselines"
  run_suite "$1" "$work/undisturbed/$1"
  quietly "$program" gate "$work/undisturbed/$1" --baseline "$work/baseline/$1" --update
  cp "$floor" "$work/baseline/$1/"
}

# gate SUITE CANDIDATE LOG [OPTION...]: the exit code, as a number on standard output.
gate() {
  local suite="$1" candidate="$2" log="$3" status=0
  shift 3
  "$program" gate "$candidate" --baseline "$work/baseline/$suite" "$@" >"$log" 2>&1 || status=$?
  echo "$status"
}
