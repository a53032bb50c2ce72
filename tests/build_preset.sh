#!/bin/sh
# usage: build_preset.sh <preset>   configures and builds it on one core, quietly
set -eu
cd "$(dirname "$0")/.."
cmake --preset "$1" >/dev/null
exec nice cmake --build --preset "$1" --parallel 1
