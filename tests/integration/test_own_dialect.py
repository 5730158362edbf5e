"""`--dialect`: messages that ponte was not built with, in files whose frames the test makes itself."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from programs import parse_json, run
from pymavlink.dialects.v20 import ardupilotmega
from pymavlink.generator.mavcrc import x25crc
from vsm_bench import Udp
from web_client import Server

OWN_XML = """<mavlink>
  <include>minimal.xml</include>
  <enums><enum name="LIGHT"><entry name="LIGHT_ON" value="1"/></enum></enums>
  <messages>
    <message id="{id}" name="LAMP">
      <field type="uint8_t" name="state" enum="LIGHT">On or off</field>
      <field type="float" name="heat" units="degC">Of the lamp</field>
    </message>
  </messages>
</mavlink>
"""
LAMP = 60001
ATTITUDE = 30


def folded(text: bytes) -> int:
    """The checksum seed of a message made of that text, as the MAVLink guide has it."""
    crc = x25crc(text).crc
    return (crc & 0xFF) ^ (crc >> 8)


def frame(message_id: int, sequence: int, payload: bytes, seed: int) -> bytes:
    body = bytes((len(payload), 0, 0, sequence, 1, 1)) + message_id.to_bytes(3, "little") + payload
    return b"\xfd" + body + x25crc(body + bytes((seed,))).crc.to_bytes(2, "little")


def lamp_frame(message_id: int, sequence: int) -> bytes:
    return frame(message_id, sequence, struct.pack("<fB", 41.5, 1), folded(b"LAMP float heat uint8_t state "))


def write_tlog(path: Path, *frames: bytes) -> Path:
    start_us = 1_700_000_000_000_000
    path.write_bytes(b"".join(struct.pack(">Q", start_us + index) + frame for index, frame in enumerate(frames)))
    return path


@pytest.fixture
def own_xml(tmp_path: Path) -> Path:
    path = tmp_path / "lamps.xml"
    path.write_text(OWN_XML.format(id=LAMP))
    return path


def messages_of(ponte: Path, log: Path, *options: str | Path) -> list[dict]:
    done = run([ponte, "inspect", log, "--messages", *options])
    assert done.returncode == 0, done.stderr
    return [parse_json(line) for line in done.stdout.splitlines()]


def test_inspect_knows_the_messages_of_the_file_and_ours(ponte: Path, own_xml: Path, tmp_path: Path) -> None:
    link = ardupilotmega.MAVLink(None, srcSystem=1, srcComponent=1)
    attitude = bytes(ardupilotmega.MAVLink_attitude_message(5, 0.25, 0, 0, 0, 0, 0).pack(link))
    log = write_tlog(tmp_path / "log", lamp_frame(LAMP, 1), attitude)

    lamp, known = messages_of(ponte, log, "--dialect", own_xml)
    assert (lamp["name"], lamp["fields"], lamp["labels"]) == ("LAMP", {"state": 1, "heat": 41.5}, {"state": "LIGHT_ON"})
    assert (known["name"], known["fields"]["roll"]) == ("ATTITUDE", 0.25)

    unknown, _ = messages_of(ponte, log)
    assert (unknown["name"], unknown["payload"]) == (f"unknown:{LAMP}", struct.pack("<fB", 41.5, 1).hex())


def test_a_damaged_frame_of_an_own_message_is_damage(ponte: Path, own_xml: Path, tmp_path: Path) -> None:
    damaged = bytearray(lamp_frame(LAMP, 1))
    damaged[12] ^= 1
    log = write_tlog(tmp_path / "log", bytes(damaged), lamp_frame(LAMP, 2))
    (lamp,) = messages_of(ponte, log, "--dialect", own_xml)
    assert lamp["sequence"] == 2


def test_translate_does_not_take_an_own_message_for_one_it_knows(ponte: Path, own_xml: Path, tmp_path: Path) -> None:
    own_xml.write_text(OWN_XML.format(id=ATTITUDE))
    link = ardupilotmega.MAVLink(None, srcSystem=1, srcComponent=1)
    heartbeat = bytes(ardupilotmega.MAVLink_heartbeat_message(2, 3, 81, 4, 3, 3).pack(link))
    attitude = bytes(ardupilotmega.MAVLink_attitude_message(5, 0.25, 0, 0, 0, 0, 0).pack(link))

    def inertial_states(second: bytes, *options: str | Path) -> int:
        done = run([ponte, "translate", write_tlog(tmp_path / "log", heartbeat, second), "--json", *options])
        assert done.returncode == 0, done.stderr
        assert "read        2 frames of 2 message types" in done.stderr
        return [parse_json(line)["number"] for line in done.stdout.splitlines()].count(4000)

    assert inertial_states(attitude) == 1
    assert inertial_states(lamp_frame(ATTITUDE, 1), "--dialect", own_xml) == 0


def test_the_page_of_the_vsm_knows_the_messages_of_the_file(ponte: Path, own_xml: Path) -> None:
    link = ardupilotmega.MAVLink(None, srcSystem=1, srcComponent=1)
    heartbeat = bytes(ardupilotmega.MAVLink_heartbeat_message(2, 3, 81, 4, 3, 3).pack(link))
    with Server(ponte, "--dialect", str(own_xml)) as server, server.stream() as stream:
        listed = server.ask("GET", "/api/v1/catalogue").json["mavlink"]
        fields = {message["name"]: message["fields"] for message in listed["messages"]}
        assert "ATTITUDE" in fields
        assert {field["name"]: field.get("unit") for field in fields["LAMP"]} == {"heat": "degC", "state": None}
        assert listed["enums"]["LIGHT"]["labels"] == {"1": "LIGHT_ON"}
        carrier = Udp()
        assert server.ask("POST", "/api/v1/vehicle-links", {"endpoint": carrier.endpoint}).status == 201
        stream.watch("14:40:00:01", traffic=True)
        heard = None
        while heard is None:
            carrier.send(heartbeat)
            carrier.send(lamp_frame(LAMP, 1))
            rows = stream.next("traffic")["mavlink"]
            heard = next((row["last"] for row in rows if row["last"]["id"] == LAMP), None)
    assert (heard["name"], heard["fields"]) == ("LAMP", {"state": 1, "heat": 41.5})


def test_the_vsm_replays_own_messages_and_takes_none_for_one_it_knows(
    ponte: Path, own_xml: Path, tmp_path: Path
) -> None:
    own_xml.write_text(OWN_XML.format(id=ATTITUDE))
    link = ardupilotmega.MAVLink(None, srcSystem=1, srcComponent=1)
    heartbeat = bytes(ardupilotmega.MAVLink_heartbeat_message(2, 3, 81, 4, 3, 3).pack(link))
    log = write_tlog(tmp_path / "log", heartbeat, lamp_frame(ATTITUDE, 1))
    done = run([ponte, "vsm", "--vehicle", f"file://{log}?speed=0", "--json", "--dialect", own_xml])
    assert done.returncode == 0, done.stderr
    assert "2 frames" in done.stderr
    assert 4000 not in {parse_json(line)["number"] for line in done.stdout.splitlines()}
    without = run([ponte, "vsm", "--vehicle", f"file://{log}?speed=0", "--json"])
    assert "1 frames" in without.stderr  # the other has the wrong checksum for an ATTITUDE


@pytest.mark.parametrize("command", ["inspect", "translate", "vsm"])
@pytest.mark.parametrize(
    "old, by, expected",
    [
        ("uint8_t", "uint9_t", "{file}:6: type 'uint9_t' of state is not a MAVLink type"),
        ("minimal.xml", "nowhere.xml", "{file}:2: included file 'nowhere.xml' was not found"),
        ("</messages>", "", "{file}:10: not well-formed XML: "),
    ],
)
def test_bad_xml_is_refused_with_file_and_line(
    ponte: Path, own_xml: Path, command: str, old: str, by: str, expected: str
) -> None:
    own_xml.write_text(OWN_XML.format(id=LAMP).replace(old, by))
    source = ["--vehicle", "udpin://127.0.0.1:0"] if command == "vsm" else [own_xml]
    done = run([ponte, command, *source, "--dialect", own_xml])
    assert done.returncode == 1
    assert done.stderr.startswith(expected.format(file=own_xml))
    assert len(done.stderr.splitlines()) == 1


def test_a_file_that_is_not_there_is_named(ponte: Path, tmp_path: Path) -> None:
    done = run([ponte, "inspect", tmp_path, "--dialect", tmp_path / "none.xml"])
    assert (done.returncode, done.stderr) == (1, f"{tmp_path}/none.xml: cannot be read\n")
