"""Writes massprops/__init__.pyi from its template and the table of parameters of the built module.

usage: write_stub.py <folder with the package massprops>
"""
import pathlib
import sys

package = pathlib.Path(sys.argv[1]) / "massprops"
sys.path.insert(0, sys.argv[1])
import massprops  # pylint: disable=wrong-import-position

lines = [f"    {row['name']}: {row['type']} | None = None," for row in massprops.parameters()]
in_class = ["    " + line for line in lines]
template = (pathlib.Path(__file__).parent / "massprops" / "__init__.pyi.in").read_text(encoding="utf-8")
(package / "__init__.pyi").write_text(template.replace("@METHOD_PARAMETERS@", "\n".join(in_class))
                                      .replace("@PARAMETERS@", "\n".join(lines)), encoding="utf-8")
