"""Writes the first inputs of the MAVLink fuzz targets into fuzz/corpus: a few frames and files of every kind, which a
fuzzer would need long to guess. What the first bytes of an input choose is told in each target.

Usage: build/venv/bin/python fuzz/make_corpus.py
"""

from __future__ import annotations

import hashlib
import struct
import sys
from pathlib import Path
from typing import Any

from pymavlink.dialects.v10 import ardupilotmega as version_1
from pymavlink.dialects.v20 import ardupilotmega as version_2

REPOSITORY = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(REPOSITORY / "tests" / "independent"))

import mavlink_v09  # noqa: E402
import tlog  # noqa: E402

KEY = hashlib.sha256(b"words").digest()
SIGNED_AT = 27_992_959_000_000  # 10 us since 2015: ten seconds before the time of the target
PREFLIGHT_REBOOT = 246
REBOOT = 11  # of MAV_ACTION
RAW, REPAIRED = b"\0", b"\1"  # first byte: whether checksums are made right

old = [
    mavlink_v09.pack("HEARTBEAT", 2, 3, 2),
    mavlink_v09.pack("ATTITUDE", 1_000_000, 0.1, 0.2, 0.3, 0.01, 0.02, 0.03, sequence=1),
    mavlink_v09.pack("ACTION", 1, 1, REBOOT, sequence=2, system=255),
    mavlink_v09.pack("STATUSTEXT", 1, b"text", sequence=3),
]


def frames(dialect: Any, system: int = 1, sequence: int = 0) -> list[bytes]:
    """What a vehicle and a station say, in one version."""
    link = dialect.MAVLink(None, srcSystem=system, srcComponent=1)
    link.seq = sequence
    return [
        bytes(message.pack(link))
        for message in (
            dialect.MAVLink_heartbeat_message(2, 3, 81, 0, 4, 3),
            dialect.MAVLink_attitude_message(5, 0.1, -0.2, 3, 0.01, 0.02, -0.03),
            dialect.MAVLink_global_position_int_message(5, -353632610, 1491652300, 584000, 100, 1, 2, 3, 9000),
            dialect.MAVLink_param_request_list_message(2, 1),
            dialect.MAVLink_command_long_message(1, 1, PREFLIGHT_REBOOT, 0, 1, 0, 0, 0, 0, 0, 0),
            dialect.MAVLink_serial_control_message(10, 0, 0, 0, 1, [104] + [0] * 69),
            dialect.MAVLink_statustext_message(6, b"EKF3 IMU0 is using GPS"),
        )
    ]


def signed(messages: int, link_id: int) -> list[bytes]:
    link = version_2.MAVLink(None, srcSystem=1, srcComponent=1)
    link.signing.secret_key, link.signing.link_id, link.signing.timestamp = KEY, link_id, SIGNED_AT
    link.signing.sign_outgoing = True
    return [bytes(version_2.MAVLink_heartbeat_message(2, 3, 81, 0, 4, 3).pack(link)) for _ in range(messages)]


def setup_signing() -> bytes:
    message = version_2.MAVLink_setup_signing_message(1, 1, list(KEY), SIGNED_AT)
    return bytes(message.pack(version_2.MAVLink(None, srcSystem=255, srcComponent=190)))


def store(time: int) -> bytes:
    """Both slots of a stored signing time."""
    return b"".join(struct.pack("<QQ", each, each ^ 0xFFFF_FFFF_FFFF_FFFF) for each in (time, time + 1))


def with_head(policy: int, head: bytes, rest: list[bytes]) -> bytes:
    return bytes((policy, len(head))) + head + b"".join(rest)


def recorded(name: str, records: int) -> bytes:
    path = REPOSITORY / "tests" / "recordings" / name
    return tlog.packed((each.time_us, each.frame) for each, _ in zip(tlog.read_records(path), range(records)))


def flight(name: str, size: int) -> bytes:
    """The first frame of each message of each sender of a recording, as far as there is room."""
    kinds: dict[bytes, bytes] = {}
    for record in tlog.read_records(REPOSITORY / "tests" / "recordings" / name):
        frame = record.frame
        kinds.setdefault(frame[5:10] if frame[0] == 0xFD else frame[3:6], frame)
    return b"".join(kinds.values())[:size]


def text(kind: int, path: str) -> bytes:
    return bytes((kind, 0)) + (REPOSITORY / path).read_bytes()


def heard(message: Any, wait: int = 25) -> bytes:
    """A message of the vehicle in the input of fuzz_autopilot_services, which numbers those that it names; 4 ms steps."""
    names = (
        "COMMAND_ACK", "HEARTBEAT", "EXTENDED_SYS_STATE", "GLOBAL_POSITION_INT", "HOME_POSITION", "STATUSTEXT",
        "TIMESYNC", "GIMBAL_MANAGER_INFORMATION", "GIMBAL_MANAGER_STATUS",
    )  # fmt: skip
    payload = bytes(message.pack(version_2.MAVLink(None, srcSystem=1, srcComponent=1)))[10:-2]
    return bytes((wait, 0, names.index(message.get_type()), 0, len(payload))) + payload


def wished(number: int) -> bytes:
    return bytes((25, number << 1 | 1))


def accepted(command: int, result: int = 0) -> bytes:
    return heard(version_2.MAVLink_command_ack_message(command, result, 0, 0, 255, 190))


def services(stack: int, mode: int) -> bytes:
    """A vehicle takes off, goes somewhere, is steered, points its gimbal, and refuses to be disarmed."""
    take_off, go_to, steer, find_manager, take_control, point, disarm = 2, 6, 8, 9, 10, 11, 1
    def state(armed: bool) -> bytes:
        return heard(version_2.MAVLink_heartbeat_message(2, 3, 209 if armed else 81, mode, 4, 3))

    home = version_2.MAVLink_home_position_message(-300689800, -511217900, 50000, 0, 0, 0, [1, 0, 0, 0], 0, 0, 0)
    parts = [heard(home), state(False), wished(take_off), accepted(176), accepted(400), accepted(22), state(True)]
    parts += [heard(version_2.MAVLink_extended_sys_state_message(0, 2)), wished(go_to), accepted(192, 9), accepted(192)]
    parts += [state(True), wished(steer), accepted(176), state(True), wished(find_manager), accepted(512)]
    parts += [heard(version_2.MAVLink_gimbal_manager_information_message(5, 7, 1, -1, 1, -1, 1, -3, 3))]
    parts += [wished(take_control), accepted(1001), wished(point), accepted(1000), wished(disarm), accepted(400, 4)]
    parts += [heard(version_2.MAVLink_statustext_message(2, b"Disarm: in the air"))]
    return bytes((stack,)) + b"".join(parts)


def corpus() -> dict[str, bytes]:
    unknown = bytes.fromhex("fd03000000ffbe5634120102030000")
    first, second = frames(version_1), frames(version_2)
    mixed = [part for parts in zip(old, first, second) for part in parts]
    times = [1_700_000_000_000_000 + 20_000 * index for index in range(len(second))]
    log = tlog.packed(zip(times, second))
    return {
        "autopilot_services/ardupilot": services(0, 4),
        "autopilot_services/px4": services(2, 0x0304_0000),
        "mavlink_parser/versions": RAW + b"\x07" + b"".join(mixed),
        "mavlink_parser/signed_unknown_and_noise": RAW + b"\x40" + b"console text\n".join([*signed(2, 1), unknown, *second]),
        "mavlink_parser/cut_short": RAW + b"\x00" + b"".join(frame[:-3] + frame for frame in second),
        "mavlink_parser/fields_to_change": REPAIRED + b"\xff" + b"".join(second),
        "mavlink_parser/overlapping": bytes((1 | 20 << 1, 3)) + second[1] + second[1][10:] + b"".join(first),
        "router/systems_and_targets": bytes(range(16)) + b"".join(frames(version_2, 1) + frames(version_2, 2, 50)),
        "router/risky": bytes((6, 7) * 8) + b"".join([*second, *first, *old, setup_signing()]),
        "router/duplicates_and_leavers": bytes((0, 1, 255, 3) * 4) + b"".join([*second, *second, unknown, unknown]),
        "signing/signed_and_replayed": with_head(2, KEY, [*signed(4, 1), *signed(2, 1), *signed(1, 2)]),
        "signing/unsigned": with_head(1, b"passphrase=words\n", [*second, *signed(2, 3), *second, *old, *first]),
        "signing/set_up": with_head(0, KEY.hex().encode() + b"\n", [setup_signing(), *second]),
        "signing/stored_time": with_head(2, store(SIGNED_AT), signed(2, 1)),
        "tlog_reader/one_flight": RAW + log,
        "tlog_reader/repaired_and_damaged": REPAIRED + log[:100] + b"lost" + log[100:] + log[:60],
        "tlog_reader/ardupilot": RAW + recorded("ap_mission_v2_trimmed.tlog.gz", 40),
        "tlog_reader/px4": RAW + recorded("px4_mission_v2_trimmed.tlog.gz", 40),
        "vsm_bridge/two_versions": bytes(range(0, 256, 16)) + b"".join([*second, *old[:2], *second[1:3]]),
        "vsm_bridge/ardupilot": bytes((127, 200) * 8) + flight("ap_mission_v2_trimmed.tlog.gz", 6000),
        "vsm_bridge/px4": bytes((127, 200) * 8) + flight("px4_mission_v2_trimmed.tlog.gz", 6000),
        "definition_readers/dli": text(0, "definitions/dli/data_link_transition.toml"),
        "definition_readers/mavlink_additions": text(1, "definitions/mavlink/additions.xml"),
        "definition_readers/mavlink_dialect": text(1, "examples/lamps.xml").replace(b"  <include>minimal.xml</include>\n", b""),
        "definition_readers/profile": text(2, "config/profiles/dissertation-2016.toml"),
    }


if __name__ == "__main__":
    for name, content in corpus().items():
        target = REPOSITORY / "fuzz" / "corpus" / f"fuzz_{name}"
        target.parent.mkdir(exist_ok=True)
        target.write_bytes(content)
