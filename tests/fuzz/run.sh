#!/bin/sh
# Runs each fuzzer for SECONDS, starting from its corpus; fails on any finding.
#   tests/fuzz/run.sh SECONDS [BUILD_FOLDER [NAME…]]     (default build/sanitize, see the preset, and all)
set -eu
seconds=${1:?usage: tests/fuzz/run.sh SECONDS [BUILD_FOLDER]}
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${2:-$root/build/sanitize}
shift $(($# < 2 ? $# : 2))
if [ $# -eq 0 ]; then
  for source in "$root"/tests/fuzz/fuzz_*.cpp; do
    name=$(basename "$source" .cpp)
    set -- "$@" "${name#fuzz_}"
  done
fi
found=0
for name; do
  fuzzer=fuzz_$name
  scratch=$(mktemp -d)
  corpus=$root/tests/fuzz/corpus/$name
  [ -d "$corpus" ] || corpus=
  echo "== $fuzzer"
  # What a run finds new goes to the scratch folder, not into the repository.
  if ! "$build/bin/$fuzzer" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=25 -max_len=8192 \
      -artifact_prefix="$build/finding-$fuzzer-" -print_final_stats=0 -verbosity=0 \
      "$scratch" $corpus; then
    found=1
  fi
  rm -rf "$scratch"
done
exit $found
