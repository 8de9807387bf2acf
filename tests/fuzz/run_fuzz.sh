#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# run_fuzz.sh BUILD SECONDS [TARGET...]: runs every fuzz target of a build for this time, two at once. Corpus and
# artefacts stay in BUILD/corpus/TARGET and BUILD/artefacts/TARGET. Status 1 if anything was found.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd)
seconds=$2
shift 2
if [[ ! $seconds =~ ^[1-9][0-9]*$ ]]; then
  echo "run_fuzz: '$seconds' seconds, expected a whole number above 0" >&2
  exit 2
fi
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for program in "$build"/bin/fuzz_*; do targets+=("${program##*/fuzz_}"); done
fi

# Limits above the memory and time that any input of this size may use.
limits=(-timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=1024)

fuzz_one() {
  local here=$1 build=$2 seconds=$3 target=$4 extra=() folder
  mkdir -p "$build/corpus/$target" "$build/artefacts/$target"
  [ -f "$here/dictionaries/$target.dict" ] && extra+=("-dict=$here/dictionaries/$target.dict")
  # Without seeds, inputs would grow too slowly to form a scene.
  [ -d "$here/seeds/$target" ] || extra+=(-len_control=0 -max_len=1024)
  for folder in "$here/seeds/$target" "$here/finds/$target"; do [ -d "$folder" ] && extra+=("$folder"); done
  local status=0 log=$build/artefacts/$target.log
  nice "$build/bin/fuzz_$target" -max_total_time="$seconds" -max_len=2048 "${@:5}" -print_final_stats=1 \
    -artifact_prefix="$build/artefacts/$target/" "$build/corpus/$target" ${extra[@]+"${extra[@]}"} \
    >"$log" 2>&1 || status=$?
  local rate count
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  if [ "$status" -eq 0 ]; then
    printf '%-18s %10s runs %8s/s  no find\n' "$target" "${count:-?}" "${rate:-?}"
  else
    printf '%-18s %10s runs %8s/s  FIND %s\n' "$target" "${count:-?}" "${rate:-?}" \
      "$(sed -n -e 's/.*Test unit written to //p' -e 's/^find: /(/p' "$log" | tr '\n' ' ')see $log"
    return 1
  fi
}
export -f fuzz_one

echo "run_fuzz: ${#targets[@]} targets, $seconds s each, two at a time; clang 14, libFuzzer, address and undefined"
status=0
printf '%s\n' "${targets[@]}" |
  xargs -P 2 -I '{}' bash -c 'fuzz_one "$@"' _ "$here" "$build" "$seconds" '{}' "${limits[@]}" || status=1
[ "$status" -eq 0 ] || echo "run_fuzz: something was found; artefacts in $build/artefacts" >&2
exit "$status"
