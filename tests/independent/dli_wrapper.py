"""The wrapper around every DLI message of Edition 3 and A: sixteen bytes in front, 0, 2 or 4 bytes of sum behind."""

from __future__ import annotations

import struct
from dataclasses import dataclass

HEADER_SIZE = 16
DATA_SIZE_MAX = 528
DATAGRAM_SIZE_MAX = 548

VERSION_OF_EDITION = {"3": 30, "A": 32}
EDITION_OF_VERSION = {version: edition for edition, version in VERSION_OF_EDITION.items()}
_CODE_OF_CHECKSUM_SIZE = {0: 0b00, 2: 0b01, 4: 0b10}
_CHECKSUM_SIZE_OF_CODE = {code: size for size, code in _CODE_OF_CHECKSUM_SIZE.items()}

_LAYOUT = struct.Struct(">HHIIHH")


class DliError(ValueError):
    """Bytes that are not a DLI message. Each subclass names one reason."""


class Truncated(DliError):
    """The bytes end inside a wrapper, a message, a checksum or a field."""


class BadLength(DliError):
    """The length in the wrapper, or the size of the datagram, is outside its limits."""


class BadChecksum(DliError):
    """The sum does not match."""


class UnassignedChecksumCode(DliError):
    """The checksum length code is 11, which Edition 3 leaves unassigned."""


@dataclass(frozen=True)
class Wrapped:
    """One message with its wrapper taken apart. `data` starts with the presence vector."""

    sequence: int
    source: int
    destination: int
    number: int
    acknowledge: bool
    version: int
    checksum_size: int
    reserved_bits: int
    data: bytes


def sum_of(content: bytes, size: int) -> bytes:
    """The plain sum of all bytes, in `size` bytes, most significant first."""
    return (sum(content) % (1 << (8 * size))).to_bytes(size, "big") if size else b""


def properties(edition: str, checksum_size: int, acknowledge: bool) -> int:
    """The sixteen bits of Message Properties."""
    code = _CODE_OF_CHECKSUM_SIZE[checksum_size]
    return (int(acknowledge) << 15) | (VERSION_OF_EDITION[edition] << 8) | (code << 6)


def identifier_text(identifier: int) -> str:
    """Four hexadecimal bytes with colons, as in 14:60:00:02."""
    return ":".join(f"{byte:02X}" for byte in identifier.to_bytes(4, "big"))


def identifier(text: str) -> int:
    """The number written as four hexadecimal bytes with colons."""
    parts = text.split(":")
    if len(parts) != 4 or any(len(part) != 2 for part in parts):
        raise ValueError(f"not an identifier: {text!r}")
    return int("".join(parts), 16)


def wrap(
    number: int,
    data: bytes,
    *,
    source: int,
    destination: int,
    edition: str = "3",
    checksum_size: int = 0,
    acknowledge: bool = False,
    sequence: int | None = None,
) -> bytes:
    """Puts the wrapper around message data. Edition 3 holds -1 in the first field, Edition A holds 0."""
    if not 1 <= len(data) <= DATA_SIZE_MAX:
        raise BadLength(f"message data of {len(data)} bytes")
    first = sequence if sequence is not None else {"3": 0xFFFF, "A": 0}[edition]
    bits = properties(edition, checksum_size, acknowledge)
    content = _LAYOUT.pack(first, len(data), source, destination, number, bits) + data
    return content + sum_of(content, checksum_size)


def unwrap(datagram: bytes, offset: int = 0) -> tuple[Wrapped, int]:
    """Takes the message at `offset` out of its wrapper. Returns it and the offset of the byte behind it."""
    if len(datagram) - offset < HEADER_SIZE:
        raise Truncated(f"{len(datagram) - offset} bytes at {offset} cannot hold a wrapper")
    sequence, length, source, destination, number, bits = _LAYOUT.unpack_from(datagram, offset)
    if not 1 <= length <= DATA_SIZE_MAX:
        raise BadLength(f"message length {length} at {offset}")
    code = bits >> 6 & 0b11
    if code not in _CHECKSUM_SIZE_OF_CODE:
        raise UnassignedChecksumCode(f"checksum length code 11 at {offset}")
    checksum_size = _CHECKSUM_SIZE_OF_CODE[code]
    data_end = offset + HEADER_SIZE + length
    end = data_end + checksum_size
    if end > len(datagram):
        raise Truncated(f"message at {offset} ends at {end}, the datagram at {len(datagram)}")
    if datagram[data_end:end] != sum_of(datagram[offset:data_end], checksum_size):
        raise BadChecksum(f"message {number} at {offset}")
    message = Wrapped(
        sequence=sequence,
        source=source,
        destination=destination,
        number=number,
        acknowledge=bool(bits >> 15),
        version=bits >> 8 & 0x7F,
        checksum_size=checksum_size,
        reserved_bits=bits & 0x3F,
        data=datagram[offset + HEADER_SIZE : data_end],
    )
    return message, end


def unwrap_all(datagram: bytes) -> list[Wrapped]:
    """All messages of one datagram, which are packed back to back."""
    if len(datagram) > DATAGRAM_SIZE_MAX:
        raise BadLength(f"datagram of {len(datagram)} bytes")
    if not datagram:
        raise Truncated("empty datagram")
    messages: list[Wrapped] = []
    offset = 0
    while offset < len(datagram):
        message, offset = unwrap(datagram, offset)
        messages.append(message)
    return messages
