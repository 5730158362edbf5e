"""What all integration tests share: the folders, and the programs under test.

PONTE_BIN is the path of the program ponte (build/release/bin/ponte if it is not set), PONTE_TOOLS the folder with the
probes that only tests use, PONTE_SEED replaces the seed of the random tests.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "independent"))

from programs import HANG_LIMIT_S, PONTE_DEFAULT, REPOSITORY, program_from  # noqa: E402


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "once: takes long and does not depend on the compiler; run with the preset dev only")


@pytest.fixture(scope="session")
def repository() -> Path:
    """The root of the repository."""
    return REPOSITORY


@pytest.fixture(scope="session")
def ponte() -> Path:
    """The program under test."""
    return program_from("PONTE_BIN", None, PONTE_DEFAULT)


@pytest.fixture(scope="session")
def probe() -> Callable[[str], Path]:
    """Gives the path of a probe by its name."""
    return lambda name: program_from("PONTE_TOOLS", name, None)


@pytest.fixture
def start_ponte(ponte: Path) -> Iterator[Callable[..., None]]:
    """Starts ponte with these arguments, and ends it after the test."""
    running: list[subprocess.Popen[bytes]] = []

    def start(*arguments: str) -> None:
        running.append(subprocess.Popen([str(ponte), *arguments]))

    yield start
    for process in running:
        assert process.poll() is None, f"{process.args} has ended by itself with {process.returncode}"
        process.terminate()
        assert process.wait(HANG_LIMIT_S) == 0


@pytest.fixture
def start_vsm(start_ponte: Callable[..., None]) -> Callable[..., None]:
    """Starts the VSM between two endpoints. It sends nothing to vehicles."""

    def start(vehicle: str, dli: str, *options: str) -> None:
        start_ponte("vsm", "--vehicle", vehicle, "--dli", dli, "--every-sample", "--listen-only", *options)

    return start
