"""Decodes what the page shows with the independent readers: pymavlink, and tests/independent for the DLI.

Each line of stdin is a side, `mavlink` or `dli`, and the bytes of one message in hexadecimal. Each line of stdout is
what they say, as JSON: {"fields": {NAME: VALUE}}, or {"number": N, "fields": {BIT: {"raw": R, "value": V, "unit": U}}}.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "tests" / "independent"))

import mavlink_frames  # noqa: E402
from dli_reader import decode_datagram  # noqa: E402


def mavlink(octets: bytes) -> dict[str, object]:
    fields = mavlink_frames.decode(mavlink_frames.parse(octets)).to_dict()
    del fields["mavpackettype"]
    return {"fields": fields}


def dli(octets: bytes) -> dict[str, object]:
    (message,) = decode_datagram(octets)
    fields = {
        number - 1: {"raw": value.raw, "value": value.value, "unit": value.field.unit}
        for number, value in message.fields.items()
    }
    return {"number": message.number, "fields": fields}


for line in sys.stdin:
    side, text = line.split()
    print(json.dumps({"mavlink": mavlink, "dli": dli}[side](bytes.fromhex(text))))
