#!/usr/bin/python3
"""What a built file needs at run time and what it shows to others, by its dynamic section.

usage: needs.py <file> <what it may need> <what it may export>
  regular expressions; a shared library that matches neither, or another symbol, is a fault
"""
import re
import subprocess
import sys


def lines(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout.decode().splitlines()


def main(file, needed, exported):
    libraries = [re.search(r"\[(.*)\]", line).group(1) for line in lines("readelf", "-dW", file)
                 if "(NEEDED)" in line]
    symbols = [line.split()[-1] for line in lines("nm", "-D", "--defined-only", file)]
    print("needs", *libraries)
    print("exports", *symbols)
    faults = [f"{file} needs {one}" for one in libraries if not re.fullmatch(needed, one)]
    faults += [f"{file} shows {one}" for one in symbols if not re.fullmatch(exported, one)]
    print("\n".join(faults), file=sys.stderr)
    return 1 if faults or not libraries else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
