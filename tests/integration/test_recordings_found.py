"""Recordings that are not there are skipped in sight, not left out in silence."""

from __future__ import annotations

from pathlib import Path

import pytest

import recordings_found


def test_a_missing_shared_folder_is_one_skipped_parameter(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(recordings_found, "SHARED_FOLDER", tmp_path / "none")
    *own, last = recordings_found.parameters()
    assert len(own) == 4
    assert [mark.name for mark in last.marks] == ["skip"]


def test_every_shared_recording_is_a_parameter(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for name in ("a.tlog.gz", "b.tlog.gz", "notes.md"):
        (tmp_path / name).touch()
    monkeypatch.setattr(recordings_found, "SHARED_FOLDER", tmp_path)
    found = recordings_found.parameters()
    assert [parameter.id for parameter in found[-2:]] == ["shared/a.tlog.gz", "shared/b.tlog.gz"]
    assert not any(parameter.marks for parameter in found)
