#!/bin/sh
# Builds the libraries that the plugin brings along, static and position-independent as Debian's packages
# have them not: NLopt, GMP and MPFR, from the sources of the installed packages. What is there already is
# kept.
#
# usage: scripts/build_static_libraries.sh <folder>
#   writes <folder>/lib and <folder>/include, sources to <folder>/source
set -eu
[ $# -eq 1 ] || { echo "usage: $0 <folder>" >&2; exit 2; }
scripts=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/source"
folder=$(cd "$1" && pwd)
log=$folder/build.log
jobs=$(nproc)

versions=$(dpkg-query -W -f '${Package} ${Version}\n' libnlopt-dev libgmp-dev libmpfr-dev)
if [ -f "$folder/.complete" ] && [ "$(cat "$folder/.complete")" = "$versions" ]; then
  touch "$folder"/lib/*.a # up to date
  exit 0
fi
rm -rf "$folder/lib" "$folder/include" "$folder/work"
mkdir -p "$folder/work"
trap 'rm -rf "$folder/work"' EXIT
trap 'exit 1' HUP INT TERM

# A copy of the sources of a package to build in.
copy_of() {
  source=$("$scripts/fetch_debian_source.sh" "$1" "$folder/source/$1")
  cp -r "$source" "$folder/work/$1"
  cd "$folder/work/$1"
}

run() { "$@" >>"$log" 2>&1 || { tail -30 "$log" >&2; exit 1; }; }
: >"$log"

# For any processor of the architecture, not for this machine's alone.
machine=$(dpkg-architecture -qDEB_HOST_GNU_TYPE)
flags="-O2 -fPIC"
# What autoconf made is there; Debian's patches are younger.
generators="AUTOCONF=: AUTOMAKE=: ACLOCAL=: AUTOHEADER=: MAKEINFO=:"

copy_of libgmp-dev
# Debian leaves its manual out, which configure asks for.
[ -f doc/Makefile.in ] || { mkdir -p doc && printf 'all install:\n' >doc/Makefile.in; }
run ./configure --build="$machine" --prefix="$folder" --disable-shared --enable-static --enable-cxx \
  --with-pic CFLAGS="$flags" CXXFLAGS="$flags"
run make -j "$jobs" $generators
run make install $generators

copy_of libmpfr-dev
run ./configure --build="$machine" --prefix="$folder" --disable-shared --enable-static --with-pic \
  --with-gmp="$folder" CFLAGS="$flags"
run make -j "$jobs" $generators
run make install $generators

copy_of libnlopt-dev
run cmake -S . -B build -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_INSTALL_LIBDIR=lib \
  -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" -DBUILD_SHARED_LIBS=OFF -DNLOPT_CXX=OFF \
  -DNLOPT_PYTHON=OFF -DNLOPT_OCTAVE=OFF -DNLOPT_MATLAB=OFF -DNLOPT_GUILE=OFF -DNLOPT_SWIG=OFF \
  -DNLOPT_FORTRAN=OFF -DNLOPT_TESTS=OFF
run cmake --build build -j "$jobs"
run cmake --install build

rm -rf "$folder/share"
echo "$versions" >"$folder/.complete"
