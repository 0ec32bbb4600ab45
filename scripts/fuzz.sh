# Sourced by check: runs the fuzz targets of build/fuzz. An input that took longer than 2 s, one
# allocation of more than 1 GB, or crashed a reader is kept as build/fuzz/found/TARGET-…;
# build/fuzz/fuzz/fuzz_TARGET FILE shows it again. Inputs of long runs that reach new code are kept
# in build/fuzz/corpora and are the first ones of the next.

# fuzz_targets: their names, one a line.
fuzz_targets() {
  find build/fuzz/fuzz -maxdepth 1 -name 'fuzz_*' -type f -printf '%f\n' | sed 's/^fuzz_//' | sort
}

# run_target TARGET FOLDER OPTION…: fuzzes it from the inputs in FOLDER and in tests/fuzz/corpora,
# keeps in FOLDER those that reach new code, and shows the end of the log if anything was found.
run_target() {
  local target=$1 kept=$2 log scratch status=0
  shift 2
  log=build/fuzz/logs/$target.log
  scratch=$PWD/build/fuzz/tmp/$target
  rm -rf "$scratch"
  mkdir -p build/fuzz/{logs,found} "$scratch" "$kept" "tests/fuzz/corpora/$target"
  env TMPDIR="$scratch" XDG_CACHE_HOME="$scratch/cache" UBSAN_OPTIONS=print_stacktrace=1 \
    "build/fuzz/fuzz/fuzz_$target" -rss_limit_mb=2048 -malloc_limit_mb=1024 -max_len=65536 \
    -artifact_prefix="build/fuzz/found/$target-" "$@" "$kept" "tests/fuzz/corpora/$target" \
    >"$log" 2>&1 </dev/null || status=$?
  [ "$status" -eq 0 ] || tail -n 40 "$log"
  return "$status"
}

# fuzz_one TARGET SECONDS
fuzz_one() {
  run_target "$1" "build/fuzz/corpora/$1" -max_total_time="$2" -timeout=2
}

# runs_of TARGET: how many inputs it takes in about five seconds.
runs_of() {
  case $1 in
    mesh | recorded_hdf5) echo 150 ;;
    cache_entry) echo 2000 ;;
    cloud | moveit | recorded_lerobot | recorded_mcap | recorded_numpy | recorded_ros1_bag | recorded_ros_bag) echo 3000 ;;
    rosbridge | urdf) echo 5000 ;;
    hand) echo 8000 ;;
    haptic | polhemus | pose_datagram | simple_message) echo 40000 ;;
    *) echo 15000 ;;
  esac
}

# fuzz_the_same TARGET: the same inputs for the same tree, whatever was found before, and however
# busy the machine is: the first are those in tests/fuzz/corpora, and what a reader compares is
# pointers and times, too, so that no other is made of it. (How far a mesh gets depends on what its
# program had time for; its inputs differ a little.)
fuzz_the_same() {
  local status=0 kept=build/fuzz/same/$1
  rm -rf "$kept"
  run_target "$1" "$kept" -seed=1 -runs="$(runs_of "$1")" -use_cmp=0 -timeout=20 || status=$?
  echo "  $1: $(grep -oE '^Done [0-9]+ runs|^SUMMARY.*' "build/fuzz/logs/$1.log" | tail -n 1)"
  return "$status"
}
export -f run_target runs_of fuzz_the_same

# fuzz_for_a_minute: all targets, about a minute together on two processors.
fuzz_for_a_minute() {
  build fuzz all || return 1
  fuzz_targets | xargs --max-procs="$(nproc)" -I TARGET bash -c 'fuzz_the_same TARGET'
}
