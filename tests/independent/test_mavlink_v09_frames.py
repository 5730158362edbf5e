"""The golden frames that the C headers of 2011 make (the team's notes on MAVLink, section 1.4)."""

from __future__ import annotations

import mavlink_v09


def test_golden_frames() -> None:
    assert mavlink_v09.pack("HEARTBEAT", 2, 3, 2).hex() == "550300010100020302f145"
    attitude = mavlink_v09.pack("ATTITUDE", 1_000_000, 0.1, 0.2, 0.3, 0.01, 0.02, 0.03, sequence=1)
    assert attitude.hex() == (
        "55200101011e00000000000f42403dcccccd3e4ccccd3e99999a3c23d70a3ca3d70a3cf5c28f24c6"
    )
    status = mavlink_v09.pack("SYS_STATUS", 1, 2, 3, 400, 11100, 900, 5, sequence=3)
    assert status.hex() == "550b0301012201020301902b5c03840005c8ce"


def test_reads_what_it_writes() -> None:
    stream = mavlink_v09.pack("ACTION", 1, 1, 26) + mavlink_v09.pack("VFR_HUD", 1, 2, -3, 4, 5, 6, system=9)
    first, second = mavlink_v09.unpack(stream)
    assert (first.name, first.fields) == ("ACTION", {"target": 1, "target_component": 1, "action": 26})
    assert (second.system, second.fields["heading"], second.fields["climb"]) == (9, -3, 6.0)
