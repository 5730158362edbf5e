"""One field of a DLI message: from bytes to a raw value, and back."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from dli_tables import Field
from dli_wrapper import DliError, Truncated

Raw = int | float | str


class BadText(DliError):
    """A text field holds bytes that are not ASCII."""


@dataclass(frozen=True)
class Value:
    """A decoded field. `value` is in the unit of the table and missing where no scale is known.

    `padding` is what a text field holds from its first NUL on; a well formed text of fixed length ends in NULs only.
    """

    field: Field
    raw: Raw
    value: float | None
    padding: bytes = b""


def encoded_size(field: Field, text_size: int | None) -> int:
    """How many bytes the field takes. Text of variable length takes what the field before it says."""
    if field.width:
        return field.width
    if text_size is None:
        raise DliError(f"field {field.number} is a text whose length field is absent")
    return text_size


def decode_field(field: Field, data: bytes, offset: int, text_size: int | None) -> tuple[Value, int]:
    """Decodes the field at `offset`. Returns it and the offset of the byte behind it."""
    end = offset + encoded_size(field, text_size)
    if end > len(data):
        raise Truncated(f"field {field.number} ends at {end}, the message data at {len(data)}")
    octets = data[offset:end]
    if field.kind == "c":
        text, found, rest = octets.partition(b"\0")
        try:
            return Value(field, text.decode("ascii"), None, found + rest), end
        except UnicodeDecodeError as error:
            raise BadText(f"field {field.number}: {error}") from error
    if field.kind == "f":
        raw: int | float = struct.unpack(">f", octets)[0]
    else:
        raw = int.from_bytes(octets, "big", signed=field.kind in "ib")
    return Value(field, raw, None if field.factor is None else raw * field.factor), end


def encode_field(field: Field, raw: Raw) -> bytes:
    """The bytes of one raw value; Python's own errors tell about values that do not fit."""
    if field.kind == "c":
        octets = str(raw).encode("ascii")
        if field.width and len(octets) >= field.width:
            raise ValueError(f"field {field.number}: no room for the NUL behind {raw!r}")
        return octets.ljust(field.width, b"\0")
    if field.kind == "f":
        return struct.pack(">f", raw)
    if not isinstance(raw, int):
        raise TypeError(f"field {field.number} needs an integer, not {raw!r}")
    return raw.to_bytes(field.width, "big", signed=field.kind in "ib")
