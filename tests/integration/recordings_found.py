"""Which recordings there are: small ones in the repository, and all shared ones where that folder exists."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from programs import REPOSITORY

OWN_FOLDER = REPOSITORY / "tests" / "recordings"
SHARED_FOLDER = REPOSITORY.parent / "shared" / "recordings"


def parameters() -> list[Any]:
    """One pytest parameter for each recording. A missing shared folder is one skipped parameter, so that it counts."""
    own = [pytest.param(path, id=f"own/{path.name}") for path in sorted(OWN_FOLDER.glob("*.tlog.gz"))]
    shared = [pytest.param(path, id=f"shared/{path.name}") for path in sorted(SHARED_FOLDER.glob("*.tlog.gz"))]
    if not shared:
        reason = f"there are no recordings in {SHARED_FOLDER}"
        shared = [pytest.param(SHARED_FOLDER, id="shared", marks=pytest.mark.skip(reason=reason))]
    return own + shared
