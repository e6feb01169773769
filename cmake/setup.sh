# shellcheck shell=bash
# What app/demo and tests/run share: saying what happens, installing packages, configuring and building a preset.
# Sourced, with the repository's root as the working folder. Reads `assume_yes` and `gui` (ON or OFF).

# shellcheck source=cmake/packages.sh
source cmake/packages.sh

say() { printf '\n== %s\n' "$*"; }
fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# minutes_and_seconds SECONDS -> "2 min 05 s"
minutes_and_seconds() { printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); }

# Prints those of the given packages that are not installed.
missing_packages() {
  local installed package
  # dpkg-query fails where it has never heard of one of them, which is what we are here to find out.
  installed=" $({ dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null || true; } |
    awk '$2 == "installed" {print $1}' | tr '\n' ' ')"
  for package in "$@"; do
    [[ $installed == *" $package "* ]] || printf '%s\n' "$package"
  done
}

# Do the package lists of this machine know every one of the given packages?
apt_knows() {
  local package
  for package in "$@"; do apt-cache show "$package" >/dev/null 2>&1 || return 1; done
}

# May we install? Root and --yes need no question, and where nobody can answer there is none either.
agreed() {
  local answer
  [[ $EUID -eq 0 || ${assume_yes:-no} == yes || ${CI:-} == true ]] && return 0
  [[ -t 0 ]] || return 1
  read -r -p "Install them with sudo apt-get now? [Y/n] " answer
  [[ -z $answer || $answer == [yY]* ]]
}

# install_packages PACKAGE...: installs what is missing of them; elsewhere than on Debian and Ubuntu prints the list.
install_packages() {
  local missing as_root=()
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    say "Not a Debian or Ubuntu machine: please see that you have what these packages hold"
    printf '  %s\n' "$@"
    return
  fi
  mapfile -t missing < <(missing_packages "$@")
  [[ ${#missing[@]} -gt 0 ]] || return 0

  say "Missing packages: ${missing[*]}"
  agreed || fail "cannot go on without them: sudo apt-get install ${missing[*]}"
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || fail "sudo is missing; as root: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get)
  local command=("${apt[@]}" install -y --no-install-recommends "${missing[@]}")
  # A fresh image has no package lists, and old lists name files that are gone: so fetch them, then try once more.
  if ! apt_knows "${missing[@]}" || ! "${command[@]}"; then
    "${apt[@]}" update
    "${command[@]}"
  fi
}

# configure_and_build PRESET [TARGET...]: a build folder stays usable from run to run, so this is quick when nothing
# changed. CURLEW_TESTS says whether the tests have to be there.
configure_and_build() {
  local preset=$1 targets=()
  shift
  [[ $# -eq 0 ]] || targets=(--target "$@")
  local options=()
  # The sanitizer presets have no window whatever the rest has.
  case $preset in
    asan-ubsan | tsan) ;;
    *) options+=(-D "CURLEW_GUI=$gui") ;;
  esac
  [[ -z ${curlew_tests:-} ]] || options+=(-D "CURLEW_TESTS=$curlew_tests")
  cmake --preset "$preset" "${options[@]}" --log-level=NOTICE
  cmake --build --preset "$preset" "${targets[@]}"
}
