# Sourced by the other scripts: goes to the repository's root, and gives them what they share.
# Needs nothing but what a bare Debian has.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

demo_packages=(g++ cmake ninja-build libeigen3-dev libceres-dev libcli11-dev nlohmann-json3-dev
               libpugixml-dev zlib1g-dev libopenmesh-dev esbuild libjs-three)
test_packages=("${demo_packages[@]}" libgtest-dev libgmock-dev python3-meshio python3-numpy)
package_packages=("${demo_packages[@]}" pybind11-dev python3-dev python3-numpy help2man dpkg-dev file)

die() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# install_missing PACKAGE...: installs those that are not there yet; when all are, apt is not run at all.
install_missing() {
  local package as_root=() log missing=()
  for package in "$@"; do
    dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then return; fi

  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || die "needs root or sudo for: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  echo "Installing with apt: ${missing[*]}"
  as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get)
  log=$(mktemp)
  if ! { "${as_root[@]}" update &&
         "${as_root[@]}" install --yes --no-install-recommends "${missing[@]}"; } </dev/null >"$log" 2>&1; then
    cat "$log" >&2
    die "apt could not install: ${missing[*]}"
  fi
  rm "$log"
}

# run_workflow PRESET: without CMake's status lines and Ninja's progress, so that what remains is worth reading.
run_workflow() {
  cmake --workflow --preset "$1" 2>&1 | grep --line-buffered --extended-regexp --invert-match '^(-- |\[[0-9]+/[0-9]+\] |ninja: no work)'
}
