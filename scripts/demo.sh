#!/bin/sh
# Sets the machine up, builds, runs the filter through the real meshlabserver on every sample mesh,
# and writes into out/, for each sample:
#   <name>_inner.ply   the cavity's surface
#   <name>_outer.ply   the outer surface, where it moved
#   <name>_solid.stl   outer and inner surface together, ready for a slicer
#   <name>.3mf         a project for PrusaSlicer
#   <name>_report.txt  the numbers, before and after
#   <name>.png         a picture of the model cut open
# The texts of all programs that ran are in out/<name>.log.
#
# usage: scripts/demo.sh [sample name ...]
set -eu
cd "$(dirname "$0")/.."
scripts/setup.sh filter_massprops
mkdir -p out

if [ $# -eq 0 ]; then
  for mesh in sample_meshes/*.ply; do
    set -- "$@" "$(basename "$mesh" .ply)"
  done
fi

python=/usr/bin/python3

# Solid and picture of the sample whose names are set below.
draw() {
  if [ -f "$inner" ]; then
    scripts/meshlabserver.sh -i "${moved:-$mesh}" "$inner" -o "$solid" -l x -s scripts/flatten.mlx \
      >>"$log" 2>&1 || { cat "$log" >&2; return 1; }
  else
    scripts/meshlabserver.sh -i "$mesh" -o "$solid" >>"$log" 2>&1 || { cat "$log" >&2; return 1; }
  fi
  xvfb-run -a $python scripts/render.py --outer "$mesh" --inner "$inner" --moved-outer "$moved" --report "$report" \
    --output "out/$name.png" >>"$log" 2>&1 || { cat "$log" >&2; return 1; }
}

drawing=
for name in "$@"; do
  mesh=sample_meshes/$name.ply
  inner=out/${name}_inner.ply
  solid=out/${name}_solid.stl
  report=out/${name}_report.txt
  log=out/$name.log
  case $name in
    box_on_corner) script=sample_meshes/stand.mlx ;;
    tilted_ellipsoid_top) script=sample_meshes/spin.mlx ;;
    *) script=sample_meshes/$name.mlx ;;
  esac
  rm -f "$inner" "$solid" "$report" "$log" "out/$name.png" "out/$name.3mf"
  printed=out/$name.mlx
  sed "s|\(name=\"print_file\" value=\"\)|\1$PWD/out/$name.3mf|" "$script" >"$printed"

  moved=
  if grep -q 'name="outer_upper_bound" value="0"' "$script"; then
    scripts/meshlabserver.sh -i "$mesh" -o "$inner" -l x -s "$printed" >>"$log" 2>&1 || {
      cat "$log" >&2
      exit 1
    }
  else
    # The outer surface moves as well: MeshLab saves all layers beside the first one.
    layers=$(mktemp -d)
    cp "$mesh" "$layers/model.ply"
    scripts/meshlabserver.sh -i "$layers/model.ply" -w "$layers/layers.mlp" -s "$printed" \
      >>"$log" 2>&1 || { cat "$log" >&2; exit 1; }
    moved=out/${name}_outer.ply
    mv "$layers"/*inneroffsetsurface*.ply "$inner"
    mv "$layers"/*outeroffsetsurface*.ply "$moved"
    rm -r "$layers"
  fi
  sed -nE 's/^([a-z][a-z0-9_]* = .*)$/\1/p' "$log" >"$report"
  if grep -q '^cavity_components = 0$' "$report"; then
    # Without a cavity the last layer is the model itself.
    rm -f "$inner"
  fi
  rm -f "$printed"
  $python scripts/report_table.py "$report" "$name"

  # One model is drawn while the next one is hollowed.
  [ -z "$drawing" ] || wait "$drawing"
  draw &
  drawing=$!
done
wait "$drawing"

echo
echo "Written:"
ls -l out/*.ply out/*.stl out/*.3mf out/*.png
