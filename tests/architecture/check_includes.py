"""Does the code keep to the map of DESIGN.md? Includes and links point down, never up and never sideways, and engines
know no clock, no socket and no thread. Prints one line per violation; run it from anywhere."""

import re
import sys
from pathlib import Path

# What each library may include besides itself. An app may include everything.
VOCABULARY = {"core"}
MAP = {
    "core": set(),
    "definitions": set(),
    "mavlink": VOCABULARY,
    "dli": VOCABULARY,
    "vehicle": VOCABULARY,
    "autopilot": {"mavlink", "vehicle", "core"},
    "dlisession": {"dli", "vehicle", "core"},
    "planning": {"vehicle", "core"},
    "reflection": {"mavlink", "definitions", "core"},
    "transport": {"core"},
    "vsm": {"autopilot", "dlisession", "mavlink", "dli", "vehicle", "core"},
    "cucs": {"dlisession", "dli", "vehicle", "core"},
    "conformance": {"dlisession", "dli", "vehicle", "core"},
    "mission": {"planning", "vehicle", "core"},
    "sim": {"mavlink", "vehicle", "core"},
}
# The only library that may know sockets, threads and Asio; apps may too.
OUTSIDE_WORLD = "transport"

SUFFIXES = {".cpp", ".hpp", ".h", ".def", ".inl"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
LINK = re.compile(r"\bponte::(\w+)|(?<![\w$])ponte_(\w+)")
CMAKE_COMMENT = re.compile(r"#[^\n]*")
FORBIDDEN_HEADER = re.compile(
    r"(boost/)?asio(\.hpp|/.*)|thread|stop_token|future|sys/(socket|un|select|epoll)\.h|netinet/.*|arpa/.*|net/if\.h"
    r"|netdb\.h|poll\.h|termios\.h"
)
CLOCK = re.compile(r"\b\w*clock::now\b|\b(?:clock_gettime|gettimeofday)\s*\(|\bstd::time\s*\(")


def without_comments(text):
    """The code with its lines kept: comments become blanks, texts stay."""
    return COMMENT.sub(lambda m: m[0] if m[0].startswith('"') else re.sub(r"[^\n]", " ", m[0]), text)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def sources_below(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES and path.is_file())


def refuse_edge(library, other):
    """Why `library` may not use `other`; nothing when it may."""
    if other == library or other in MAP[library]:
        return None
    if other not in MAP:
        return f"{other} is not on the map"
    return f"{library} may not know {other}; it may know: {', '.join(sorted(MAP[library])) or 'nothing'}"


def include_violations(library, path):
    text = without_comments(path.read_text(encoding="utf-8"))
    for found in INCLUDE.finditer(text):
        name, line = found[1], line_of(text, found.start(1))
        parts = name.split("/")
        if ".." in parts or parts[0] == "apps":
            yield f"{path}:{line}: '{name}': an include begins with ponte/ and never climbs"
        elif parts[0] == "ponte" and len(parts) > 2:
            why = refuse_edge(library, parts[1])
            if why:
                yield f"{path}:{line}: '{name}': {why}"
        if library != OUTSIDE_WORLD and FORBIDDEN_HEADER.fullmatch(name):
            yield f"{path}:{line}: '{name}' belongs to {OUTSIDE_WORLD} and apps"
    if library != OUTSIDE_WORLD:
        for found in CLOCK.finditer(text):
            yield f"{path}:{line_of(text, found.start())}: '{found[0]}': an engine gets the time as an argument"


def library_of_target(target):
    """The box that a CMake target belongs to; generated code belongs to the library whose vocabulary it is."""
    if target == "dli_messages":
        return "dli"
    if target.startswith("mavlink_"):
        return "mavlink"
    return target


def link_violations(library, path):
    text = CMAKE_COMMENT.sub("", path.read_text(encoding="utf-8"))
    declared = re.findall(r"\bponte_library\s*\(\s*(\w+)", text)
    if declared != [library]:
        yield f"{path}: declares {declared or 'no library'}, expected the one library {library}"
    for found in LINK.finditer(text):
        target = found[1] or found[2]
        # Functions and interface targets of the build itself, and what only tests link.
        if target in {"library", "test", "options", "test_support"}:
            continue
        why = refuse_edge(library, library_of_target(target))
        if why:
            yield f"{path}:{line_of(text, found.start())}: '{found[0]}': {why}"


def violations(root):
    """Every violation below `root`, the repository, as `file:line: what`."""
    folder = Path(root) / "src" / "ponte"
    libraries = sorted(path for path in folder.glob("*") if path.is_dir())
    if not libraries:
        return [f"{folder}: no libraries are here"]
    found = []
    for path in libraries:
        if path.name not in MAP:
            found.append(f"{path}: {path.name} is not on the map")
            continue
        for source in sources_below(path):
            found += include_violations(path.name, source)
        for cmake in sorted(path.rglob("CMakeLists.txt")):
            found += link_violations(path.name, cmake)
    return found


def main():
    found = violations(Path(__file__).resolve().parents[2])
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
