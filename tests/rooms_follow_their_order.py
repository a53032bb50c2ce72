#!/usr/bin/python3
"""Each room of core/ includes only itself and the rooms before it, tests mirror the rooms, and no
header includes itself in a circle. Prints the arrows between the rooms."""
import collections
import pathlib
import re
import sys

ROOMS = ["base", "mesh", "query", "model", "physics", "goals", "check", "optimum", "contour", "overhang", "reduced", "best", "drill", "answer", "print"]
INCLUDE = re.compile(r'^\s*#\s*include\s*"core/([^"]+)"', re.MULTILINE)


def room_of(path):
    """The place of a file of core/ in the order; what lies on top of the rooms comes last."""
    parts = pathlib.PurePath(path).parts
    return ROOMS.index(parts[0]) if len(parts) > 1 else len(ROOMS)


def name_of(room):
    return ROOMS[room] if room < len(ROOMS) else "core"


def circles(includes):
    """Headers that include themselves through others."""
    found = []
    done = set()

    def visit(header, path):
        if header in path:
            found.append(" > ".join([*path[path.index(header):], header]))
            return
        if header in done:
            return
        for other in includes.get(header, []):
            visit(other, [*path, header])
        done.add(header)

    for header in includes:
        visit(header, [])
    return found


def main(root):
    core = root / "core"
    faults = []
    arrows = collections.Counter()
    includes = {}
    for folder in core.iterdir():
        if folder.is_dir() and folder.name not in ROOMS:
            faults.append(f"core/{folder.name} is no room")
    for source in sorted([*core.rglob("*.h"), *core.rglob("*.cpp")]):
        name = source.relative_to(core).as_posix()
        included = INCLUDE.findall(source.read_text())
        if name.endswith(".h"):
            includes[name] = included
        for header in included:
            if not (core / header).is_file():
                faults.append(f"core/{name} includes core/{header}, which does not exist")
                continue
            arrows[room_of(name), room_of(header)] += 1
            if room_of(header) > room_of(name):
                faults.append(f"core/{name} includes core/{header}, a later room's")
    faults += ["circle: " + circle for circle in circles(includes)]
    # A room's tests may use what comes after it: they compare it with the whole.
    for source in sorted((root / "tests").rglob("*_test.cpp")):
        room = source.relative_to(root / "tests").parts[0]
        if room not in [*ROOMS, "judge"] and source.parent != root / "tests":
            faults.append(f"{source.relative_to(root)} is in no room's folder")

    for room in range(len(ROOMS) + 1):
        own = [f"{name_of(other)} {arrows[room, other]}" for other in range(room) if arrows[room, other]]
        print(f"{name_of(room):8} -> {', '.join(own) or '-'}")
    print("\n".join(faults), file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(__file__).resolve().parent.parent))
