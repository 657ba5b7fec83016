#!/usr/bin/env bash
# Builds the libFuzzer targets and runs them one after the other. Needs clang++ and libclang-rt-dev.
#
#   scripts/fuzz.sh                      all targets, 600 seconds each
#   scripts/fuzz.sh --seconds 60 vdb     this target only, for one minute
#
# Targets: options msh inp vdb brep step iges. Findings are in build-fuzz/found, inputs in build-fuzz/corpus.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
seconds=600
if [[ "${1:-}" == --seconds ]]; then
  seconds="$2"
  shift 2
fi
targets=("$@")
if [[ ${#targets[@]} -eq 0 ]]; then targets=(options msh inp vdb brep step iges); fi

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target make_seeds "${targets[@]/%/_fuzz}"
cd build-fuzz
# No leak detection: OpenCASCADE keeps static data until the end of the program.
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1
if [[ ! -d corpus ]]; then
  fuzz/make_seeds corpus.new
  mv corpus.new corpus
fi
mkdir -p found
status=0
for target in "${targets[@]}"; do
  # stderr also holds the program's own messages, one line for each input.
  if "fuzz/${target}_fuzz" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=6000 -max_len=60000 -print_final_stats=1 \
    -artifact_prefix="$PWD/found/${target}-" "$PWD/corpus/$target" >/dev/null 2>"$target.log"; then
    echo "$target: clean, $(sed -n 's/^stat::number_of_executed_units: *//p' "$target.log") inputs in $seconds s"
  else
    status=1
    echo "$target: found something:"
    grep -aE 'ERROR|SUMMARY|runtime error|Test unit written' "$target.log" || tail -n 5 "$target.log"
  fi
done
exit "$status"
