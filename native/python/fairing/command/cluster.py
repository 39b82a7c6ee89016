"""Many files on an existing Dask cluster (optional: distributed)."""

from __future__ import annotations

import importlib
import os
import tempfile
import uuid
from argparse import Namespace
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from fairing.command.verdict import UNUSABLE
from fairing.command.work import Report, done_with

Place = Path | str  # an address that fsspec knows is a string
Job = tuple[Place, Place | None]  # a file, and where its result goes
Made = dict[str, bytes]  # files by their names


def is_address(place: object) -> bool:
    return "://" in str(place)


def reports(jobs: Sequence[Job], given: Namespace) -> Iterator[Report]:
    """The reports, as files are done; files of a worker that dies go to another one."""
    distributed = importlib.import_module("distributed")
    with distributed.Client(given.dask) as client:
        shared = all(_is_shared(client, folder) for folder in _folders(jobs))
        tasks = {}
        for job in jobs:
            known = shared or is_address(job[0]) or not Path(job[0]).is_file()
            content = None if known else Path(job[0]).read_bytes()
            tasks[client.submit(_done, job, given, shared, content, pure=False)] = job
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


def _folders(jobs: Sequence[Job]) -> set[Path]:
    """Those of this machine that workers have to see."""
    places = [place for job in jobs for place in job if place is not None and not is_address(place)]
    return {folder for place in places if (folder := Path(place).resolve().parent).is_dir()}


def _is_shared(client: Any, folder: Path) -> bool:
    """Whether all workers see what is written here."""
    name = folder / f".{uuid.uuid4().hex}"
    name.touch()
    try:
        return all(client.run(os.path.exists, str(name)).values())
    finally:
        name.unlink()


def _done(job: Job, given: Namespace, shared: bool, content: bytes | None) -> tuple[Report, Made]:
    """On a worker: the report and, where it shares no files, what is to be written."""
    source, target = job
    with tempfile.TemporaryDirectory() as folder:
        here, there = Path(source).resolve(), None if target is None else Path(target).resolve()
        if not shared or is_address(source):
            here = Path(folder, PurePosixPath(str(source)).name)
            try:
                here.write_bytes(_read(str(source)) if content is None else content)
            except (OSError, ValueError, ImportError) as error:
                return _unusable(source, f"{source}: {error}", type(error).__name__), {}
        if there is not None and (not shared or is_address(target)):
            there = Path(folder, "out", there.name)
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


def _read(address: str) -> bytes:
    with importlib.import_module("fsspec").open(address, "rb") as file:
        return bytes(file.read())


def _write(made: Made, target: Place | None) -> None:
    """All files into the folder of the target."""
    for name, content in made.items():
        if is_address(target):
            with importlib.import_module("fsspec").open(f"{str(target).rpartition('/')[0]}/{name}", "wb") as file:
                file.write(content)
        else:
            place = Path(str(target)).with_name(name)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
