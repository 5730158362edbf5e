"""One figure of a benchmark, with its peer and its target."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass


@dataclass
class Figure:
    """One line of the result. `target` is the largest value that passes, or the least; of the ratio if `of_ratio`."""

    bench: str
    case: str
    value: float
    unit: str
    peer: str | None = None
    peer_value: float | None = None
    target: float | None = None
    at_least: bool = False
    of_ratio: bool = False

    @property
    def ratio(self) -> float | None:
        return self.value / self.peer_value if self.peer_value else None

    @property
    def passed(self) -> bool | None:
        judged = self.ratio if self.of_ratio else self.value
        if self.target is None or judged is None:
            return None
        return judged >= self.target if self.at_least else judged <= self.target

    def as_json(self) -> str:
        line = asdict(self) | {"ratio": self.ratio, "pass": self.passed}
        del line["at_least"], line["of_ratio"]
        return json.dumps(line)

    def as_row(self) -> str:
        def number(value: float | None, form: str) -> str:
            return "-" if value is None else format(value, form)

        verdict = {None: "", True: "pass", False: "MISSED"}[self.passed]
        return (
            f"{self.bench:8} {self.case:36} {self.value:12.5g} {self.unit:9} {self.peer or '-':18} "
            f"{number(self.peer_value, '12.5g'):>12} {number(self.ratio, '8.2f'):>8} "
            f"{number(self.target, '8.2f'):>9} {verdict}"
        )


HEADING = (
    f"{'bench':8} {'case':36} {'value':>12} {'unit':9} {'peer':18} {'peer value':>12} {'ratio':>8} {'target':>9}"
)
