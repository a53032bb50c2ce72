"""usage: tidy.py <clang-tidy> <build folder> <source> ...   clang-tidy, several sources at once

Most of clang-tidy's time goes into headers of Eigen and CGAL, again for every source. Sources whose
names at the outermost level differ are therefore joined into one; what is found there is reported
where it stands. Sources that do not compile together are looked at in halves, and these in halves.
"""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
# With clang-format's layout, what a namespace declares begins in the first column.
DECLARED = re.compile(r"(?!using namespace|namespace [\w: ]*\{)[a-zA-Z].*?([\w:~]+)(?=\(| = |;| \{| : |\[)")


def is_joined(source, file):
    """Whether CMake compiles `source` as a part of `file`."""
    return "/Unity/" in file and f'"{source}"' in pathlib.Path(file).read_text()


def compiler_flags(build, source):
    """What `source` means by: no names of files, no precompiled headers, warnings, optimisation."""
    commands = json.loads((build / "compile_commands.json").read_text())
    entry = next(e for e in commands if e["file"] == str(source) or is_joined(source, e["file"]))
    flags, words = [], iter(shlex.split(entry["command"])[1:])
    for word in words:
        if word in ("-o", "-c", "-include"):
            next(words)
        elif word.startswith("-") and not word.startswith(("-W", "-O")):
            flags.append(word)
            if word == "-isystem":
                flags.append(next(words))
    return flags


def declarations_in(text):
    """Name and line of what may have another meaning in another source; not members."""
    found = filter(None, map(DECLARED.match, text.splitlines()))
    return {match.group(1): match.string for match in found if "::" not in match.group(1)}


def agree(some, others):
    """The same alias may be declared again, nothing else."""
    return all(some[name] == others[name] and re.match("using|namespace", some[name])
               for name in some.keys() & others.keys())


def units(build, sources):
    """Lists of sources with the same flags that can be one."""
    result = []
    for source in sources:
        text = source.read_text()
        flags = compiler_flags(build, source)
        declared = declarations_in(text)
        # Macros change what the headers below them mean.
        is_alone = re.search(r"^# *define", text, re.MULTILINE) is not None
        for unit in result:
            if not is_alone and unit["flags"] == flags and agree(declared, unit["declared"]):
                unit["sources"].append(source)
                unit["declared"].update(declared)
                break
        else:
            result.append({"sources": [source], "declared": declared,
                           "flags": None if is_alone else flags})
    return result


def run(tidy, flags, sources):
    """Whether clang-tidy is content, and what it says with the places in `sources`."""
    with tempfile.TemporaryDirectory(dir=ROOT / "build") as folder:
        joined = pathlib.Path(folder) / "joined.cpp"
        places, text = [], []
        for source in sources:
            lines = source.read_text().splitlines()
            text += lines
            places += [(source, number) for number in range(1, len(lines) + 1)]
        joined.write_text("\n".join(text) + "\n")
        done = subprocess.run([tidy, "--quiet", f"--config-file={ROOT / '.clang-tidy'}", str(joined),
                               "--", *flags], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, cwd=ROOT, check=False)

    def place(match):
        source, number = places[min(int(match.group(1)), len(places)) - 1]
        return f"{source}:{number}:"
    said = re.sub(re.escape(str(joined)) + r":(\d+):", place, done.stdout)
    return done.returncode == 0, said or ("" if done.returncode == 0 else done.stderr)


def look_at(tidy, flags, sources):
    """As `run`."""
    print("Together:", *(source.relative_to(ROOT) for source in sources))
    content, said = run(tidy, flags, sources)
    if "clang-diagnostic-error" not in said or len(sources) == 1:
        return content, said
    clash = next(line for line in said.splitlines() if "clang-diagnostic-error" in line)
    print("They do not compile together:", clash)
    middle = len(sources) // 2
    halves = [look_at(tidy, flags, half) for half in (sources[:middle], sources[middle:])]
    return all(content for content, _ in halves), "".join(said for _, said in halves)


def main(tidy, build, *sources):
    build = pathlib.Path(build)
    good = True
    for unit in units(build, [pathlib.Path(source).resolve() for source in sources]):
        content, said = look_at(tidy, unit["flags"] or compiler_flags(build, unit["sources"][0]),
                                unit["sources"])
        good = good and content
        print(said, end="", flush=True)
    return 0 if good else 1


sys.exit(main(*sys.argv[1:]))
