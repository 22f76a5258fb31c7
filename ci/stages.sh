# Sourced by .ci/run and ci/nightly: stages, each with its time and outcome.
# shellcheck shell=bash
stages=()

# stage NAME COMMAND...: says what begins and how it ended. Its own exit code is that of the command.
stage() {
  local name="$1" started=$SECONDS status=0 outcome=passed line
  shift
  echo "== $name"
  "$@" || status=$?
  if [[ $status -ne 0 ]]; then outcome="failed with $status"; fi
  printf -v line '%-14s %3d:%02d  %s' "$name" $(((SECONDS - started) / 60)) $(((SECONDS - started) % 60)) "$outcome"
  stages+=("$line")
  echo "== $line"
  return "$status"
}

print_stages() {
  echo "== all stages, minutes:seconds"
  printf '%s\n' "${stages[@]}"
}
