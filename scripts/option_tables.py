"""Writes what is made from the add-on's lists: docs/options.md and the files of its presets.

usage: python scripts/option_tables.py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from textwrap import fill

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "addon"))

from core.fair_options import FAIR  # noqa: E402
from core.fill_options import CURVES, DENOISE, FILL, FILLET  # noqa: E402
from core.option_shared import FOLDED, GROUPS  # noqa: E402
from core.option_table import Option, Table  # noqa: E402
from core.presets import PRESETS, preset  # noqa: E402

PAGE = ROOT / "docs" / "options.md"
HEAD = """\
# Options

Made by `scripts/option_tables.py` from the add-on's own list: don't edit it here. The
[user guide](user_guide.md#options) has pictures of what they do.
"""
BEFORE = """\
## Earlier names
They work until 0.2, in scripts, presets and on the command line; a `DeprecationWarning` says what to write instead.
"""


def page() -> str:
    """Return the whole page."""
    parts, told = [HEAD], set[str]()
    for operator, label, table in (
        ("mesh.fair_region", "Fair Region", FAIR),
        ("mesh.fair_fill", "Fair Fill", FILL),
        ("mesh.fair_fillet", "Fair Fillet", FILLET),
        ("mesh.fair_denoise", "Fair Denoise", DENOISE),
        ("mesh.fair_from_curves", "Fair From Curves", CURVES),
    ):
        again = [f"*{option.label}*" for option in table if _row(option) in told]
        above = fill(f"As above: {', '.join(again)}.", 120) + "\n\n" if again else ""
        parts.append(f"## {label}\n`{operator}`\n\n{above}{_options(table, told)}")
        told |= {_row(option) for option in table}
    parts.append(BEFORE)
    return "\n".join(parts)


def presets() -> dict[Path, str]:
    """Return the presets' files, as Blender writes them."""
    made = {}
    for operator, (_, of_one) in PRESETS.items():
        for name in of_one:
            lines = [f"op.{option} = {_written(value)}" for option, value in preset(operator, name).items()]
            text = "\n".join(["import bpy", "", "op = bpy.context.active_operator", "", *lines]) + "\n"
            made[ROOT / "addon/presets/operator" / operator / f"{name.replace(' ', '_')}.py"] = text
    return made


def _written(value: object) -> str:
    return json.dumps(value) if isinstance(value, str) else repr(value)


def _options(table: Table, told: set[str]) -> str:
    """The rows that no operator above has."""
    table = tuple(option for option in table if _row(option) not in told)
    rows = ["| option | what it does | values | default |", "| --- | --- | --- | --- |"]
    titles = [title for title in dict.fromkeys((*GROUPS, *(o.group for o in table), *FOLDED)) if _in(table, title)]
    for title in sorted(titles, key=lambda each: each in FOLDED):
        rows.append(f"| **{title}**{' (*Advanced*)' if title in FOLDED else ''} | | | |")
        rows += [_row(option) for option in _in(table, title)]
    return "\n".join(rows) + "\n"


def _in(table: Table, title: str) -> list[Option]:
    return [option for option in table if option.group == title]


def _row(option: Option) -> str:
    return f"| *{option.label}* `{option.name}` | {option.description} | {_values(option)} | {_shown(option)} |"


def _values(option: Option) -> str:
    if option.items:
        return ", ".join(f"`{identifier}` *{label}*" for identifier, label, _ in option.items)
    if isinstance(option.default, bool):
        return ""
    if isinstance(option.default, str):
        return "vertex group"
    if option.bounds is None:
        return ""
    least, most = option.bounds
    return f"{least:g} … {most:g}" if most < 1e6 else (f"from {least:g}" if least > -1e6 else "any number")


def _shown(option: Option) -> str:
    if isinstance(option.default, bool):
        return "on" if option.default else "off"
    return f"`{option.default}`" if option.items else str(option.default)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    for path, text in presets().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
