"""What loads the bridge page's server: vehicles that fly circles, and clients that watch them."""

from __future__ import annotations

import asyncio
import json
import socket
import time
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as dialect
from websockets.asyncio.client import connect

TICK_S = 0.1
EVENT_EVERY_TICKS = 50


class Fleet:
    """Vehicles with the system ids from 1, all on one UDP socket. Every five seconds each says a text: an event."""

    def __init__(self, vehicles: int, place: tuple[str, int]) -> None:
        self.links = [dialect.MAVLink(None, srcSystem=1 + index, srcComponent=1) for index in range(vehicles)]
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.place = place
        self.frames = 0
        self.ticks = 0

    async def fly(self) -> None:
        next_tick = time.monotonic()
        while True:
            self.tick()
            next_tick += TICK_S
            await asyncio.sleep(max(0.0, next_tick - time.monotonic()))

    def tick(self) -> None:
        """What each vehicle says in 100 ms: attitude at 10 Hz, position at 5 Hz, the rest more seldom."""
        for number, link in enumerate(self.links):
            for period, message in self.messages():
                if self.ticks % period == 0:
                    self.say(link, message)
            if self.ticks % EVENT_EVERY_TICKS == number % EVENT_EVERY_TICKS:
                self.say(link, dialect.MAVLink_statustext_message(6, f"lap {self.ticks}".encode()))
        self.ticks += 1

    def messages(self) -> list[tuple[int, dialect.MAVLink_message]]:
        """Each with its period in ticks."""
        ms, lap = self.ticks * 100, self.ticks / 100
        position = (387_000_000 + self.ticks, -91_000_000, 120_000 + self.ticks, 20_000, 100, 0, 0, 9000)
        return [
            (1, dialect.MAVLink_attitude_message(ms, 0.1 + lap % 1, -0.1, lap % 3, 0.0, 0.0, 0.1)),
            (2, dialect.MAVLink_global_position_int_message(ms, *position)),
            (3, dialect.MAVLink_vfr_hud_message(12.0, 11.0 + lap % 1, 90, 50, 120.0, 0.5)),
            (5, dialect.MAVLink_battery_status_message(0, 0, 0, 2500, [4000] * 10, 1200, 100, -1, 80)),
            (10, dialect.MAVLink_heartbeat_message(2, 3, 81, 0, 3, 3)),
        ]

    def say(self, link: dialect.MAVLink, message: dialect.MAVLink_message) -> None:
        self.socket.sendto(message.pack(link), self.place)
        link.seq = (link.seq + 1) % 256
        self.frames += 1


@dataclass
class Client:
    """Watches one vehicle and the inspector's table; counts what it is told."""

    messages: int = 0
    bytes: int = 0
    dropped: int = 0
    events: int = 0
    last_event: int = 0
    missed_events: int = 0

    async def watch(self, url: str, vehicle: str) -> None:
        async with connect(url, compression=None, max_size=None, proxy=None) as stream:
            await stream.send(json.dumps({"kind": "watch", "vehicle": vehicle, "traffic": True}))
            async for text in stream:
                self.take(str(text))

    def take(self, text: str) -> None:
        self.messages += 1
        self.bytes += len(text)
        if text.startswith('{"kind":"events"'):
            for event in json.loads(text)["events"]:
                self.missed_events += event["number"] - self.last_event - 1 if self.last_event else 0
                self.last_event = event["number"]
                self.events += 1
        elif text.startswith('{"kind":"dropped"'):
            self.dropped = json.loads(text)["count"]
