"""Verdicts against what was judged by eye."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np

GRADES = ("GOOD", "LOOK", "UNUSABLE")
JUDGEMENTS = ("keep", "doubt", "undo")
JUDGED = Path(__file__).parent / "judged.txt"


def judged() -> dict[str, tuple[str, str]]:
    """Each job's judgement and what is wrong with it."""
    lines = (line for line in JUDGED.read_text().splitlines() if line and not line.startswith("#"))
    pairs = (line.split(": ", 1) for line in lines)
    return {name: ((words := text.split("; ", 1))[0], words[1] if len(words) > 1 else "") for name, text in pairs}


def text(names: list[str], results: Path) -> str:
    """A table of counts, then every job whose verdict and judgement differ, then all reasons."""
    counts: Counter[tuple[str, str]] = Counter()
    apart, reasons = [], []
    for name, (judgement, wrong) in judged().items():
        path = results / f"{name}.npz"
        if name not in names or not path.exists():
            continue
        with np.load(path) as data:
            grade, reason = str(data["verdict"]), str(data["reason"])
        counts[grade, judgement] += 1
        line = f"{name:20} {grade:9} {judgement:6} {wrong} | {reason}"
        (apart if (grade == "GOOD") != (judgement == "keep") else reasons).append(line)
    rows = [f"| {grade} | " + " | ".join(str(counts[grade, each]) for each in JUDGEMENTS) + " |" for grade in GRADES]
    head = f"| | {' | '.join(JUDGEMENTS)} |\n| --- | --: | --: | --: |"
    return "\n".join(
        [
            head,
            *rows,
            "",
            "Apart:",
            *apart,
            "",
            "Alike:",
            *(line for line in reasons if "|  " not in line and not line.endswith("| ")),
        ]
    )
