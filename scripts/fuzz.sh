# Sourced by check: runs the fuzz targets of build/fuzz. An input that took longer than 2 s, one
# allocation of more than 1 GB, or crashed a reader is kept as build/fuzz/found/TARGET-…;
# build/fuzz/fuzz/fuzz_TARGET FILE shows it again. Inputs that reach new code are kept in
# build/fuzz/corpora and are the first ones of the next run.

# fuzz_targets: their names, one a line.
fuzz_targets() {
  find build/fuzz/fuzz -maxdepth 1 -name 'fuzz_*' -type f -printf '%f\n' | sed 's/^fuzz_//' | sort
}

# fuzz_one TARGET SECONDS [OPTION…]
fuzz_one() {
  local target=$1 seconds=$2 log kept scratch status=0
  shift 2
  log=build/fuzz/logs/$target.log
  kept=build/fuzz/corpora/$target
  scratch=$PWD/build/fuzz/tmp/$target
  rm -rf "$scratch"
  mkdir -p build/fuzz/{logs,found} "$scratch" "$kept" "tests/fuzz/corpora/$target"
  env TMPDIR="$scratch" XDG_CACHE_HOME="$scratch/cache" UBSAN_OPTIONS=print_stacktrace=1 \
    "build/fuzz/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=2 -rss_limit_mb=2048 \
    -malloc_limit_mb=1024 -max_len=65536 -artifact_prefix="build/fuzz/found/$target-" \
    "$@" "$kept" "tests/fuzz/corpora/$target" >"$log" 2>&1 </dev/null || status=$?
  [ "$status" -eq 0 ] || tail -n 40 "$log"
  return "$status"
}
export -f fuzz_one

# replay_corpora: every kept input once through its target, without making up new ones.
replay_corpora() {
  build fuzz all || return 1
  fuzz_targets | xargs --max-procs="$(nproc)" -I TARGET bash -c 'fuzz_one "$@"' fuzz TARGET 1 -runs=0
}
