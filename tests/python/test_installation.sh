#!/bin/sh
# `pip install .` from a checkout, into an environment of its own, with what is built already; nothing is
# fetched.
#
# usage: test_installation.sh <build folder>
set -eu
build=$1
unset PYTHONPATH
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

/usr/bin/python3 -m venv --system-site-packages "$work/environment"
# pip builds in the checkout: a copy of what it needs.
mkdir "$work/checkout"
(cd "$root" && cp -r CMakeLists.txt README.md pyproject.toml setup.py python "$work/checkout")
MASSPROPS_BUILD_DIR=$build PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 \
  "$work/environment/bin/pip" install --no-build-isolation "$work/checkout"
cd "$work"
"$work/environment/bin/python" - "$root/sample_meshes/game_piece.ply" <<'PYTHON'
import sys
import massprops
import meshio

assert massprops.__file__.startswith(sys.prefix), massprops.__file__
mesh = meshio.read(sys.argv[1])
result = massprops.hollow(mesh.points, mesh.cells_dict["triangle"], goal="Mass")
assert result.solved and result.report["mass_after"] < result.report["mass_before"]
print(massprops.__version__, result.report["message"])
PYTHON
