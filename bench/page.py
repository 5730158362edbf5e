"""The bridge page under load: 50 clients and a page in Chromium watch 20 vehicles.

Once both are warm, the memory of the server and of the page must not grow for five minutes, and nobody may miss an event.
"""

from __future__ import annotations

import asyncio
import json
import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from figure import Figure
from page_load import Client, Fleet

VEHICLES = 20
CLIENTS = 50
SECONDS = 300.0
# Until the longest of the histories that server and page keep is full: the plot's 3000 points, of which 10 Hz come.
WARM_UP_SECONDS = 310.0
GROWTH_MAX = 1.05
MIB = 1 << 20

REPOSITORY = Path(__file__).parents[1]


def server_memory(process: int) -> float:
    """Resident, in MiB."""
    status = Path(f"/proc/{process}/status").read_text()
    return int(re.findall(r"^VmRSS:\s+(\d+) kB", status, re.MULTILINE)[0]) / 1024


def cpu_seconds(process: int) -> float:
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Browser:
    """A page that goes round its views; see web/bridge/test/heap.mjs."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self.process = process

    @classmethod
    async def open(cls, address: str) -> Browser:
        node, script = Path(sys.executable).with_name("node"), REPOSITORY / "web/bridge/test/heap.mjs"
        pipe = asyncio.subprocess.PIPE
        return cls(await asyncio.create_subprocess_exec(node, script, address, stdin=pipe, stdout=pipe))

    async def heap(self) -> float:
        """What the page's script holds after a garbage collection, in MiB."""
        assert self.process.stdin is not None and self.process.stdout is not None
        self.process.stdin.write(b"heap\n")
        answer = await self.process.stdout.readline()
        if not answer:
            raise RuntimeError("the page in Chromium has ended")
        return float(json.loads(answer)["bytes"]) / MIB

    async def close(self) -> None:
        assert self.process.stdin is not None
        self.process.stdin.close()
        await self.process.wait()


class Load:
    """Vehicles and clients on a running server."""

    def __init__(self, server: subprocess.Popen[str], page: str, place: tuple[str, int]) -> None:
        self.server, self.page = server, page
        self.fleet, self.clients = Fleet(VEHICLES, place), [Client() for _ in range(CLIENTS)]

    async def figures(self) -> list[Figure]:
        tasks = [asyncio.create_task(self.fleet.fly())]
        await asyncio.sleep(2)  # the vehicles are known
        stream = self.page.replace("http", "ws", 1) + "api/v1/stream"
        for index, client in enumerate(self.clients):
            vehicle = f"14:40:00:{1 + index % VEHICLES:02X}"
            tasks.append(asyncio.create_task(client.watch(stream, vehicle)))
        browser = await Browser.open(self.page)
        await asyncio.sleep(WARM_UP_SECONDS)
        heap, memory, before = await browser.heap(), server_memory(self.server.pid), self.progress()
        await asyncio.sleep(SECONDS)
        if ended := [task for task in tasks if task.done()]:
            raise RuntimeError(f"{len(ended)} of the clients were cut off: {ended[0]}")
        took, frames, messages, size, cpu = (b - a for a, b in zip(before, self.progress()))
        memory_end, heap_end = server_memory(self.server.pid), await browser.heap()
        for task in tasks:
            task.cancel()
        await browser.close()
        events, missed = min(c.events for c in self.clients), sum(c.missed_events for c in self.clients)
        dropped = sum(c.dropped for c in self.clients)
        return [
            Figure("page", "MAVLink frames in", frames / took, "frames/s"),
            Figure("page", "messages to clients", messages / took, "1/s"),
            Figure("page", "bytes to clients", size / took / 1e6, "MB/s"),
            Figure("page", "server's processor", cpu / took * 100, "% of one"),
            Figure("page", "server's memory", memory_end, "MiB", "when warm", memory, GROWTH_MAX, of_ratio=True),
            Figure("page", "page's heap", heap_end, "MiB", "when warm", heap, GROWTH_MAX, of_ratio=True),
            Figure("page", "telemetry dropped", dropped, "messages"),
            Figure("page", "events to each client", events, "events", target=1, at_least=True),
            Figure("page", "events missed", missed, "events", target=0),
        ]

    def progress(self) -> tuple[float, float, float, float, float]:
        """Time, MAVLink frames, messages and bytes to the clients, processor time of the server."""
        messages, size = sum(c.messages for c in self.clients), sum(c.bytes for c in self.clients)
        return time.monotonic(), self.fleet.frames, messages, size, cpu_seconds(self.server.pid)


def figures(programs: Path) -> Iterator[Figure]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        place = probe.getsockname()
    links = ["--vehicle", f"udpin://{place[0]}:{place[1]}", "--listen-only"]
    http = ["--http", "127.0.0.1:0", "--web-root", REPOSITORY / "build/web/bridge"]
    command = [programs / "ponte", "vsm", *links, *http]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as server:
        assert server.stderr is not None
        try:
            page = next(found[1] for line in server.stderr if (found := re.search(r"page is at (\S+)", line)))
            yield from asyncio.run(Load(server, page, place).figures())
        finally:
            server.terminate()
