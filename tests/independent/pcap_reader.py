"""Reads the UDP payloads out of a classic pcap file, for judging a capture without Wireshark."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_ORDER_OF_MAGIC = {
    b"\xa1\xb2\xc3\xd4": ">", b"\xa1\xb2\x3c\x4d": ">", b"\xd4\xc3\xb2\xa1": "<", b"\x4d\x3c\xb2\xa1": "<",
}  # fmt: skip
_LINK_HEADER_SIZE = {0: 4, 1: 14, 12: 0, 101: 0, 113: 16, 228: 0}
_UDP = 17


class BadCapture(ValueError):
    """The file is not a pcap file, or a packet in it is not UDP over IPv4."""


class Packet(NamedTuple):
    """One UDP packet."""

    source_port: int
    destination_port: int
    payload: bytes


def ones_complement_sum(content: bytes) -> int:
    """The sum of the internet checksum; 0xFFFF over a header that holds its own checksum."""
    padded = content + bytes(len(content) % 2)
    total = sum(int.from_bytes(padded[i : i + 2], "big") for i in range(0, len(padded), 2))
    while total > 0xFFFF:
        total = (total & 0xFFFF) + (total >> 16)
    return total


def udp_packet(packet: bytes) -> Packet:
    """Takes an IPv4 packet apart and checks its lengths and its header checksum."""
    if len(packet) < 28 or packet[0] >> 4 != 4:
        raise BadCapture("not an IPv4 packet with UDP in it")
    header_size = (packet[0] & 0x0F) * 4
    total_size = int.from_bytes(packet[2:4], "big")
    if packet[9] != _UDP or total_size > len(packet):
        raise BadCapture(f"protocol {packet[9]}, {total_size} bytes announced, {len(packet)} there")
    if ones_complement_sum(packet[:header_size]) != 0xFFFF:
        raise BadCapture("the checksum of the IPv4 header is wrong")
    source, destination, udp_size, _ = struct.unpack_from(">HHHH", packet, header_size)
    if udp_size != total_size - header_size:
        raise BadCapture(f"UDP says {udp_size} bytes, IPv4 leaves {total_size - header_size}")
    return Packet(source, destination, packet[header_size + 8 : total_size])


def read_udp(path: Path) -> Iterator[Packet]:
    """All packets of the file in order."""
    content = path.read_bytes()
    order = _ORDER_OF_MAGIC.get(content[:4])
    if order is None or len(content) < 24:
        raise BadCapture(f"{path} is not a pcap file")
    link_type = struct.unpack_from(order + "I", content, 20)[0] & 0x0FFFFFFF
    if link_type not in _LINK_HEADER_SIZE:
        raise BadCapture(f"{path} has the link type {link_type}")
    offset = 24
    while offset < len(content):
        if len(content) - offset < 16:
            raise BadCapture(f"{path} ends inside the packet header at {offset}")
        captured, original = struct.unpack_from(order + "II", content, offset + 8)
        start = offset + 16
        offset = start + captured
        if captured != original or offset > len(content):
            raise BadCapture(f"{path}: the packet at {start} is cut")
        yield udp_packet(content[start + _LINK_HEADER_SIZE[link_type] : offset])
