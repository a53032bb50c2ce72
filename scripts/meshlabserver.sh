#!/bin/sh
# Runs the installed meshlabserver with our filter on a virtual display; arguments and exit status
# are meshlabserver's. MASSPROPS_PLUGIN names another build of the filter. With --host-folder it only
# prints the folder with the programs and plugins, and the one with MeshLab's libraries.
#
# MeshLab looks for plugins only next to its own program or where its package puts them. A private
# copy of the program with links to all plugins beside it needs no write access to the system.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
plugin=${MASSPROPS_PLUGIN:-$root/build/release/plugins/libfilter_massprops.so}
[ -f "$plugin" ] || { echo "$plugin is missing: run scripts/setup.sh first." >&2; exit 2; }
plugin=$(realpath "$plugin")

program=$(command -v meshlabserver) || { echo "meshlabserver is not installed." >&2; exit 2; }
libraries=$(dirname "$(dpkg -L meshlab | grep '/libmeshlab-common\.so$')")

host=$(dirname "$(dirname "$plugin")")/meshlab-host
# Several runs may start at once: the folder appears complete or not at all.
if [ ! -d "$host" ] || [ "$program" -nt "$host/meshlabserver" ]; then
  fresh=$(mktemp -d "$host.XXXXXX")
  mkdir "$fresh/plugins"
  ln -s "$libraries"/plugins/*.so "$fresh/plugins/"
  ln -sf "$plugin" "$fresh/plugins/libfilter_massprops.so"
  cp "$program" "$(dirname "$program")/meshlab" "$fresh"
  rm -rf "$host"
  mv -T "$fresh" "$host" 2>/dev/null || rm -rf "$fresh"
fi

if [ "${1:-}" = --host-folder ]; then
  printf '%s\n' "$host" "$libraries"
  exit
fi

# Not xvfb-run: on a busy machine it fails now and then while it cleans up, whatever the program did.
work=$(mktemp -d)
screen=
server=
finish() {
  for process in $server $screen; do kill "$process" 2>/dev/null || true; done
  for process in $server $screen; do wait "$process" 2>/dev/null || true; done
  rm -rf "$work"
}
trap finish EXIT
trap 'exit 129' HUP INT TERM

Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp -noreset 3>"$work/display" >"$work/log" 2>&1 &
screen=$!
until [ -s "$work/display" ]; do
  kill -0 "$screen" 2>/dev/null || { cat "$work/log" >&2; exit 2; }
  sleep 0.05
done

DISPLAY=:$(cat "$work/display") LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} \
  "$host/meshlabserver" "$@" &
server=$!
status=0
wait "$server" || status=$?
server=
exit "$status"
