"""The arguments of `blender --background FILE --command fair …`."""

from __future__ import annotations

import argparse
from typing import Any

from ..core.fair_options import FAIR
from ..core.fill_options import FILL, FILLET
from ..core.option_table import Option, Table, defaults, from_names_before, names_before, warn_of_names_before

EDGE_LENGTH = "edge_length"  # the fillet's spacing, which is a length


def parse(arguments: list[str]) -> Any:
    """Return what was asked for, with every option by its name of now."""
    chosen = _parser().parse_args(arguments)
    table = FILL if chosen.fill else FAIR
    used = {name: value for name, value in vars(chosen).items() if name in names_before(table)}
    warn_of_names_before(table, used, "fair")
    for name, value in from_names_before(table, used).items():
        setattr(chosen, name, value)
    return chosen


def fillet_option(chosen: Any, name: str) -> Any:
    """Return the value of an option of fillets."""
    return getattr(chosen, EDGE_LENGTH if name == "spacing" else name)


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
    of_fair, of_fill = defaults(FAIR), defaults(FILL)
    _add(parser, FAIR, "")
    _add(parser, tuple(option for option in FILL if option.name not in of_fair), "with --fill: ")
    _add(parser, tuple(option for option in FILLET if option.name not in {**of_fair, **of_fill}), "with --fillet: ")
    spacing = next(option for option in FILLET if option.name == "spacing")
    parser.add_argument("--edge-length", type=float, default=spacing.default, help=f"with --fillet: {_help(spacing)}")
    for name, (option, before) in {**names_before(FILL), **names_before(FAIR)}.items():
        if name == "factor_group":  # is a flag still: --vertex-group says which faces
            continue
        kind = str if before.values else type(option.default)
        parser.add_argument(_flag(name), dest=name, type=kind, default=argparse.SUPPRESS, help=argparse.SUPPRESS)
    return parser


def _add(parser: argparse.ArgumentParser, table: Table, when: str) -> None:
    for option in table:
        kind: dict[str, Any] = {"type": type(option.default)}
        if isinstance(option.default, bool):
            kind = {"action": argparse.BooleanOptionalAction}
        flag = "--factor-group" if option.name == "vertex_group" else _flag(option.name)
        parser.add_argument(flag, dest=option.name, default=option.default, help=when + _help(option), **kind)


def _flag(name: str) -> str:
    return "--" + name.replace("_", "-")


def _help(option: Option) -> str:
    accepted = f" ({', '.join(item[0] for item in option.items)})" if option.items else ""
    return (option.description + accepted).replace("%", "%%")
