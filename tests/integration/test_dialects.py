"""Every dialect of the pinned pymavlink package becomes C++ that a compiler takes and that its readers agree with."""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pymavlink.dialects.v20
import pytest
from programs import REPOSITORY, cached, run

XML_FOLDER = Path(pymavlink.dialects.v20.__file__).parent
DIALECTS = sorted(path.stem for path in XML_FOLDER.glob("*.xml"))


def test_the_package_has_its_dialects() -> None:
    assert {"all", "ardupilotmega", "common", "minimal", "uAvionix"} <= set(DIALECTS)


@pytest.mark.parametrize("dialect", DIALECTS)
def test_the_dialect_becomes_code(probe: Callable[[str], Path], tmp_path: Path, dialect: str) -> None:
    name = dialect.lower()
    generated = run(
        [probe("ponte_codegen"), "mavlink", "--input", XML_FOLDER / f"{dialect}.xml", "--name", name, "--output", tmp_path]
    )
    assert (generated.returncode, generated.stderr) == (0, "")
    folder = tmp_path / "ponte" / "mavlink" / name
    # dialect.cpp includes the header of every message.
    compiled = run(
        [cached(probe("ponte_codegen"), "CMAKE_CXX_COMPILER"), "-std=c++20", "-Wall", "-Wextra", "-fsyntax-only",
         f"-I{tmp_path}", f"-I{REPOSITORY / 'src'}", folder / "enums.cpp", folder / "dialect.cpp"]
    )  # fmt: skip
    assert (compiled.returncode, compiled.stderr) == (0, "")


@pytest.mark.parametrize("dialect", DIALECTS)
def test_the_dialect_has_the_messages_of_pymavlink(probe: Callable[[str], Path], tmp_path: Path, dialect: str) -> None:
    digest = tmp_path / "digest.txt"
    run([probe("ponte_codegen"), "mavlink", "--input", XML_FOLDER / f"{dialect}.xml", "--write-digest", digest])
    rows = [line.split() for line in digest.read_text().splitlines() if not line.startswith("#")]
    peer = import_module(f"pymavlink.dialects.v20.{re.sub('[^0-9A-Za-z]', '_', dialect)}").mavlink_map
    assert {int(number): (int(crc), name) for number, crc, _, _, name in rows} == {
        number: (message.crc_extra, message.msgname) for number, message in peer.items()
    }
