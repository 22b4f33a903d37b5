#!/bin/sh
# Runs every fuzzer for SECONDS, starting from its corpus; fails on any finding.
#   tests/fuzz/run.sh SECONDS [BUILD_FOLDER]     (default build/sanitize, see the preset)
set -eu
seconds=${1:?usage: tests/fuzz/run.sh SECONDS [BUILD_FOLDER]}
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${2:-$root/build/sanitize}
found=0
for source in "$root"/tests/fuzz/fuzz_*.cpp; do
  fuzzer=$(basename "$source" .cpp)
  scratch=$(mktemp -d)
  corpus=$root/tests/fuzz/corpus/${fuzzer#fuzz_}
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
