# Sourced by run and check: configures and builds, quietly when there is nothing to do.

# build PRESET TARGET…
build() {
  local preset=$1 folder=build/$1 log
  shift
  mkdir -p "$folder"
  log=$folder/configure.log
  if [ ! -f "$folder/build.ninja" ]; then
    echo "Configuring $folder"
    if ! cmake --preset "$preset" >"$log" 2>&1; then
      cat "$log" >&2
      rm -f "$folder/build.ninja"
      return 1
    fi
  fi
  if ninja -C "$folder" -n "$@" | grep -q 'no work to do'; then
    return 0
  fi
  ninja -C "$folder" -j "$(nproc)" "$@"
}
