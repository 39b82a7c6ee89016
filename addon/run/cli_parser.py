"""The arguments of `blender --background FILE --command fair …`."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import Any

from ..options.options import FairOptions
from ..options.other_options import FilletOptions, FillOptions
from ..options.table import Option, table

EDGE_LENGTH = "edge_length"  # the fillet's spacing, which is a length


def parse(arguments: list[str]) -> Any:
    """Return what was asked for, with every option by its name."""
    return _parser().parse_args(arguments)


def fillet_options(chosen: Any) -> FilletOptions:
    """Return the options of fillets."""
    names = [option.name for option in table(FilletOptions)]
    return FilletOptions(**{name: getattr(chosen, EDGE_LENGTH if name == "spacing" else name) for name in names})


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="blender --background FILE --command fair",
        description="Fair faces of a mesh, fill its holes or round its edges. Exit status: 0 done, 1 the result is not "
        "usable (written only with --allow-folds), 2 refused.",
    )
    parser.add_argument("--object", required=True, help="name of the mesh object")
    parser.add_argument(
        "--vertex-group",
        dest="region_group",
        help="fair the faces inside this vertex group; default: the faces that are selected in the file. With --fill: "
        "fill the holes that have a vertex in it; with --fillet: round the edges inside it; default: all",
    )
    parser.add_argument("--fill", action="store_true", help="fill holes instead")
    parser.add_argument("--fillet", action="store_true", help="round edges instead")
    parser.add_argument("--output", required=True, help="the .blend file to write")
    parser.add_argument("--report", choices=("text", "json"), default="text")
    known: set[str] = set()
    for of, when in ((FairOptions, ""), (FillOptions, "with --fill: "), (FilletOptions, "with --fillet: ")):
        _add(parser, (option for option in table(of) if option.name not in known), when)
        known |= {option.name for option in table(of)}
    spacing = next(option for option in table(FilletOptions) if option.name == "spacing")
    parser.add_argument("--edge-length", type=float, default=spacing.default, help=f"with --fillet: {_help(spacing)}")
    return parser


def _add(parser: argparse.ArgumentParser, options: Iterable[Option], when: str) -> None:
    for option in options:
        kind: dict[str, Any] = {"type": type(option.default)}
        if isinstance(option.default, bool):
            kind = {"action": argparse.BooleanOptionalAction}
        flag = "--factor-group" if option.name == "vertex_group" else "--" + option.name.replace("_", "-")
        parser.add_argument(flag, dest=option.name, default=option.default, help=when + _help(option), **kind)


def _help(option: Option) -> str:
    accepted = f" ({', '.join(item[0] for item in option.items)})" if option.items else ""
    return (option.description + accepted).replace("%", "%%")
