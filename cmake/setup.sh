# SPDX-License-Identifier: BSD-3-Clause
#
# Shared by ./demo, ./check and .ci/run: install what is missing, configure, build.
# To be sourced by bash from the top of the source tree.

BUILD_PACKAGES=(g++ cmake ninja-build pkg-config libpcl-dev libceres-dev libzstd-dev
  nlohmann-json3-dev libpng-dev libcairo2-dev libyaml-cpp-dev libboost-program-options-dev
  libboost-iostreams-dev libsuitesparse-dev)
TEST_PACKAGES=(libgtest-dev libsisl-dev python3)

is_installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# install_packages PACKAGE... : Debian and Ubuntu; elsewhere CMake says what is missing.
install_packages() {
  local missing=() as_root=() package
  command -v dpkg-query >/dev/null || return 0
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || {
      echo "error: neither root nor sudo here; as root, run: apt-get install ${missing[*]}" >&2
      return 1
    }
    as_root=(sudo)
  fi
  echo "== installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# build_in DIRECTORY [CMAKE_OPTION...]
build_in() {
  local directory=$1 launcher=()
  shift
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  echo "== building in $directory/"
  cmake -G Ninja -S . -B "$directory" --log-level=WARNING "${launcher[@]}" "$@" >/dev/null
  cmake --build "$directory"
}
