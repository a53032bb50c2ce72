#!/bin/sh
# The plugin is installed to where MeshLab looks; the Debian package names what it needs, brings the
# plugin, the program and its licence and nothing else, and both work. As root it is really installed,
# used by the system's meshlabserver, and removed again.
#
# usage: package.sh <cmake> <cpack> <build folder>
set -eu
cmake=$1 cpack=$2 build=$3
root=$(cd "$(dirname "$0")/../.." && pwd)
sample=$root/sample_meshes/tilted_ellipsoid_top.ply
script=$root/sample_meshes/spin.mlx
plugins=$(dirname "$(dpkg -L meshlab | grep '/libmeshlab-common\.so$')")/plugins
plugin=$plugins/libfilter_massprops.so

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
fail() { echo "$*" >&2; exit 1; }
# What meshlabserver has written must tell that the top spins.
solved() { grep -q '^solved = true$' "$work/log" && [ -s "$work/inner.ply" ]; }

DESTDIR=$work/installed "$cmake" --install "$build" >/dev/null
installed=$(cd "$work/installed" && find . -type f)
[ "$installed" = ".$plugin" ] || fail "cmake --install writes $installed"

"$cpack" --config "$build/CPackConfig.cmake" -B "$work" >"$work/cpack.log" 2>&1 ||
  { cat "$work/cpack.log"; fail "cpack failed"; }
package=$(find "$work" -maxdepth 1 -name '*.deb')
dpkg-deb --info "$package"
depends=", $(dpkg-deb --field "$package" Depends), "
for one in "meshlab (= $(dpkg-query -W -f '${Version}' meshlab))" 'libqt5core5a' 'libc6'; do
  case $depends in *", $one, "* | *", $one ("*) ;; *) fail "the package does not depend on $one" ;; esac
done
if grep -q 'MASSPROPS_LINK_STATICALLY:BOOL=ON' "$build/CMakeCache.txt"; then
  case $depends in *libnlopt* | *libgmp* | *libmpfr*) fail "the package depends on what is linked in" ;; esac
fi
! dpkg-deb --fsys-tarfile "$package" | tar t | grep -q local || fail "the package claims /usr/local"
contents=$(dpkg-deb --fsys-tarfile "$package" | tar t | grep -v "/$" | sort)
expected=$(printf '%s\n' ".$plugin" ./usr/bin/massprops ./usr/share/man/man1/massprops.1 \
  ./usr/share/bash-completion/completions/massprops ./usr/share/doc/meshlab-massprops/copyright | sort)
[ "$contents" = "$expected" ] || fail "the package contains $contents"

mkdir -p "$work/host/plugins"
dpkg-deb --extract "$package" "$work/tree"
cp "$work/tree$plugin" "$work/host/plugins/"
MASSPROPS_PLUGIN=$work/host/plugins/libfilter_massprops.so "$root/scripts/meshlabserver.sh" \
  -i "$sample" -o "$work/inner.ply" -l x -s "$script" >"$work/log" 2>&1 || true
solved || { cat "$work/log"; fail "the plugin in the package does not work"; }
"$work/tree/usr/bin/massprops" "$sample" --goal Spin --quiet || fail "the program in the package does not work"
LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l "$work/tree/usr/share/man/man1/massprops.1" 2>"$work/warnings" |
  grep -q -- '--inner-lower-bound' || fail "the page of the manual says nothing of a parameter"
[ ! -s "$work/warnings" ] || fail "the page of the manual: $(cat "$work/warnings")"
completed=$(bash -c '. "$1"; COMP_WORDS=(massprops --goal Sta); COMP_CWORD=2; _massprops
  printf "%s\n" "${COMPREPLY[@]}"' - "$work/tree/usr/share/bash-completion/completions/massprops")
[ "$completed" = "$(printf '%s\n' Stand 'Stand\ empty\ and\ filled' 'Stand\ (published)')" ] ||
  fail "bash completes Sta to $completed"

if [ "$(id -u)" -ne 0 ] || dpkg-query -W meshlab-massprops >/dev/null 2>&1 || [ -e "$plugin" ]; then
  echo "Not root, or the plugin is installed already: not installed by this test."
  exit
fi
apt() { DEBIAN_FRONTEND=noninteractive apt-get -y -q -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=120 "$@"; }
trap 'apt purge meshlab-massprops >/dev/null 2>&1; rm -rf "$work"' EXIT
apt install --no-install-recommends "$package"
rm "$work/inner.ply"
xvfb-run -a meshlabserver -i "$sample" -o "$work/inner.ply" -l x -s "$script" >"$work/log" 2>&1 || true
solved || { cat "$work/log"; fail "the installed plugin does not work"; }
apt purge meshlab-massprops
[ ! -e "$plugin" ] || fail "the plugin is still there"
[ ! -e /usr/share/doc/meshlab-massprops ] || fail "the documentation is still there"
[ -e "$plugins/libfilter_create.so" ] || fail "MeshLab's own plugins are gone"
dpkg --verify meshlab
trap 'rm -rf "$work"' EXIT
