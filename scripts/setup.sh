#!/bin/sh
# Makes a bare Debian 12 machine ready and builds everything: installs the packages that are
# missing, gets the headers of the installed MeshLab, configures and builds build/release. What is
# done already is skipped.
#
# usage: scripts/setup.sh [--package | --thorough] [target ...]
#   all targets when none is named; --package: NLopt, GMP and MPFR are linked in, as what is handed on has
#   them; --thorough: that, and what the thorough tests need
set -eu
cd "$(dirname "$0")/.."

static=OFF
thorough=OFF
case ${1:-} in
  --package) static=ON ;;
  --thorough) static=ON thorough=ON ;;
esac
[ "$static" = OFF ] || shift

packages="
  meshlab dpkg-dev file make m4 man-db
  g++ cmake ninja-build
  libcgal-dev libeigen3-dev libspectra-dev libnlopt-dev libnlopt-cxx-dev
  libminizip-dev zlib1g-dev libpugixml-dev libstb-dev prusa-slicer
  libcli11-dev nlohmann-json3-dev
  qtbase5-dev libqt5opengl5-dev libglew-dev libgl-dev
  libgtest-dev libbenchmark-dev libbullet-dev clang-format-14
  xvfb xauth libgl1-mesa-dri xdotool dbus-daemon dbus-bin at-spi2-core python3-pyatspi
  python3 python3-numpy python3-vtk9 mkdocs mkdocs-material
  python3-dev pybind11-dev python3-setuptools python3-pip python3-venv python3-pytest python3-meshio
  python3-distributed
"
[ "$thorough" = OFF ] || packages="$packages clang-14 libclang-rt-14-dev clang-tidy-14"

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

missing=
for package in $packages; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
if [ -n "$missing" ]; then
  echo "Installing:$missing"
  # The package lists may be absent or out of date; other people's repositories may be down.
  # shellcheck disable=SC2086
  as_root apt-get install -qq -y --no-install-recommends $missing >/dev/null 2>&1 || {
    as_root apt-get update -qq || true
    as_root apt-get install -qq -y --no-install-recommends $missing >/dev/null
  }
fi

scripts/fetch_meshlab_source.sh build/meshlab-source >/dev/null

cmake --preset release -DMASSPROPS_WERROR=ON -DMASSPROPS_LINK_STATICALLY="$static" -DMASSPROPS_BUILD_PYTHON=ON \
  -DMASSPROPS_TEST_THOROUGHLY="$thorough" \
  >build/configure.log 2>&1 || {
  cat build/configure.log >&2
  exit 1
}
cmake --build --preset release ${1:+--target "$@"}
