"""Cuts the small recordings of this folder out of the large shared ones.

Usage: python trim.py path/to/shared/recordings

The whole life of a flight stays in: every heartbeat, text, command, mission message, event and clock message, all that
the ground station says, and SYS_STATUS whenever sensors or battery change. Telemetry is thinned out evenly. Frames and
times stay as recorded, so sequence numbers have gaps where frames were left out.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "independent"))

import mavlink_frames  # noqa: E402
import tlog  # noqa: E402

FLIGHTS = ("ap_mission_v1", "ap_mission_v2", "ap_signing_v2", "px4_mission_v2")
RAW_DATAGRAMS = "ap_boot_raw_datagrams.txt.gz"
AUTOPILOT_SYSTEM = 1
SYS_STATUS, ATTITUDE, GLOBAL_POSITION_INT, VFR_HUD = 1, 30, 33, 74

WHOLE_PREFIXES = ("MISSION_", "COMMAND_")
WHOLE_NAMES = {
    "HEARTBEAT", "STATUSTEXT", "SYSTEM_TIME", "HOME_POSITION", "GPS_GLOBAL_ORIGIN", "AUTOPILOT_VERSION",
    "EXTENDED_SYS_STATE", "PARAM_VALUE", "TIMESYNC", "PING", "CURRENT_MODE",
}  # fmt: skip
WHOLE_IDS_OF_OTHERS = {410, 411}  # EVENT and CURRENT_EVENT_SEQUENCE of PX4

FLIGHT_PATH_US = 200_000
OTHER_TELEMETRY_US = 2_000_000


class Trimmer:
    """Decides frame by frame what stays."""

    def __init__(self) -> None:
        self._next_time: dict[int, int] = {}
        self._status: tuple[int, ...] = ()

    def stays(self, time_us: int, frame: mavlink_frames.Frame) -> bool:
        if frame.system != AUTOPILOT_SYSTEM or self._stays_whole(frame.message_id):
            return True
        if frame.message_id == SYS_STATUS and self._status_changed(frame):
            return True
        return self._is_due(time_us, frame.message_id)

    @staticmethod
    def _stays_whole(message_id: int) -> bool:
        known = mavlink_frames.dialect.mavlink_map.get(message_id)
        name = known.msgname if known else ""
        return name in WHOLE_NAMES or name.startswith(WHOLE_PREFIXES) or message_id in WHOLE_IDS_OF_OTHERS

    def _status_changed(self, frame: mavlink_frames.Frame) -> bool:
        m = mavlink_frames.decode(frame)
        before, self._status = self._status, (
            m.onboard_control_sensors_present,
            m.onboard_control_sensors_enabled,
            m.onboard_control_sensors_health,
            m.battery_remaining,
        )
        return before != self._status

    def _is_due(self, time_us: int, message_id: int) -> bool:
        path = message_id in (ATTITUDE, GLOBAL_POSITION_INT, VFR_HUD)
        if time_us < self._next_time.get(message_id, 0):
            return False
        self._next_time[message_id] = time_us + (FLIGHT_PATH_US if path else OTHER_TELEMETRY_US)
        return True


def trimmed(path: Path) -> Iterator[tuple[int, bytes]]:
    """The records of a recording that stay."""
    trimmer = Trimmer()
    for record in tlog.read_records(path):
        if trimmer.stays(record.time_us, mavlink_frames.parse(record.frame)):
            yield record.time_us, record.frame


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    source, target = Path(arguments[0]), Path(__file__).parent
    for name in FLIGHTS:
        tlog.write_log(target / f"{name}_trimmed.tlog.gz", trimmed(source / f"{name}.tlog.gz"))
    shutil.copyfile(source / RAW_DATAGRAMS, target / RAW_DATAGRAMS)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
