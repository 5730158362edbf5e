"""Makes the corpus of the MAVLink benchmark and the C peer's part that depends on messages. pymavlink writes both.

usage: corpus.py FOLDER
"""

from __future__ import annotations

import json
import random
import string
import struct
import sys
from pathlib import Path
from typing import Any

from pymavlink.dialects.v10 import ardupilotmega as dialect_v1
from pymavlink.dialects.v20 import ardupilotmega as dialect_v2

SEED = 2016
FRAMES = 200_000
SAMPLES = 4_000  # different messages; the corpus repeats them, each time with another sequence number and checksum
KEY = bytes(range(32))
LINK_ID = 7
FIRST_TIMESTAMP = 10**12
DAMAGED = 0.05

# What an autopilot sends most, and what a station does. Their ids fit MAVLink 1.
NAMES = (
    "heartbeat sys_status system_time param_value gps_raw_int scaled_pressure raw_imu attitude attitude_quaternion "
    "local_position_ned global_position_int servo_output_raw scaled_imu nav_controller_output rc_channels "
    "request_data_stream vfr_hud command_long command_ack mission_item_int power_status highres_imu battery_status vibration "
    "home_position extended_sys_state statustext"
).split()

FORMATS = {
    "int8_t": "b", "uint8_t": "B", "int16_t": "h", "uint16_t": "H", "int32_t": "i", "uint32_t": "I",
    "int64_t": "q", "uint64_t": "Q", "float": "f", "double": "d",
}  # fmt: skip


def number(source: random.Random, kind: str) -> float | int:
    if kind in ("float", "double"):
        return float(struct.unpack("<f", struct.pack("<f", source.uniform(-1000.0, 1000.0)))[0])
    bits = source.getrandbits(8 * struct.calcsize("<" + FORMATS[kind]))
    # Small numbers are common, and so are the zeros that MAVLink 2 leaves out.
    bits = bits if source.random() < 0.5 else bits % 100
    return int(struct.unpack("<" + FORMATS[kind], bits.to_bytes(struct.calcsize(FORMATS[kind]), "little"))[0])


def sample(source: random.Random, dialect: Any, name: str) -> Any:
    """A message with random fields."""
    message_class = getattr(dialect, f"MAVLink_{name}_message")
    lengths = dict(zip(message_class.ordered_fieldnames, message_class.array_lengths, strict=True))
    kinds = dict(zip(message_class.fieldnames, message_class.fieldtypes, strict=True))
    values: list[Any] = []
    for field in message_class.fieldnames:
        length = lengths[field]
        if field == "mavlink_version":
            values.append(3)  # as every sender has it, and as the C headers insist
        elif kinds[field] == "char":
            values.append("".join(source.choices(string.ascii_letters, k=source.randint(1, length))).encode())
        elif length:
            values.append([number(source, kinds[field]) for _ in range(length)])
        else:
            values.append(number(source, kinds[field]))
    return message_class(*values)


def frames(dialect: Any, signed: bool) -> list[bytes]:
    """The corpus in one version."""
    source = random.Random(SEED)
    link = dialect.MAVLink(None, srcSystem=1, srcComponent=1)
    if signed:
        link.signing.secret_key = KEY
        link.signing.sign_outgoing = True
        link.signing.link_id = LINK_ID
        link.signing.timestamp = FIRST_TIMESTAMP
    samples = [sample(source, dialect, NAMES[index % len(NAMES)]) for index in range(SAMPLES)]
    result = []
    for index in range(FRAMES):
        result.append(bytes(samples[index * 7919 % SAMPLES].pack(link)))
        link.seq = (link.seq + 1) % 256
    return result


def damaged(clean: list[bytes]) -> tuple[bytes, int]:
    """One frame in twenty has a byte changed, or one fewer, or noise behind it. How many are left intact?"""
    source = random.Random(SEED)
    stream, intact = bytearray(), 0
    for frame in clean:
        if source.random() >= DAMAGED:
            stream += frame
            intact += 1
            continue
        at = source.randrange(len(frame))
        match source.randrange(3):
            case 0:
                stream += frame[:at] + bytes([frame[at] ^ source.randint(1, 255)]) + frame[at + 1 :]
            case 1:
                stream += frame[:at] + frame[at + 1 :]
            case _:
                stream += frame + source.randbytes(source.randint(1, 40))
                intact += 1
    return bytes(stream), intact


def c_messages() -> str:
    """decode_message(), keep_sample() and encode_all() of the C peer."""
    cases, stores, keeps, encodes = [], [], [], []
    for name in NAMES:
        message_class = getattr(dialect_v2, f"MAVLink_{name}_message")
        hashes = " ".join(f"HASH(fields.{field});" for field in message_class.fieldnames)
        cases.append(
            f"    case {message_class.id}: {{ mavlink_{name}_t fields; mavlink_msg_{name}_decode(message, &fields); "
            f"KEEP(fields); if (hash) {{ {hashes} }} return; }}"
        )
        stores.append(f"STORE({name})")
        keeps.append(f"    case {message_class.id}: KEEP_SAMPLE({name}); return;")
        encodes.append(f"  ENCODE({name});")
    return (
        "static inline __attribute__((always_inline)) void decode_message(const mavlink_message_t* message, "
        "uint64_t* hash) {\n  switch (message->msgid) {\n" + "\n".join(cases) + "\n  }\n}\n\n" + "\n".join(stores)
        + "\n\nstatic void keep_sample(const mavlink_message_t* message) {\n  switch (message->msgid) {\n"
        + "\n".join(keeps) + "\n  }\n}\n\nstatic void encode_all(struct Encoding* encoding) {\n" + "\n".join(encodes) + "\n}\n"
    )  # fmt: skip


def main() -> None:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    clean = {
        "v1": frames(dialect_v1, signed=False),
        "v2": frames(dialect_v2, signed=False),
        "v2_signed": frames(dialect_v2, signed=True),
    }
    for name, each in clean.items():
        (folder / f"{name}.bin").write_bytes(b"".join(each))
    noisy, intact = damaged(clean["v2"])
    (folder / "v2_noisy.bin").write_bytes(noisy)
    (folder / "corpus.json").write_text(json.dumps({"frames": FRAMES, "intact": intact, "types": len(NAMES)}))
    (folder / "peer_messages.h").write_text(c_messages())


if __name__ == "__main__":
    main()
