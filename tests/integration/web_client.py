"""A client of the bridge page's server, which checks everything that it gets against the contract."""

from __future__ import annotations

import asyncio
import gzip
import http.client
import json
import os
import re
import ssl
import subprocess
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple

import yaml
from jsonschema import Draft202012Validator
from referencing import Registry
from referencing.jsonschema import DRAFT202012
from websockets.asyncio.client import connect as connect_on_one_thread
from websockets.sync.client import connect

from programs import REPOSITORY, parse_json

PATIENCE_S = 60.0
CONTRACT = REPOSITORY / "web" / "contract"
OPENAPI = yaml.safe_load((CONTRACT / "openapi.yaml").read_text(encoding="utf-8"))
MESSAGES = json.loads((CONTRACT / "messages.schema.json").read_text(encoding="utf-8"))

# Names that references of one file to the other resolve with.
OPENAPI_URI = "file:///contract/openapi.yaml"
MESSAGES_URI = "file:///contract/messages.schema.json"
_messages = {key: value for key, value in MESSAGES.items() if key != "$id"}
REGISTRY = Registry().with_resources(
    [
        (OPENAPI_URI, DRAFT202012.create_resource(OPENAPI)),
        (MESSAGES_URI, DRAFT202012.create_resource(_messages)),
    ]
)


def validator(uri: str, pointer: str) -> Draft202012Validator:
    return Draft202012Validator({"$ref": f"{uri}#{pointer}"}, registry=REGISTRY)


FROM_SERVER = {
    reference["$ref"].rsplit("/", 1)[1].lower(): validator(MESSAGES_URI, reference["$ref"][1:])
    for reference in MESSAGES["$defs"]["FromServer"]["oneOf"]
}


def checked(text: str) -> Any:
    """A message of the server that keeps to the contract."""
    message = parse_json(text)
    FROM_SERVER[message["kind"]].validate(message)
    return message


class Answer(NamedTuple):
    status: int
    headers: dict[str, str]  # names in lower case
    body: bytes

    @property
    def content(self) -> bytes:
        """The body, unpacked."""
        return gzip.decompress(self.body) if self.headers.get("content-encoding") == "gzip" else self.body

    @property
    def json(self) -> Any:
        return parse_json(self.content.decode())


# What any request may be answered, by the description at the head of the contract.
LIMITS = {"405", "413", "431", "503"}


def check_answer(method: str, target: str, answer: Answer) -> None:
    """The answer is one that the contract has for this path and method."""
    path = target.split("?")[0]
    for template, operations in OPENAPI["paths"].items():
        if re.fullmatch(re.sub(r"\{\w+\}", "[^/]+", template), path) and method.lower() in operations:
            operation, name = operations[method.lower()], template.replace("~", "~0").replace("/", "~1")
            break
    else:
        return
    status = str(answer.status)
    if status in LIMITS or (status == "403" and answer.json["code"].startswith("foreign_")):
        validator(OPENAPI_URI, "/components/schemas/Problem").validate(answer.json)
        return
    assert status in operation["responses"], f"{method} {target}: {status} is not in the contract"
    response = operation["responses"][status]
    if "$ref" in response:
        validator(OPENAPI_URI, "/components/schemas/Problem").validate(answer.json)
        return
    if "content" not in response:
        assert answer.body == b""
        return
    kind = answer.headers["content-type"].split(";")[0]
    assert kind in response["content"], f"{method} {target}: {kind} is not in the contract"
    if kind == "application/json":
        where = f"/paths/{name}/{method.lower()}/responses/{status}/content/application~1json/schema"
        validator(OPENAPI_URI, where).validate(answer.json)


def untrusting_context() -> ssl.SSLContext:
    """Takes any certificate: that of the test is signed by nobody."""
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    return context


class Server:
    """`ponte vsm --http` on a port of the kernel's choice."""

    def __init__(self, ponte: Path, *options: str, environment: dict[str, str] | None = None, port: int = 0,
                 host: str = "127.0.0.1", quiet: bool = False) -> None:
        command = [str(ponte), "vsm", "--http", f"{host}:{port}", "--listen-only", *options]
        self.process = subprocess.Popen(
            command + (["--quiet"] if quiet else []), stderr=subprocess.PIPE, text=True,
            env=os.environ | (environment or {}),
        )
        self.said: list[str] = []
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.said.append(line)
            if found := re.search(r"page is at (https?)://([^/]+):(\d+)/(?:#token=(\w+))?", line):
                break
        else:
            raise AssertionError(f"the server has not started: {self.said}")
        self.scheme, self.host, self.token = found[1], host, found[4]
        self.port = int(found[3])
        self.cookie: str | None = None

    def __enter__(self) -> Server:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.process.terminate()
        status = self.process.wait(PATIENCE_S)
        assert self.process.stderr is not None
        rest = self.process.stderr.read()
        self.process.stderr.close()
        if error is None:
            assert status == 0, "".join(self.said) + rest

    def connection(self) -> http.client.HTTPConnection:
        if self.scheme == "http":
            return http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        return http.client.HTTPSConnection("127.0.0.1", self.port, timeout=PATIENCE_S, context=untrusting_context())

    def ask(self, method: str, target: str, body: Any = None, headers: dict[str, str] | None = None) -> Answer:
        """One request; the answer is checked against the contract."""
        connection = self.connection()
        fields = dict(headers or {})
        if self.cookie is not None:
            fields.setdefault("Cookie", self.cookie)
        text = body if body is None or isinstance(body, (str, bytes)) else json.dumps(body)
        connection.request(method, target, text, fields)
        response = connection.getresponse()
        answer = Answer(response.status, {k.lower(): v for k, v in response.getheaders()}, response.read())
        connection.close()
        check_answer(method, target, answer)
        return answer

    def sign_in(self, token: str) -> Answer:
        answer = self.ask("POST", "/api/v1/session", {"token": token})
        if answer.status == 200:
            self.cookie = answer.headers["set-cookie"].split(";")[0]
        return answer

    def stream(self, **headers: str) -> Stream:
        if self.cookie is not None:
            headers.setdefault("Cookie", self.cookie)
        origin = headers.pop("Origin", None)
        opening = connect(f"ws://127.0.0.1:{self.port}/api/v1/stream", additional_headers=headers, origin=origin,
                          compression=None, open_timeout=PATIENCE_S, max_size=None, proxy=None)
        return Stream(opening)

    def encrypted_greeting(self) -> Any:
        """The first message of an encrypted WebSocket.

        The client of `stream` reads on a thread of its own. Python 3.11 does not keep reading and writing of one
        encrypted connection apart, and in one of a thousand handshakes the request was never sent.
        """
        uri = f"wss://127.0.0.1:{self.port}/api/v1/stream"

        async def greeting() -> str:
            async with connect_on_one_thread(uri, additional_headers={"Cookie": self.cookie}, compression=None,
                                             ssl=untrusting_context(), open_timeout=PATIENCE_S, proxy=None) as socket:
                return str(await asyncio.wait_for(socket.recv(), PATIENCE_S))

        return checked(asyncio.run(greeting()))


class Stream:
    """The WebSocket; every message of the server is checked against the contract."""

    def __init__(self, opening: Any) -> None:
        self.opening = opening
        self.socket = opening.__enter__()

    def __enter__(self) -> Stream:
        return self

    def __exit__(self, *error: Any) -> None:
        self.opening.__exit__(*error)

    def next(self, *kinds: str) -> Any:
        """The next message of these kinds, or of any."""
        while True:
            message = checked(str(self.socket.recv(PATIENCE_S)))
            if not kinds or message["kind"] in kinds:
                return message

    def watch(self, vehicle: str | None, traffic: bool = False) -> None:
        self.socket.send(json.dumps({"kind": "watch", "vehicle": vehicle, "traffic": traffic}))
