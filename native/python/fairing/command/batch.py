"""The command line: what it accepts, one file after the other or several at once, and the exit status."""

from __future__ import annotations

import json
import logging
import multiprocessing
import signal
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from importlib.util import find_spec
from pathlib import Path

from fairing._core import __version__
from fairing.command import cluster
from fairing.command.work import GOOD, LOOK, SUFFIX, UNUSABLE, Report, done_with
from fairing.results import Progress

_AFTER = """
exit status: 0, all results are good; 1, some should be looked at; 3, some can't be used and were not written, or a file
can't be read; 2, the arguments are wrong. OBJ and OFF need nothing else; others: pip install 'intrinsic-fairing[io]'.
Many files: give several, and --jobs.
"""


def parsed(words: Sequence[str] | None) -> Namespace:
    """The arguments, checked against each other; ends the program where they are wrong."""
    parser = ArgumentParser("fairing", description="Fair surfaces for meshes in files.", epilog=_AFTER)
    parser.add_argument("--version", action="version", version=__version__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _fill(commands.add_parser("fill", help="fill holes, or bridge boundary loops", epilog=_AFTER))
    _fair(commands.add_parser("fair", help="replace selected faces by the fairest surface", epilog=_AFTER))
    _fillet(commands.add_parser("fillet", help="round hard edges", epilog=_AFTER))
    _common(commands.add_parser("measure", help="list holes, hard edges and crossings", epilog=_AFTER), writes=False)
    given = parser.parse_args(words)
    if getattr(given, "output", None) is not None and len(given.files) > 1:
        parser.error("--output is for one file: use --into with several")
    if given.jobs < 1:
        parser.error("--jobs: 1 or more is needed")
    if given.dask and find_spec("distributed") is None:
        parser.error("--dask needs distributed: pip install 'intrinsic-fairing[dask]'")
    if any("://" in each for each in given.files) and not given.dask:
        parser.error("addresses (://) work with --dask only")
    return given


def target_of(source: str, given: Namespace) -> str | None:
    """Where the result for a file or an address goes; None for `measure`."""
    if given.command == "measure" or given.output is not None:
        return getattr(given, "output", None)
    folder, name = given.into or source[: -len(Path(source).name)] or ".", Path(source)
    return f"{folder.rstrip('/')}/{name.stem}{SUFFIX[given.command]}{given.format or name.suffix}"


def _place(word: str) -> str:
    return word if "://" in word else str(Path(word))


def _common(parser: ArgumentParser, writes: bool = True) -> None:
    parser.add_argument("files", nargs="+", type=_place, metavar="FILE", help="a mesh")
    if writes:
        where = parser.add_mutually_exclusive_group()
        where.add_argument("-o", "--output", type=_place, metavar="FILE", help="where the result of a single file goes")
        where.add_argument("--into", metavar="FOLDER", help="where results go; else beside their files")
        parser.add_argument("--format", metavar=".EXT", help="the results' format; else that of their files")
        parser.add_argument("--accept-all", action="store_true", help="write results that can't be used, too")
        parser.add_argument("--threads", type=int, metavar="N", help="per mesh; 1 with --jobs")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="files at once")
    parser.add_argument("--dask", metavar="ADDRESS", help="the scheduler of a cluster that does the work (distributed)")
    parser.add_argument("--json", metavar="FILE", help="a report on each file; - for the standard output")
    parser.add_argument("-q", "--quiet", action="store_true", help="no progress bar, only what is not good")
    parser.add_argument("-v", "--verbose", action="store_true", help="the engine's log")


def _surface(parser: ArgumentParser) -> None:
    parser.add_argument("--continuity", choices=("G1", "G2"), help="meet the tangent planes, or the curvature, too")
    parser.add_argument("--equation", metavar="NAME", help="soap_film, least_variation, …: help(fairing.fair)")


def _fill(parser: ArgumentParser) -> None:
    _common(parser)
    _surface(parser)
    parser.add_argument("--longest", type=int, metavar="EDGES", help="leave holes with more edges open")
    parser.add_argument("--longest-length", type=float, metavar="LENGTH", help="leave longer holes open")
    parser.add_argument("--bridge", action="store_true", default=None, help="one surface joins all boundary loops")
    parser.add_argument("--spacing", type=float, metavar="LENGTH", help="length of new edges")
    parser.add_argument("--faces", choices=("triangles", "quads"), help="kind of new faces; quads run in rows")
    parser.add_argument("--edges", choices=("run_on", "ignored"), help="whether hard edges continue")


def _fair(parser: ArgumentParser) -> None:
    _common(parser)
    _surface(parser)
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--select", metavar="NAME", help="face attribute, nonzero on selected faces")
    which.add_argument("--faces", metavar="FILE", help="a text file with the numbers of the faces, from 0")
    which.add_argument(
        "--sphere", nargs=4, type=float, metavar=("X", "Y", "Z", "R"), help="faces centred in this sphere"
    )
    parser.add_argument("--side", choices=("automatic", "outside", "inside"), help="whose slope counts at the boundary")
    parser.add_argument("--detail", type=float, metavar="0…1", help="how much of the old detail is put back")
    parser.add_argument("--feather", type=float, metavar="SHARE", help="width of a band that fades the change out")


def _fillet(parser: ArgumentParser) -> None:
    _common(parser)
    parser.add_argument("--continuity", choices=("G1", "G2"), help="meet the tangent planes, or the curvature, too")
    parser.add_argument("--width", type=float, required=True, metavar="LENGTH", help="reach of the fillet on each side")
    parser.add_argument("--width-2", type=float, metavar="LENGTH", help="the same on the other side")
    parser.add_argument("--profile", type=float, metavar="-1…1", help="-1 flat, 0 round, 1 sharp")
    parser.add_argument("--spacing", type=float, metavar="LENGTH", help="length of new edges")
    parser.add_argument("--faces", choices=("triangles", "quads"), help="what new faces are; quads run along the edges")


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
            bar = _bar(number, len(given.files), Path(source).name, given)
            yield done_with(source, target_of(source, given), given, bar)
            bar(1.0, "")


def _several_at_once(given: Namespace) -> Iterator[Report]:
    """The same in processes that go from file to file, here or on a cluster."""
    if getattr(given, "threads", 1) is None:
        given.threads = 1
    each = Namespace(**{**vars(given), "files": ()})  # goes along with every file: without the list of all
    jobs = [(source, target_of(source, given)) for source in given.files]
    for number, report in enumerate(cluster.reports(jobs, each) if given.dask else _in_processes(jobs, each)):
        bar = _bar(number, len(jobs), f"{number + 1} of {len(jobs)}", given)
        bar(1.0, "done")
        bar(1.0, "")
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


def _bar(number: int, count: int, name: str, given: Namespace) -> Progress:
    """Writes a line on the terminal that goes with the engine's progress; an empty one at its end."""
    is_shown = not given.quiet and sys.stderr.isatty()

    def show(fraction: float, stage: str) -> None:
        part = (number + fraction) / count
        full = round(part * _WIDTH)
        line = f"[{'#' * full}{'.' * (_WIDTH - full)}] {part:4.0%} {name} {stage}" if stage else ""
        if is_shown:
            print(f"\r{line[:100]:100}", end="" if stage else "\r", file=sys.stderr, flush=True)

    return show


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
    place = {source: number for number, source in enumerate(given.files)}
    reports.sort(key=lambda report: place[report["file"]])
    text = json.dumps(reports, indent=2, ensure_ascii=False) + "\n"
    if given.json == "-":
        print(text, end="")
    else:
        Path(given.json).write_text(text, encoding="utf-8")
