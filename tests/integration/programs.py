"""Finds and runs the programs under test."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
PONTE_DEFAULT = REPOSITORY / "build" / "release" / "bin" / "ponte"

# Far beyond what any of these runs needs: it ends a program that hangs, and judges no speed.
HANG_LIMIT_S = 900


def program_from(variable: str, name: str | None, default: Path | None) -> Path:
    """The program that an environment variable points to, directly or as `name` in a folder. Fails when missing."""
    setting = os.environ.get(variable)
    if setting is None and default is None:
        pytest.fail(f"set {variable} to the folder that holds {name}", pytrace=False)
    path = Path(setting).absolute() if setting else default
    assert path is not None
    path = path / name if name else path
    if not (path.is_file() and os.access(path, os.X_OK)):
        pytest.fail(f"there is no program {path} ({variable} is {setting!r}); build it first", pytrace=False)
    return path


def cached(program: Path, variable: str) -> str:
    """What the build that made `program` was configured with: an entry of its CMake cache."""
    for line in (program.parents[1] / "CMakeCache.txt").read_text().splitlines():
        name, _, value = line.partition("=")
        if name.partition(":")[0] == variable:
            return value
    pytest.fail(f"the build of {program} knows no {variable}", pytrace=False)


def seed_or(default: int) -> int:
    """The seed of a random test, which PONTE_SEED replaces."""
    return int(os.environ.get("PONTE_SEED", default))


def run(command: Sequence[str | Path], stdin: str | None = None) -> subprocess.CompletedProcess[str]:
    """Runs a program to its end."""
    return subprocess.run(
        [str(part) for part in command], input=stdin, capture_output=True, text=True, timeout=HANG_LIMIT_S, check=False
    )


def _no_constant(text: str) -> Any:
    raise ValueError(f"{text} is not JSON")


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    keys = [key for key, _ in pairs]
    if len(set(keys)) != len(keys):
        raise ValueError(f"a key comes twice in {keys}")
    return dict(pairs)


def parse_json(line: str) -> Any:
    """Parses one line of JSON, without Python's extensions for NaN and infinities, and with every key once."""
    return json.loads(line, parse_constant=_no_constant, object_pairs_hook=_without_duplicates)


def json_objects(command: Sequence[str | Path]) -> Iterator[dict[str, Any]]:
    """Runs a program and gives its JSON lines as they come; in the end the program must have left with status 0."""
    with tempfile.TemporaryFile("w+") as errors:
        with subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, stderr=errors, text=True) as process:
            assert process.stdout is not None
            try:
                for line in process.stdout:
                    yield parse_json(line)
            except BaseException:
                process.kill()
                raise
            status = process.wait(HANG_LIMIT_S)
        errors.seek(0)
        assert status == 0, f"{command} left with status {status}: {errors.read()[-2000:]}"
