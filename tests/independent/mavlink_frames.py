"""MAVLink frames as pymavlink's definitions see them: header, checksum, and the values of a few messages."""

from __future__ import annotations

from typing import NamedTuple

from pymavlink.dialects.v20 import all as dialect

import tlog

# Checksum bytes of messages that PX4 sends and the pymavlink package does not define.
CRC_EXTRA_OF_OTHERS = {8: 117, 290: 251, 291: 10, 300: 217, 380: 232, 410: 160, 411: 106, 514: 197}

_PARSER = dialect.MAVLink(None)


class Frame(NamedTuple):
    """The header of a frame, and the whole of it."""

    version: int
    sequence: int
    system: int
    component: int
    message_id: int
    whole: bytes


def parse(whole: bytes) -> Frame:
    """Reads the header of a whole frame."""
    if whole[0] == 0xFE:
        return Frame(1, whole[2], whole[3], whole[4], whole[5], whole)
    return Frame(2, whole[4], whole[5], whole[6], int.from_bytes(whole[7:10], "little"), whole)


def crc_extra(message_id: int) -> int | None:
    """The checksum byte of a message, or nothing for a message that nobody here knows."""
    known = dialect.mavlink_map.get(message_id)
    return known.crc_extra if known else CRC_EXTRA_OF_OTHERS.get(message_id)


def checksum_is_right(frame: Frame) -> bool | None:
    """Whether the checksum matches; nothing when the message is unknown, so that nobody can tell."""
    extra = crc_extra(frame.message_id)
    if extra is None:
        return None
    signed = frame.version == 2 and frame.whole[2] & tlog.SIGNED_FLAG
    end = len(frame.whole) - (tlog.SIGNATURE_SIZE if signed else 0) - 2
    expected = dialect.x25crc(frame.whole[1:end] + bytes((extra,))).crc
    return int.from_bytes(frame.whole[end : end + 2], "little") == expected


def decode(frame: Frame) -> dialect.MAVLink_message:
    """The message as pymavlink decodes it; its own exception tells about a bad frame."""
    return _PARSER.decode(bytearray(frame.whole))
