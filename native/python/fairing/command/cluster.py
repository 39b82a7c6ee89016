"""Many files on an existing Dask cluster (optional: distributed)."""

from __future__ import annotations

import importlib
import tempfile
from argparse import Namespace
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath

from fairing.command.work import UNUSABLE, Report, done_with

Place = Path | str  # an address that fsspec knows is a string
Job = tuple[Place, Place | None]  # a file, and where its result goes
Made = dict[str, bytes]  # files by their names


def is_address(place: object) -> bool:
    return "://" in str(place)


def place(word: str) -> Place:
    return word if is_address(word) else Path(word)


def reports(jobs: Sequence[Job], given: Namespace) -> Iterator[Report]:
    """The reports, as files are done; files of a worker that dies go to another one.

    Workers read and write addresses themselves; files of this machine go to them and come back by their content.
    """
    distributed = importlib.import_module("distributed")
    with distributed.Client(given.dask) as client:
        tasks = {}
        for source, target in jobs:
            content = None if is_address(source) or not Path(source).is_file() else Path(source).read_bytes()
            tasks[client.submit(_done, (source, target), given, content, pure=False)] = source, target
        for task in distributed.as_completed(tasks):
            source, target = tasks.pop(task)
            try:
                report, made = task.result()
            except distributed.KilledWorker as error:
                report, made = _unusable(source, f"each worker that had it died: {error}", "KilledWorker"), {}
            _write(made, target)
            yield report


def _unusable(source: Place, reason: str, code: str) -> Report:
    return {"file": str(source), "verdict": UNUSABLE, "reason": reason, "code": code, "seconds": 0.0}


def _done(job: Job, given: Namespace, content: bytes | None) -> tuple[Report, Made]:
    """On a worker: the report, and what is to be written on the machine that asks."""
    source, target = job
    with tempfile.TemporaryDirectory() as folder:
        here = Path(folder, PurePosixPath(str(source)).name)
        there = None if target is None else Path(folder, "out", PurePosixPath(str(target)).name)
        try:
            if is_address(source):
                with importlib.import_module("fsspec").open(str(source), "rb") as file:
                    content = file.read()
            if content is not None:
                here.write_bytes(content)
        except (OSError, ValueError, ImportError) as error:
            return _unusable(source, f"{source}: {error}", type(error).__name__), {}
        report = done_with(here, there, given, None) | {"file": str(source)}
        made = {path.name: path.read_bytes() for path in Path(folder, "out").glob("*")}
    if "reason" in report:
        report["reason"] = report["reason"].replace(str(here), str(source))
    if "written" in report:
        report["written"] = str(target)
    if is_address(target):
        _write(made, target)
        made = {}
    return report, made


def _write(made: Made, target: Place | None) -> None:
    """All files into the folder of the target."""
    for name, content in made.items():
        if is_address(target):
            with importlib.import_module("fsspec").open(f"{str(target).rpartition('/')[0]}/{name}", "wb") as file:
                file.write(content)
        else:
            here = Path(str(target)).with_name(name)
            here.parent.mkdir(parents=True, exist_ok=True)
            here.write_bytes(content)
