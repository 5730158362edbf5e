"""The pcap reader against a capture built by hand from the format."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest

from pcap_reader import BadCapture, Packet, ones_complement_sum, read_udp

PAYLOAD = bytes(range(36))


def ipv4_udp(payload: bytes) -> bytes:
    size = 28 + len(payload)
    head = struct.pack(">BBHHHBBH4s4s", 0x45, 0, size, 1, 0, 1, 17, 0, bytes((10, 0, 0, 1)), bytes((239, 255, 45, 86)))
    check = 0xFFFF ^ ones_complement_sum(head)
    udp = struct.pack(">HHHH", 4000, 45860, 8 + len(payload), 0)
    return head[:10] + check.to_bytes(2, "big") + head[12:] + udp + payload


def capture(order: str, magic: int, link_type: int, packets: list[bytes]) -> bytes:
    head = struct.pack(order + "IHHiIII", magic, 2, 4, 0, 0, 65535, link_type)
    return head + b"".join(struct.pack(order + "IIII", 1, 2, len(p), len(p)) + p for p in packets)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("magic", [0xA1B2C3D4, 0xA1B23C4D])
@pytest.mark.parametrize("link_type, before", [(1, bytes(12) + b"\x08\x00"), (101, b""), (0, bytes(4))])
def test_payloads_come_out(tmp_path: Path, order: str, magic: int, link_type: int, before: bytes) -> None:
    path = tmp_path / "a.pcap"
    path.write_bytes(capture(order, magic, link_type, [before + ipv4_udp(PAYLOAD), before + ipv4_udp(b"x")]))
    assert list(read_udp(path)) == [Packet(4000, 45860, PAYLOAD), Packet(4000, 45860, b"x")]


def damaged_protocol(packet: bytes) -> bytes:
    return packet[:9] + b"\x06" + packet[10:]


def damaged_checksum(packet: bytes) -> bytes:
    return packet[:10] + b"\x00\x00" + packet[12:]


def damaged_udp_size(packet: bytes) -> bytes:
    return packet[:24] + b"\x00\x09" + packet[26:]


@pytest.mark.parametrize("damage", [damaged_protocol, damaged_checksum, damaged_udp_size])
def test_wrong_packets_are_refused(tmp_path: Path, damage) -> None:
    path = tmp_path / "a.pcap"
    path.write_bytes(capture("<", 0xA1B2C3D4, 101, [damage(ipv4_udp(PAYLOAD))]))
    with pytest.raises(BadCapture):
        list(read_udp(path))


@pytest.mark.parametrize("size", [0, 10, 23, 30, 39, 60])
def test_cut_files_are_refused(tmp_path: Path, size: int) -> None:
    path = tmp_path / "a.pcap"
    path.write_bytes(capture("<", 0xA1B2C3D4, 101, [ipv4_udp(PAYLOAD)])[:size])
    with pytest.raises(BadCapture):
        list(read_udp(path))
