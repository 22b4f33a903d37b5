#!/usr/bin/env bash
# Runs each fuzzer from its corpus, for some seconds or so many executions, as many at a time as there are processors.
# Fails on any finding. The executions of each, and of all, are told at the end. Those that render or clip exactly are
# executed N/40 times.
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
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

# Leaves in $results the log of a fuzzer, NAME.log, and its exit status, NAME.status.
fuzz() {
  local name=$1 runs=$limit status=0
  local corpus=$root/tests/fuzz/corpus/$name dictionary=$root/tests/fuzz/dictionaries/$name.dict
  if [[ $limit == -runs=* && $slow == *" $name "* ]]; then runs=-runs=$((${limit#-runs=} / 40 + 1)); fi
  local arguments=("$runs" "${options[@]}" "-artifact_prefix=$build/finding-fuzz_$name-")
  if [[ -e $dictionary ]]; then arguments+=("-dict=$dictionary"); fi
  # What a run finds new goes to the scratch folder, not into the repository; scripts/dev/grow-corpus keeps it.
  mkdir "$results/$name"
  arguments+=("$results/$name")
  if [[ -d $corpus ]]; then arguments+=("$corpus"); fi
  "$build/bin/fuzz_$name" "${arguments[@]}" >"$results/$name.log" 2>&1 || status=$?
  echo "$status" >"$results/$name.status"
}

# Whether a fuzzer failed stands in its NAME.status, which is read below; wait also fails if the last one has just ended.
for name in "${names[@]}"; do
  while (($(jobs -pr | wc -l) >= $(nproc))); do wait -n || true; done
  echo "== fuzz_$name"
  fuzz "$name" &
done
wait

found=0
all=0
table=
for name in "${names[@]}"; do
  status=$(<"$results/$name.status")
  if ((status)); then
    found=1
    cat "$results/$name.log"
  fi
  count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$results/$name.log")
  table+=$(printf '%-14s %12d%s' "$name" "${count:-0}" "$( ((status)) && echo '  FINDING')")$'\n'
  all=$((all + ${count:-0}))
done
printf '\nexecutions\n%s%-14s %12d\n' "$table" 'in all' "$all"
exit "$found"
