#!/usr/bin/env bash
# Runs each fuzzer from its corpus, for some seconds or so many executions; fails on any finding. The executions
# of each, and of all, are told at the end. Those that render or clip exactly are executed N/40 times.
#   tests/fuzz/run.sh SECONDS|-runs=N [BUILD_FOLDER [NAME…]]     (default build/sanitize, see the preset, and all)
set -euo pipefail
limit=${1:?usage: tests/fuzz/run.sh SECONDS|-runs=N [BUILD_FOLDER [NAME…]]}
[[ $limit == -runs=* ]] || limit=-max_total_time=$limit
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${2:-$root/build/sanitize}
names=("${@:3}")
if ((!${#names[@]})); then
  for source in "$root"/tests/fuzz/fuzz_*.cpp; do
    name=${source##*/fuzz_}
    names+=("${name%.cpp}")
  done
fi

slow=' engines duplicates clipping '

# Inputs grow to a megabyte where larger ones reach more code.
options=(-rss_limit_mb=2048 -timeout=25 -max_len=1048576 -len_control=100 -print_final_stats=1)
found=0
all=0
table=
for name in "${names[@]}"; do
  scratch=$(mktemp -d)
  corpus=$root/tests/fuzz/corpus/$name
  dictionary=$root/tests/fuzz/dictionaries/$name.dict
  runs=$limit
  if [[ $limit == -runs=* && $slow == *" $name "* ]]; then runs=-runs=$((${limit#-runs=} / 40 + 1)); fi
  arguments=("$runs" "${options[@]}" "-artifact_prefix=$build/finding-fuzz_$name-")
  if [[ -e $dictionary ]]; then arguments+=("-dict=$dictionary"); fi
  # What a run finds new goes to the scratch folder, not into the repository; scripts/dev/grow-corpus keeps it.
  arguments+=("$scratch")
  if [[ -d $corpus ]]; then arguments+=("$corpus"); fi
  echo "== fuzz_$name"
  status=0
  "$build/bin/fuzz_$name" "${arguments[@]}" >"$scratch.log" 2>&1 || status=$?
  if ((status)); then
    found=1
    cat "$scratch.log"
  fi
  count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$scratch.log")
  table+=$(printf '%-14s %12d%s' "$name" "${count:-0}" "$( ((status)) && echo '  FINDING')")$'\n'
  all=$((all + ${count:-0}))
  rm -rf "$scratch" "$scratch.log"
done
printf '\nexecutions\n%s%-14s %12d\n' "$table" 'in all' "$all"
exit "$found"
