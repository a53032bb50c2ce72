#!/usr/bin/python3
"""Runs what the pages show of the program and of the Python package, as it stands there.

usage: readme.py <build folder>
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]


PAGES = ("README.md", "docs/command_line.md", "docs/python.md")


def blocks(language):
    text = "\n".join((ROOT / page).read_text(encoding="utf-8") for page in PAGES)
    found = re.findall(rf"^( *)```{language}\n(.*?)^ *```", text, re.MULTILINE | re.DOTALL)
    return [textwrap.dedent(block) for _, block in found]


def main(build):
    shown = [("sh", [b for b in blocks("sh") if "command_line/massprops" in b]),
             ("python", [b for b in blocks("python") if "import massprops" in b])]
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        (work / "sample_meshes").symlink_to(ROOT / "sample_meshes")
        (work / "build").mkdir()
        (work / "build" / "release").symlink_to(build)
        for language, examples in shown:
            assert len(examples) >= 2, f"the pages have {len(examples)} examples in {language}"
            for example in examples:
                print(example)
                command = ["sh", "-euc"] if language == "sh" else [sys.executable, "-c"]
                subprocess.run([*command, example], check=True, cwd=work,
                               env=dict(os.environ, PYTHONPATH=f"{build}/python"))
        assert (work / "hollow.stl").exists() and (work / "report.json").exists()


if __name__ == "__main__":
    main(sys.argv[1])
