"""Adds up the JUnit files that the test programs left in a folder, shows what failed, and ends with one line of counts."""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path


def main(folder: Path) -> int:
    passed = failed = skipped = 0
    for log in sorted(folder.glob("*.log")):
        result = log.with_suffix(".xml")
        cases = []
        if result.exists():
            cases = list(ElementTree.parse(result).iter("testcase"))
        if not cases:
            # A program that crashed leaves no result; one that ran nothing asserts nothing.
            failed += 1
            print(f"--- {log.stem}: no results\n{log.read_text(errors='replace')[-4000:]}")
            continue
        broken = False
        for case in cases:
            if case.find("failure") is not None or case.find("error") is not None:
                failed += 1
                broken = True
                print(f"--- FAILED {log.stem}: {case.get('classname')}.{case.get('name')}")
            elif case.find("skipped") is not None or case.get("status") == "notrun":
                skipped += 1
                print(f"--- skipped {case.get('classname')}.{case.get('name')}")
            else:
                passed += 1
        if broken:
            print(log.read_text(errors="replace")[-12000:])
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
