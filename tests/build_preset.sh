#!/bin/sh
# usage: build_preset.sh <preset> <target>   configures and builds it on one core, quietly
set -eu
cd "$(dirname "$0")/.."
cmake --preset "$1" >/dev/null
exec nice cmake --build --preset "$1" --target "$2" --parallel 1
