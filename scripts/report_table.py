#!/usr/bin/python3
"""Prints the report of a run, `key = value` lines, as a table before → after.

usage: report_table.py <report.txt> <title>
"""
import sys


def read_report(path):
    with open(path, encoding="utf-8") as file:
        return dict(line.rstrip("\n").split(" = ", 1) for line in file if " = " in line)


def main(path, title):
    report = read_report(path)
    pairs = [key[: -len("_before")] for key in report
             if key.endswith("_before") and key[: -len("before")] + "after" in report]
    paired = {key + end for key in pairs for end in ("_before", "_after")}
    rows = [(key, report[key + "_before"], report[key + "_after"]) for key in pairs
            if not report[key + "_before"].startswith("((")]
    left = max([len(row[0]) for row in rows] + [24])
    middle = max([len(row[1]) for row in rows] + [12])
    print(f"\n{title}\n{'=' * len(title)}")
    print(f"{'':{left}}  {'before':{middle}}  after")
    for name, before, after in rows:
        print(f"{name:{left}}  {before:{middle}}  {after}")
    print()
    for key, value in report.items():
        if key not in paired:
            print(f"{key:{left}}  {value}")


if __name__ == "__main__":
    main(*sys.argv[1:])
