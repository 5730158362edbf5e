"""The independent reader of DLI datagrams, Edition 3 and A.

It is written from the documents, not from Ponte's code, so that it can judge what Ponte sends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dli_fields import BadText, Raw, Value, decode_field, encode_field
from dli_tables import Table, tables
from dli_wrapper import (
    EDITION_OF_VERSION,
    BadChecksum,
    BadLength,
    DliError,
    Truncated,
    UnassignedChecksumCode,
    Wrapped,
    identifier,
    identifier_text,
    unwrap_all,
    wrap,
)

__all__ = [
    "BadChecksum",
    "BadLength",
    "BadText",
    "DliError",
    "Message",
    "Truncated",
    "UnassignedChecksumCode",
    "UnknownEdition",
    "UnknownMessage",
    "decode_body",
    "decode_datagram",
    "encode_body",
    "identifier",
    "identifier_text",
    "wrap",
]

# The only text of variable length is the locator of #32301; the field before it says how long it is.
TEXT_LENGTH_FIELD = {(32301, 8): 7}


class UnknownEdition(DliError):
    """The IDD version in the wrapper is neither that of Edition 3 nor that of Edition A."""


class UnknownMessage(DliError):
    """There is no field table for this message number."""


@dataclass(frozen=True)
class Message:
    """One decoded message. `unknown_bits` are vector bits without a field; what they announce is in `undecoded`."""

    wrapped: Wrapped
    edition: str
    table: Table
    fields: dict[int, Value]
    unknown_bits: int
    undecoded: bytes

    @property
    def number(self) -> int:
        return self.wrapped.number


@dataclass(frozen=True)
class Body:
    """Message data taken apart, without its wrapper."""

    fields: dict[int, Value]
    unknown_bits: int
    undecoded: bytes


def decode_body(table: Table, data: bytes) -> Body:
    """Takes the presence vector and the present fields apart.

    A bit without a field means a newer edition: the known fields before it are decoded and the rest is left alone.
    Bytes behind the last announced field are an error.
    """
    if len(data) < table.vector_width:
        raise Truncated(f"message {table.number}: no room for a vector of {table.vector_width} bytes")
    vector = int.from_bytes(data[: table.vector_width], "big")
    present = [bit + 1 for bit in range(8 * table.vector_width) if vector >> bit & 1]
    unknown_bits = sum(1 << (number - 1) for number in present if number not in table.fields)
    fields: dict[int, Value] = {}
    offset = table.vector_width
    for number in present:
        if number not in table.fields:
            return Body(fields, unknown_bits, data[offset:])
        length_field = fields.get(TEXT_LENGTH_FIELD.get((table.number, number), 0))
        text_size = int(length_field.raw) if length_field else None
        fields[number], offset = decode_field(table.fields[number], data, offset, text_size)
    if offset != len(data):
        raise BadLength(f"message {table.number}: {len(data) - offset} bytes behind the last field")
    return Body(fields, 0, b"")


def encode_body(table: Table, raws: Mapping[int, Raw]) -> bytes:
    """The presence vector and the fields given by number, for building messages in tests."""
    vector = sum(1 << (number - 1) for number in raws)
    content = b"".join(encode_field(table.fields[number], raws[number]) for number in sorted(raws))
    return vector.to_bytes(table.vector_width, "big") + content


def decode_message(wrapped: Wrapped, edition: str | None = None) -> Message:
    """Decodes one message taken out of its wrapper; the wrapper tells the edition unless the caller does."""
    chosen = edition or EDITION_OF_VERSION.get(wrapped.version)
    if chosen is None:
        raise UnknownEdition(f"IDD version {wrapped.version}")
    table = tables(chosen).get(wrapped.number)
    if table is None:
        raise UnknownMessage(f"message {wrapped.number} in edition {chosen}")
    body = decode_body(table, wrapped.data)
    return Message(wrapped, chosen, table, body.fields, body.unknown_bits, body.undecoded)


def decode_datagram(datagram: bytes, edition: str | None = None) -> list[Message]:
    """All messages in the payload of one UDP datagram."""
    return [decode_message(wrapped, edition) for wrapped in unwrap_all(datagram)]
