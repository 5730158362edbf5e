"""The independent reader against the worked examples of the documents, and against malformed input."""

from __future__ import annotations

import math

import pytest

from dli_fields import Raw
from dli_reader import (
    BadChecksum,
    BadLength,
    BadText,
    DliError,
    Truncated,
    UnassignedChecksumCode,
    UnknownEdition,
    UnknownMessage,
    decode_datagram,
    encode_body,
    identifier,
    identifier_text,
    wrap,
)
from dli_tables import EDITIONS, tables

SOURCE, DESTINATION = identifier("14:60:00:02"), identifier("14:20:00:02")

# The worked example: roll 10, pitch -5, heading 90 degrees, rates 0.10, -0.05, 0.02 rad/s, 2016-02-14 12:00:00Z.
HEADER = "FF FF 00 14 14 60 00 02 14 20 00 02 0F A0 "
ATTITUDE_DATA = "01 F8 01 76 74 D7 2E 00 07 1C FC 72 40 00 00 14 FF F6 00 04"
NO_CHECKSUM = bytes.fromhex(HEADER + "1E 00" + ATTITUDE_DATA)
TWO_BYTES = bytes.fromhex(HEADER + "1E 40" + ATTITUDE_DATA + "0A 92")
FOUR_BYTES = bytes.fromhex(HEADER + "1E 80" + ATTITUDE_DATA + "00 00 0A D2")
ALL_FIELDS = bytes.fromhex(
    "FF FF 00 2E 14 60 00 02 14 20 00 02 0F A0 1E 40"
    "03 FF FF 76 74 D7 2E 00 1B 89 2D FA F9 80 3D C0 00 17 89 03"
    "00 F6 FF A6 FF EC 00 00 00 00 00 00 07 1C FC 72 40 00"
    "00 14 FF F6 00 04 FE 39 16 54"
)

ATTITUDE_RAWS: dict[int, Raw] = {1: 508766400000, 12: 1820, 13: -910, 14: 16384, 15: 20, 16: -10, 17: 4}
ALL_RAWS: dict[int, Raw] = ATTITUDE_RAWS | {
    2: 461975034, 3: -109036096, 4: 6025, 5: 3, 6: 246, 7: -90, 8: -20, 9: 0, 10: 0, 11: 0, 18: -455,
}  # fmt: skip


@pytest.mark.parametrize("datagram, size", [(NO_CHECKSUM, 0), (TWO_BYTES, 2), (FOUR_BYTES, 4)])
def test_worked_example_is_read(datagram: bytes, size: int) -> None:
    (message,) = decode_datagram(datagram)
    assert message.wrapped.checksum_size == size
    assert (message.number, message.edition, message.wrapped.acknowledge) == (4000, "3", False)
    assert identifier_text(message.wrapped.source) == "14:60:00:02"
    assert identifier_text(message.wrapped.destination) == "14:20:00:02"
    assert {number: field.raw for number, field in message.fields.items()} == ATTITUDE_RAWS


@pytest.mark.parametrize("datagram, size", [(NO_CHECKSUM, 0), (TWO_BYTES, 2), (FOUR_BYTES, 4)])
def test_worked_example_is_written(datagram: bytes, size: int) -> None:
    data = encode_body(tables("3")[4000], ATTITUDE_RAWS)
    assert wrap(4000, data, source=SOURCE, destination=DESTINATION, checksum_size=size) == datagram


def test_all_eighteen_fields_are_read_and_written() -> None:
    (message,) = decode_datagram(ALL_FIELDS)
    assert {number: field.raw for number, field in message.fields.items()} == ALL_RAWS
    data = encode_body(tables("3")[4000], ALL_RAWS)
    assert wrap(4000, data, source=SOURCE, destination=DESTINATION, checksum_size=2) == ALL_FIELDS


def test_physical_values_of_the_worked_example() -> None:
    (message,) = decode_datagram(ALL_FIELDS)
    values = {number: field.value for number, field in message.fields.items()}
    assert math.degrees(values[2]) == pytest.approx(38.7223, abs=1e-7)
    assert math.degrees(values[3]) == pytest.approx(-9.1393, abs=1e-7)
    assert values[4] == pytest.approx(120.5)
    assert (values[6], values[7], values[8]) == pytest.approx((12.3, -4.5, -1.0))
    assert math.degrees(values[12]) == pytest.approx(10, abs=0.003)
    assert math.degrees(values[14]) == pytest.approx(90)
    assert (values[15], values[16], values[17]) == pytest.approx((0.10, -0.05, 0.02))
    assert values[5] is None, "an enumeration has no physical value"


def test_the_acknowledgement_bit_and_the_version_are_told_apart() -> None:
    data = encode_body(tables("A")[16002], {1: 0})
    datagram = wrap(16002, data, source=1, destination=2, edition="A", checksum_size=4, acknowledge=True)
    assert datagram[14:16] == b"\xa0\x80"
    (message,) = decode_datagram(datagram)
    assert (message.edition, message.wrapped.acknowledge, message.wrapped.sequence) == ("A", True, 0)


def test_several_messages_in_one_datagram() -> None:
    messages = decode_datagram(TWO_BYTES + ALL_FIELDS + NO_CHECKSUM)
    assert [len(message.fields) for message in messages] == [7, 18, 7]


@pytest.mark.parametrize("edition", EDITIONS)
def test_every_message_survives_with_all_fields_at_their_ends(edition: str) -> None:
    for table in tables(edition).values():
        for end in (0, 1):
            raws: dict[int, Raw] = {}
            for field in table.fields.values():
                span = field.raw_range
                raws[field.number] = span[end] if span else (1.5 if field.kind == "f" else "x" * max(field.width - 1, 0))
            if table.number == 32301:
                raws |= {7: 255 * end, 8: "u" * 255 * end}
            datagram = wrap(table.number, encode_body(table, raws), source=1, destination=2, edition=edition)
            (message,) = decode_datagram(datagram)
            assert {number: value.raw for number, value in message.fields.items()} == raws


def test_text_of_variable_length_ends_where_the_field_before_it_says() -> None:
    table = tables("3")[32301]
    data = encode_body(table, {1: 5, 7: 9, 8: "rtsp://a/", 9: 258})
    (message,) = decode_datagram(wrap(32301, data, source=1, destination=2))
    assert (message.fields[8].raw, message.fields[9].raw) == ("rtsp://a/", 258)


def test_text_of_variable_length_without_its_length_is_refused() -> None:
    data = encode_body(tables("3")[32301], {1: 5, 8: "a"})
    with pytest.raises(DliError, match="length field is absent"):
        decode_datagram(wrap(32301, data, source=1, destination=2))


def test_fixed_text_shows_its_padding() -> None:
    data = encode_body(tables("3")[13001], {1: 5, 3: "R1"})
    (message,) = decode_datagram(wrap(13001, data, source=1, destination=2))
    assert (message.fields[3].raw, message.fields[3].padding) == ("R1", bytes(31))


def test_text_that_is_not_ascii_is_refused() -> None:
    data = bytearray(encode_body(tables("3")[13001], {1: 5, 3: "R1"}))
    data[6] = 0xE4
    with pytest.raises(BadText):
        decode_datagram(wrap(13001, bytes(data), source=1, destination=2))


def test_every_shorter_datagram_is_refused() -> None:
    for datagram in (NO_CHECKSUM, TWO_BYTES, FOUR_BYTES, ALL_FIELDS):
        for size in range(len(datagram)):
            with pytest.raises(Truncated):
                decode_datagram(datagram[:size])


@pytest.mark.parametrize("datagram", [TWO_BYTES, FOUR_BYTES])
def test_any_changed_byte_is_noticed(datagram: bytes) -> None:
    for position in range(len(datagram)):
        damaged = bytearray(datagram)
        damaged[position] ^= 0x01
        with pytest.raises(DliError):
            decode_datagram(bytes(damaged))


def test_a_wrong_sum_is_named() -> None:
    with pytest.raises(BadChecksum, match="4000"):
        decode_datagram(TWO_BYTES[:-1] + b"\x93")


@pytest.mark.parametrize("length", [0, 529, 0xFFFF])
def test_a_length_outside_its_limits_is_refused(length: int) -> None:
    with pytest.raises(BadLength):
        decode_datagram(NO_CHECKSUM[:2] + length.to_bytes(2, "big") + NO_CHECKSUM[4:] + bytes(500))


def test_a_datagram_beyond_548_bytes_is_refused() -> None:
    with pytest.raises(BadLength):
        decode_datagram(NO_CHECKSUM * 16)


def test_the_unassigned_checksum_code_is_refused() -> None:
    with pytest.raises(UnassignedChecksumCode):
        decode_datagram(NO_CHECKSUM[:15] + b"\xc0" + NO_CHECKSUM[16:])


def test_an_unknown_version_needs_the_caller_to_choose() -> None:
    datagram = NO_CHECKSUM[:14] + b"\x1f" + NO_CHECKSUM[15:]
    with pytest.raises(UnknownEdition):
        decode_datagram(datagram)
    (message,) = decode_datagram(datagram, edition="3")
    assert len(message.fields) == 7


def test_an_unknown_message_number_is_refused() -> None:
    with pytest.raises(UnknownMessage, match="4999"):
        decode_datagram(wrap(4999, b"\x01" + bytes(5), source=1, destination=2))


def test_bytes_behind_the_last_field_are_refused() -> None:
    data = encode_body(tables("3")[16002], {1: 7}) + b"\0"
    with pytest.raises(BadLength):
        decode_datagram(wrap(16002, data, source=1, destination=2))


def test_a_bit_of_a_newer_edition_stops_the_decoding_there() -> None:
    newer = encode_body(tables("A")[3002], {1: 9, 2: 1, 21: 77, 24: 5})
    (message,) = decode_datagram(wrap(3002, newer, source=1, destination=2))
    assert set(message.fields) == {1, 2}
    assert message.unknown_bits == 1 << 20 | 1 << 23
    assert message.undecoded == (77).to_bytes(4, "big") + (5).to_bytes(2, "big")


@pytest.mark.parametrize("text", ["14:60:00", "14:60:00:2", "14600002"])
def test_identifiers_have_four_bytes(text: str) -> None:
    with pytest.raises(ValueError):
        identifier(text)
