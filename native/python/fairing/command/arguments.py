"""What the command line accepts."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path, PurePosixPath

from fairing._core import __version__
from fairing.command.cluster import Place, is_address
from fairing.command.work import SUFFIX

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
    if any(is_address(each) for each in given.files) and not given.dask:
        parser.error("an address is read by the workers of --dask alone")
    return given


def target_of(source: Place, given: Namespace) -> Place | None:
    """Where the result for a file goes; None for `measure`."""
    if given.command == "measure":
        return None
    if given.output is not None:
        return _place(given.output)
    at = PurePosixPath(str(source)) if is_address(source) else Path(source)
    folder = str(given.into if given.into is not None else str(source)[: -len(at.name)] or ".")
    return _place(f"{folder.rstrip('/')}/{at.stem}{SUFFIX[given.command]}{given.format or at.suffix}")


def _place(word: str) -> Place:
    return word if is_address(word) else Path(word)


def _common(parser: ArgumentParser, writes: bool = True) -> None:
    parser.add_argument("files", nargs="+", type=_place, metavar="FILE", help="a mesh")
    if writes:
        where = parser.add_mutually_exclusive_group()
        where.add_argument("-o", "--output", metavar="FILE", help="where the result of a single file goes")
        where.add_argument("--into", metavar="FOLDER", help="where results go; else beside their files")
        parser.add_argument("--format", metavar=".EXT", help="the results' format; else that of their files")
        parser.add_argument("--accept-all", action="store_true", help="write results that can't be used, too")
        parser.add_argument("--threads", type=int, metavar="N", help="for one mesh; with --jobs: 1")
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
    parser.add_argument("--faces", choices=("triangles", "quads"), help="what new faces are; quads run in rows")
    parser.add_argument("--edges", choices=("run_on", "ignored"), help="what hard edges at a hole do")


def _fair(parser: ArgumentParser) -> None:
    _common(parser)
    _surface(parser)
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--select", metavar="NAME", help="data at faces that is not zero where they are selected")
    which.add_argument("--faces", metavar="FILE", help="a text file with the numbers of the faces, from 0")
    which.add_argument(
        "--sphere", nargs=4, type=float, metavar=("X", "Y", "Z", "R"), help="faces with their middle in it"
    )
    parser.add_argument("--side", choices=("automatic", "outside", "inside"), help="whose slope counts at the boundary")
    parser.add_argument("--detail", type=float, metavar="0…1", help="how much of the old detail is put back")
    parser.add_argument("--feather", type=float, metavar="SHARE", help="width of a band that fades the change out")


def _fillet(parser: ArgumentParser) -> None:
    _common(parser)
    parser.add_argument("--continuity", choices=("G1", "G2"), help="meet the tangent planes, or the curvature, too")
    parser.add_argument(
        "--width", type=float, required=True, metavar="LENGTH", help="how far it reaches on either side"
    )
    parser.add_argument("--width-2", type=float, metavar="LENGTH", help="the same on the other side")
    parser.add_argument("--profile", type=float, metavar="-1…1", help="flat to sharp")
    parser.add_argument("--spacing", type=float, metavar="LENGTH", help="length of new edges")
    parser.add_argument("--faces", choices=("triangles", "quads"), help="what new faces are; quads run along the edges")
