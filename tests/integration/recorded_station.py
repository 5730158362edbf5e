"""Plays the ground station of a recorded dialogue once more, before `ponte sim`."""

from __future__ import annotations

import socket
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import conduct
import mavlink_frames
import tlog
from mavlink_frames import Frame
from programs import HANG_LIMIT_S

# Seconds of the vehicle's time: for each answer, and until it is armed or disarmed as it was, once in vain.
ANSWER_PATIENCE = 5
STATE_PATIENCE = 150


class Cue(NamedTuple):
    """A frame of the station, and what it waited for since its last one."""

    frame: Frame
    seconds: int
    answers: int
    armed: bool | None  # what the vehicle became meanwhile


def is_armed(heartbeat: Frame) -> bool:
    return bool(mavlink_frames.decode(heartbeat).base_mode & conduct.ARMED)


class Waiting:
    """What has come from the vehicle since the station spoke."""

    def __init__(self) -> None:
        self.seconds = self.answers = 0
        self.armed = self.armed_before = False
        self.patience = STATE_PATIENCE

    def hear(self, frame: Frame) -> None:
        if conduct.is_heartbeat(frame):
            self.seconds += 1
            self.armed = is_armed(frame)
        self.answers += conduct.is_answer(frame)

    def is_over(self, cue: Cue) -> bool:
        late = self.seconds - cue.seconds
        if late < 0 or (self.answers < cue.answers and late < ANSWER_PATIENCE):
            return False
        return cue.armed in (None, self.armed) or late >= self.patience

    def speak(self, cue: Cue) -> None:
        if cue.armed not in (None, self.armed):
            self.patience = 0
        self.seconds = self.answers = 0
        self.armed_before = self.armed


def cues(dialogue: Sequence[Frame]) -> Iterator[Cue]:
    waiting = Waiting()
    for frame in dialogue:
        if frame.system == conduct.VEHICLE:
            waiting.hear(frame)
            continue
        became = waiting.armed if waiting.armed != waiting.armed_before else None
        cue = Cue(frame, waiting.seconds, waiting.answers, became)
        waiting.speak(cue)
        yield cue


def frames_from(link: socket.socket) -> Iterator[Frame]:
    buffered = b""
    while True:
        received = link.recv(65536)
        assert received, "the vehicle has gone"
        buffered += received
        while len(buffered) >= 3 and len(buffered) >= (size := tlog.frame_size(buffered)):
            yield mavlink_frames.parse(buffered[:size])
            buffered = buffered[size:]


def play(dialogue: Sequence[Frame], start_ponte: Callable[..., None], *options: str) -> list[Frame]:
    """The dialogue that comes of it, as long as the recorded one. A stream, since no frame of it may be lost."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(HANG_LIMIT_S)
        start_ponte("sim", "--endpoint", f"tcpout://127.0.0.1:{server.getsockname()[1]}", "--quiet", *options)
        link, _ = server.accept()
    played: list[Frame] = []
    waiting = Waiting()
    with link:
        link.settimeout(HANG_LIMIT_S)
        heard = frames_from(link)
        for cue in cues(dialogue):
            while not waiting.is_over(cue):
                played.append(next(heard))
                waiting.hear(played[-1])
            link.sendall(cue.frame.whole)
            played.append(cue.frame)
            waiting.speak(cue)
        left = sum(map(conduct.is_heartbeat, dialogue)) - sum(map(conduct.is_heartbeat, played))
        while waiting.seconds < max(left, ANSWER_PATIENCE):
            played.append(next(heard))
            waiting.hear(played[-1])
    return played
