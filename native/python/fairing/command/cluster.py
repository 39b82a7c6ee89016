"""Many files on an existing Dask cluster (optional: distributed), by their content or by addresses of fsspec."""

from __future__ import annotations

import importlib
import tempfile
from argparse import Namespace
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path, PurePosixPath
from typing import Any

from fairing.command.work import UNUSABLE, Report, done_with

Job = tuple[str, str | None]  # a file or an address, and where its result goes


def _open(place: str, mode: str) -> Any:
    return importlib.import_module("fsspec").open(place, mode, auto_mkdir=True)


def reports(jobs: Sequence[Job], given: Namespace) -> Iterator[Report]:
    """The reports, as files are done; files of a worker that dies go to another one.

    Workers read and write addresses themselves; files of this machine go to them and come back by their content.
    """
    distributed = importlib.import_module("distributed")
    with distributed.Client(given.dask) as client:
        tasks = {}
        for source, target in jobs:
            content = Path(source).read_bytes() if Path(source).is_file() else None
            tasks[client.submit(_done, (source, target), given, content, pure=False)] = source, target
        for task in distributed.as_completed(tasks):
            source, target = tasks.pop(task)
            try:
                report, made = task.result()
            except distributed.KilledWorker as error:
                reason, code = f"{source}: each worker that had it died: {error}", "KilledWorker"
                report = {"file": source, "verdict": UNUSABLE, "reason": reason, "code": code, "seconds": 0.0}
                made = None
            if made is not None and target is not None:
                _write(target, made)
            yield report


def _done(job: Job, given: Namespace, content: bytes | None) -> tuple[Report, bytes | None]:
    """On a worker: the report, and what is to be written on the machine that asks."""
    source, target = job
    with tempfile.TemporaryDirectory() as folder:
        here = Path(folder, PurePosixPath(source).name)
        there = None if target is None else Path(folder, "out", PurePosixPath(target).name)
        with suppress(OSError, ValueError, ImportError):  # what can't be had is no file: the report says so
            if content is None:
                with _open(source, "rb") as file:
                    content = file.read()
            here.write_bytes(content)
        report = done_with(here, there, given, None) | {"file": source}
        made = there.read_bytes() if there is not None and there.is_file() else None
    said = {"reason": report["reason"].replace(str(here), source)} if "reason" in report else {}
    report |= said | ({"written": target} if "written" in report else {})
    if made is not None and target is not None and "://" in target:
        _write(target, made)
        made = None
    return report, made


def _write(target: str, made: bytes) -> None:
    with _open(target, "wb") as file:
        file.write(made)
