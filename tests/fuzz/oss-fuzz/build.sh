#!/bin/bash -eu
# What OSS-Fuzz runs in its container: builds the fuzzers into $OUT, each with its corpus and its dictionary. CC, CXX,
# CFLAGS, CXXFLAGS and LIB_FUZZING_ENGINE say how.
#   tests/fuzz/oss-fuzz/check runs it here, with this machine's libraries.
source=${FATHOM_SOURCE:-$SRC/fathom}
work=${WORK:-$(mktemp -d)}
prefix=$work/prefix

# C++ libraries that are compiled: with the same standard library and sanitizers as the fuzzers.
for library in imath openexr highway; do
  [[ -d $SRC/$library ]] || continue
  cmake -G Ninja -S "$SRC/$library" -B "$work/$library" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
    -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
    -DBUILD_TESTING=OFF -DHWY_ENABLE_TESTS=OFF -DHWY_ENABLE_EXAMPLES=OFF -DHWY_ENABLE_CONTRIB=OFF \
    -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF
  cmake --build "$work/$library" --target install
done

# The standard library's threads: TBB would be another library to build.
cmake -G Ninja -S "$source" -B "$work/fathom" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_PREFIX_PATH="$prefix" \
  -DFATHOM_FUZZERS=ON -DFATHOM_THREADS=std "-DFATHOM_FUZZING_ENGINE=$LIB_FUZZING_ENGINE"

names=()
for file in "$source"/tests/fuzz/fuzz_*.cpp; do
  name=${file##*/fuzz_}
  names+=("${name%.cpp}")
done
read -r -a names <<<"${FATHOM_FUZZER_NAMES:-${names[*]}}"
cmake --build "$work/fathom" --target "${names[@]/#/fuzz_}"

for name in "${names[@]}"; do
  cp "$work/fathom/bin/fuzz_$name" "$OUT/"
  dictionary=$source/tests/fuzz/dictionaries/$name.dict
  if [[ -e $dictionary ]]; then cp "$dictionary" "$OUT/fuzz_$name.dict"; fi
  corpus=$source/tests/fuzz/corpus/$name
  if [[ -d $corpus ]]; then
    (cd "$corpus" && python3 -m zipfile -c "$OUT/fuzz_${name}_seed_corpus.zip" ./*)
  fi
  printf '[libfuzzer]\nmax_len = 1048576\nlen_control = 100\n' >"$OUT/fuzz_$name.options"
done
