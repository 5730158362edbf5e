"""Frames are taken apart and judged as pymavlink makes them."""

from __future__ import annotations

from pymavlink.dialects.v10 import common as v10
from pymavlink.dialects.v20 import common as v20

from mavlink_frames import Frame, checksum_is_right, crc_extra, decode, parse


def attitude(dialect, yaw: float = 3.0) -> bytes:
    link = dialect.MAVLink(None, srcSystem=7, srcComponent=9)
    link.seq = 200
    return dialect.MAVLink_attitude_message(5, 1.0, 2.0, yaw, 0.5, 0.25, 0.0).pack(link)


def test_headers_of_both_versions() -> None:
    assert parse(attitude(v10))[:5] == (1, 200, 7, 9, 30)
    assert parse(attitude(v20))[:5] == (2, 200, 7, 9, 30)


def test_checksums_of_both_versions() -> None:
    for dialect in (v10, v20):
        whole = attitude(dialect)
        assert checksum_is_right(parse(whole)) is True
        assert checksum_is_right(parse(whole[:-1] + bytes((whole[-1] ^ 1,)))) is False


def test_a_signature_is_not_part_of_the_checksum() -> None:
    link = v20.MAVLink(None, srcSystem=7, srcComponent=9)
    link.signing.secret_key = bytes(32)
    link.signing.sign_outgoing = True
    whole = bytes(v20.MAVLink_attitude_message(5, 1.0, 2.0, 3.0, 0.5, 0.25, 0.0).pack(link))
    assert checksum_is_right(parse(whole)) is True


def test_nobody_can_judge_an_unknown_message() -> None:
    assert crc_extra(0xABCDEF) is None
    assert checksum_is_right(Frame(2, 0, 1, 1, 0xABCDEF, attitude(v20))) is None


def test_messages_of_px4_have_a_checksum_byte() -> None:
    assert {number: crc_extra(number) for number in (291, 410, 436)} == {291: 10, 410: 160, 436: 193}


def test_values_come_out() -> None:
    message = decode(parse(attitude(v20, yaw=-3.0)))
    assert (message.roll, message.pitch, message.yaw, message.yawspeed) == (1.0, 2.0, -3.0, 0.0)
