#!/usr/bin/python3
"""Every relative link and picture in the Markdown pages leads to a file that is there and, after a #, to one of
its headings, as the usual forges name them."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"(?<!\\)\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")


def pages():
    skipped = {"build", "out", ".git"}
    return [p for p in sorted(ROOT.rglob("*.md")) if not skipped & set(p.relative_to(ROOT).parts)]


def prose(page):
    """The text without code."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", lambda code: code.group().replace("](", ""), text)


def anchors(page):
    found, counts = set(), {}
    for heading in re.findall(r"^#+\s+(.*?)\s*#*$", re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"),
                                                          flags=re.MULTILINE | re.DOTALL), re.MULTILINE):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        name = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        number = counts.get(name, 0)
        counts[name] = number + 1
        found.add(f"{name}-{number}" if number else name)
    return found


def main():
    dead = []
    count = 0
    for page in pages():
        for link in LINK.findall(prose(page)):
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            path, _, anchor = link.partition("#")
            target = (page.parent / path).resolve() if path else page
            if not target.exists():
                dead.append(f"{page.relative_to(ROOT)}: {link} is not there")
            elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                dead.append(f"{page.relative_to(ROOT)}: {link} is no heading")
    print(count, "links")
    print("\n".join(dead), file=sys.stderr)
    return 1 if dead or not count else 0


if __name__ == "__main__":
    sys.exit(main())
