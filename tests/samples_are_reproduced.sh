#!/bin/sh
# usage: samples_are_reproduced.sh <generate_samples> <scratch folder>
set -eu
samples=$(cd "$(dirname "$0")/../sample_meshes" && pwd)
rm -rf "$2"
mkdir -p "$2"
"$1" "$2"
for mesh in "$samples"/*.ply; do
  cmp "$mesh" "$2/$(basename "$mesh")"
done
