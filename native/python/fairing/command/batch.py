"""Many files: one after the other, or several at once; what is printed, and the exit status."""

from __future__ import annotations

import json
import logging
import multiprocessing
import signal
import sys
from argparse import Namespace
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from fairing.command import cluster
from fairing.command.arguments import parsed, target_of
from fairing.command.verdict import GOOD, LOOK, UNUSABLE
from fairing.command.work import Report, done_with

_STATUS = {GOOD: 0, LOOK: 1, UNUSABLE: 3}
_WIDTH = 30  # of the bar


def main(words: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    given = parsed(words)
    logging.basicConfig(level=logging.INFO if given.verbose else logging.ERROR, format="%(message)s")
    reports = []
    try:
        for report in _done(given):
            reports.append(report)
            _print(report, given)
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    except OSError as error:  # of a cluster that does not answer
        print(error, file=sys.stderr)
        return 2
    finally:  # what is done is done, interrupted or not
        _write_json(reports, given)
    return max(_STATUS[report["verdict"]] for report in reports)


def _done(given: Namespace) -> Iterator[Report]:
    """The reports, as files are done."""
    if given.dask or given.jobs > 1:
        yield from _several_at_once(given)
    else:
        for number, source in enumerate(given.files):
            bar = _Bar(number, len(given.files), source.name, _shows(given))
            yield done_with(source, target_of(source, given), given, bar)
            bar.end()


def _several_at_once(given: Namespace) -> Iterator[Report]:
    """The same in processes that go from file to file, here or on a cluster."""
    if getattr(given, "threads", 1) is None:
        given.threads = 1
    each = Namespace(**{**vars(given), "files": ()})  # goes along with every file: without the list of all
    jobs = [(source, target_of(source, given)) for source in given.files]
    found = cluster.reports(jobs, each) if given.dask else _in_processes(jobs, each)
    for number, report in enumerate(found):
        bar = _Bar(number, len(jobs), f"{number + 1} of {len(jobs)}", _shows(given))
        bar(1.0, "")
        bar.end()
        yield report


def _in_processes(jobs: list[cluster.Job], given: Namespace) -> Iterator[Report]:
    # Spawned: a forked engine would miss its threads.
    with ProcessPoolExecutor(given.jobs, multiprocessing.get_context("spawn"), _leave_interrupts) as pool:
        tasks = [pool.submit(done_with, source, target, given, None) for source, target in jobs]
        try:
            for task in as_completed(tasks):
                yield task.result()
        finally:  # of an interrupt: files that are being worked on get done, no other begins
            pool.shutdown(cancel_futures=True)


def _leave_interrupts() -> None:
    """A process that is interrupted itself would take the others along."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


class _Bar:
    """A line on the terminal that goes with the engine's progress."""

    def __init__(self, number: int, count: int, name: str, shown: bool) -> None:
        self._number, self._count, self._name, self._shown = number, count, name, shown

    def __call__(self, fraction: float, stage: str) -> None:
        if self._shown:
            part = (self._number + fraction) / self._count
            full = round(part * _WIDTH)
            line = f"[{'#' * full}{'.' * (_WIDTH - full)}] {part:4.0%} {self._name} {stage}"
            print(f"\r{line[:100]:100}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self._shown:
            print(f"\r{'':100}\r", end="", file=sys.stderr, flush=True)


def _shows(given: Namespace) -> bool:
    return not given.quiet and sys.stderr.isatty()


def _print(report: Report, given: Namespace) -> None:
    if given.json == "-" or (given.quiet and report["verdict"] == GOOD and given.command != "measure"):
        return
    parts = [report["file"], report["verdict"]]
    if given.command == "measure" and "holes" in report:
        edges = ", ".join(map(str, sorted(hole["edges"] for hole in report["holes"])))
        parts = [report["file"], f"{report['vertices']} vertices, {report['faces']} faces"]
        parts.append(f"{len(report['holes'])} holes" + (f" of {edges} edges" if edges else ""))
        parts += [f"{report[name]} {name.replace('_', ' ')}" for name in ("outer_borders", "hard_edges")]
        parts.append(f"{report['crossing_triangles']} crossing triangles")
    parts += [report[name] for name in ("reason", "written") if report.get(name)]
    parts += [f"without {', '.join(report['not_written'])}"] if report.get("not_written") else []
    print(": ".join(parts[:2]) + "".join(f"; {part}" for part in parts[2:]))


def _write_json(reports: list[Report], given: Namespace) -> None:
    if given.json is None:
        return
    place = {str(source): number for number, source in enumerate(given.files)}
    reports.sort(key=lambda report: place[report["file"]])
    text = json.dumps(reports, indent=2, ensure_ascii=False) + "\n"
    if given.json == "-":
        print(text, end="")
    else:
        Path(given.json).write_text(text, encoding="utf-8")
