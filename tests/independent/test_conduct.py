"""Two dialogues differ in what was answered, lived through and sent, and in nothing else."""

from __future__ import annotations

import conduct
import mavlink_frames
from mavlink_frames import Frame, dialect

VEHICLE = dialect.MAVLink(None, srcSystem=1, srcComponent=1)
STATION = dialect.MAVLink(None, srcSystem=255, srcComponent=190)


def heartbeat(status: int = 3, armed: bool = False) -> Frame:
    message = dialect.MAVLink_heartbeat_message(2, 3, 81 | 128 * armed, 0, status, 3)
    return mavlink_frames.parse(bytes(message.pack(VEHICLE)))


def command(number: int) -> Frame:
    message = dialect.MAVLink_command_long_message(1, 1, number, 0, 0, 0, 0, 0, 0, 0, 0)
    return mavlink_frames.parse(bytes(message.pack(STATION)))


def acknowledgement(number: int, result: int, system: int = 255) -> Frame:
    message = dialect.MAVLink_command_ack_message(number, result, 0, 0, system, 190)
    return mavlink_frames.parse(bytes(message.pack(VEHICLE)))


def differences(recorded: list[Frame], simulated: list[Frame]) -> list[conduct.Difference]:
    return list(conduct.compare(conduct.conduct_of(recorded), conduct.conduct_of(simulated)))


def test_the_same_conduct_has_no_differences_however_long_it_lasts() -> None:
    exchange = [heartbeat(), command(400), acknowledgement(400, 0)]
    assert differences(exchange, [heartbeat(), *exchange, heartbeat()]) == []


def test_another_answer_is_a_difference() -> None:
    asked = [heartbeat(), command(400)]
    (difference,) = differences([*asked, acknowledgement(400, 4)], [*asked, acknowledgement(400, 1)])
    assert difference == (
        "COMMAND_LONG 400(0, 0, 0, 0, 0, 0, 0)",
        "COMMAND_ACK 400 FAILED",
        "COMMAND_ACK 400 TEMPORARILY_REJECTED",
    )


def test_an_answer_to_nobody_is_none() -> None:
    asked = [heartbeat(), command(400), acknowledgement(400, 0)]
    assert differences([*asked, acknowledgement(211, 0, system=0)], asked) == []


def test_another_life_is_a_difference() -> None:
    names = [each[0] for each in differences([heartbeat(), heartbeat(4, armed=True)], [heartbeat()])]
    assert names == ["system_status", "armed"]


def test_a_message_of_one_only_is_a_difference() -> None:
    attitude = mavlink_frames.parse(bytes(dialect.MAVLink_attitude_message(0, 0, 0, 0, 0, 0, 0).pack(VEHICLE)))
    assert differences([heartbeat(), attitude], [heartbeat()]) == [("messages of one only", "ATTITUDE", "nothing")]
    assert conduct.rates_between([heartbeat(), attitude, attitude, heartbeat()], 1, 2) == {"ATTITUDE": 2, "HEARTBEAT": 1}


def test_a_rate_differs_by_more_than_a_tenth_and_more_than_a_message() -> None:
    recorded, simulated = {"ATTITUDE": 10.0, "PING": 0.1}, {"ATTITUDE": 10.5, "PING": 0.0}
    types = set(recorded)
    assert list(conduct.compare_rates(recorded, simulated, 10, types)) == []
    simulated["ATTITUDE"] = 12.0
    assert list(conduct.compare_rates(recorded, simulated, 10, types)) == [("ATTITUDE a second", "10", "12")]
