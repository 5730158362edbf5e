"""A ground station made of pymavlink, before one `ponte sim`."""

from __future__ import annotations

import os
import random
import time
from collections.abc import Callable
from typing import Any

os.environ["MAVLINK20"] = "1"
from programs import HANG_LIMIT_S
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

SYSTEM = COMPONENT = 1


class Station:
    """Starts the vehicle and hears it first. `loss` of the frames is lost on each way, by the seed. With a key it
    signs what it sends, and takes nothing else."""

    patience_s = 0.03  # for an answer that may have been lost

    def __init__(
        self, start_ponte: Callable[..., None], *options: str, loss: float = 0, seed: int = 0, v1: bool = False, key: bytes = b""
    ) -> None:
        self.link = mavutil.mavlink_connection("udpin:127.0.0.1:0", source_system=255, source_component=190)
        port = self.link.port.getsockname()[1]
        start_ponte("sim", "--endpoint", f"udpout://127.0.0.1:{port}", "--quiet", *options)
        self.link.wait_heartbeat(timeout=HANG_LIMIT_S)
        if key:  # only now, since the first frame may make pymavlink begin anew, without the key
            self.link.setup_signing(key, sign_outgoing=True)
        self.loss, self.random, self.v1 = loss, random.Random(seed), v1

    def send(self, message: Any) -> None:
        if self.random.random() >= self.loss:
            self.link.mav.send(message, force_mavlink1=self.v1)

    def next(self, *names: str, patience_s: float = HANG_LIMIT_S) -> Any:
        """The next message of one of these types that is not lost; None if none comes."""
        end = time.monotonic() + patience_s
        while (left := end - time.monotonic()) > 0:
            message = self.link.recv_match(type=list(names), blocking=True, timeout=left)
            if message is not None and self.random.random() >= self.loss:
                return message
        return None

    def command(self, number: int, *parameters: float) -> int:
        values = [*parameters, *[0.0] * (7 - len(parameters))]
        self.send(mavlink.MAVLink_command_long_message(SYSTEM, COMPONENT, number, 0, *values))
        while True:
            answer = self.next("COMMAND_ACK")
            assert answer is not None, f"command {number} was not answered"
            if answer.command == number and answer.result != mavlink.MAV_RESULT_IN_PROGRESS:
                return int(answer.result)

    def silence_telemetry(self) -> None:
        """Of PX4: what it sends 50 times a second is not to take this program's time."""
        for number in (30, 31, 83, 33, 32, 85, 36):
            for _ in range(5):  # some of them are lost
                self.send(
                    mavlink.MAVLink_command_long_message(
                        SYSTEM, COMPONENT, mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, 0, number, -1, 0, 0, 0, 0, 0
                    )
                )

    def until_position(self) -> None:
        """The vehicle tells its home only when it knows where it is."""
        while self.command(mavlink.MAV_CMD_GET_HOME_POSITION) != mavlink.MAV_RESULT_ACCEPTED:
            time.sleep(0.05)

    def upload(self, items: list[Any], kind: int = 0) -> None:
        """Answers each request, and says again what was not answered. Refused, it begins anew, unless it was about the
        last item: then that is on board, and only the acknowledgement was lost."""
        count = mavlink.MAVLink_mission_count_message(SYSTEM, COMPONENT, len(items), kind)
        last = count
        self.send(count)
        while True:
            answer = self.next("MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK", patience_s=self.patience_s)
            if answer is not None and answer.get_type() == "MISSION_ACK":
                if answer.type == mavlink.MAV_MISSION_ACCEPTED or last is items[-1]:
                    return
                if answer.type == mavlink.MAV_MISSION_INVALID_SEQUENCE:
                    continue
                last = count
            elif answer is not None:
                last = items[answer.seq]
            self.send(last)

    def download(self, kind: int = 0) -> list[Any]:
        count = None
        while count is None:
            self.send(mavlink.MAVLink_mission_request_list_message(SYSTEM, COMPONENT, kind))
            count = self.next("MISSION_COUNT", patience_s=self.patience_s)
        items: list[Any] = []
        while len(items) < count.count:
            self.send(mavlink.MAVLink_mission_request_int_message(SYSTEM, COMPONENT, len(items), kind))
            item = self.next("MISSION_ITEM_INT", patience_s=self.patience_s)
            if item is not None and item.seq == len(items):
                items.append(item)
        self.send(mavlink.MAVLink_mission_ack_message(SYSTEM, COMPONENT, mavlink.MAV_MISSION_ACCEPTED, kind))
        return items


def waypoint(index: int, command: int = mavlink.MAV_CMD_NAV_WAYPOINT, height: float = 40) -> Any:
    """Item `index` of a mission: each at another place, 40 m above home."""
    x, y = -300_689_800 + 137 * index, -511_217_900 - 251 * index
    frame = mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT
    return mavlink.MAVLink_mission_item_int_message(
        SYSTEM, COMPONENT, index, frame, command, 0, 1, 0, 0, 0, 0, x, y, height, 0
    )
