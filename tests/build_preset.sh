#!/bin/sh
# usage: build_preset.sh <preset> <target> ...   configures and builds them, quietly
set -eu
cd "$(dirname "$0")/.."
preset=$1
shift
cmake --preset "$preset" >/dev/null
exec cmake --build --preset "$preset" --target "$@" --parallel "$(nproc)"
