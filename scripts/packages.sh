# Sourced by run and check: installs what packages.txt lists and the machine lacks.

# listed_packages SECTION…: the packages of these sections, one a line.
listed_packages() {
  awk -v wanted=" $* " '
    { sub(/#.*/, "") }
    /^\[/ { gsub(/[][ \t]/, ""); taken = index(wanted, " " $0 " "); next }
    taken && NF { print $1 }' packages.txt
}

# missing_packages SECTION…: those that are not installed.
missing_packages() {
  comm -23 <(listed_packages "$@" | sort) \
    <(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' |
      awk '$1 == "installed" { print $2 }' | sort -u)
}

# install_packages SECTION…: quick when nothing is missing.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "Handway installs its dependencies with apt on Debian 12, which this system is not." >&2
    echo "Going on with what is there; packages.txt names what is needed." >&2
    return 0
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing, and installing them takes root or sudo:" >&2
      echo "  apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${#missing[@]} packages: ${missing[*]}"
  local log=build/packages.log
  mkdir -p build
  if ! { "${as_root[@]}" apt-get update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes \
      --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
    tail -n 20 "$log" >&2
    echo "Installing packages failed; the whole log is $log." >&2
    return 1
  fi
}
