"""Writes what is made from the add-on's lists: docs/options.md and the files of its presets.

usage: python scripts/option_tables.py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "addon"))

from core.fair_options import FAIR  # noqa: E402
from core.fill_options import DENOISE, FILL, FILLET  # noqa: E402
from core.option_shared import FOLDED, GROUPS  # noqa: E402
from core.option_table import Option, Table, advice, names_before  # noqa: E402
from core.presets import PRESETS, preset  # noqa: E402

PAGE = ROOT / "docs" / "options.md"
HEAD = """\
# Options

Made by `scripts/option_tables.py` from the add-on's own list of options: don't edit it here. The
[user guide](user_guide.md#options) shows with pictures what they do; [blender.md](blender.md) has the scripts.
Each run that a button or a menu starts begins with the defaults. Options without effect don't show.
"""


def page() -> str:
    """Return the whole page."""
    parts = [HEAD]
    for operator, label, table in (
        ("mesh.fair_region", "Fair Region", FAIR),
        ("mesh.fair_fill", "Fair Fill", FILL),
        ("mesh.fair_fillet", "Fair Fillet", FILLET),
        ("mesh.fair_denoise", "Fair Denoise", DENOISE),
    ):
        parts.append(f"## {label}\n`{operator}`\n\n{_options(table)}")
    parts.append(
        "## Names before\nThey work in scripts, presets and on the command line until 0.2, with a "
        f"`DeprecationWarning`.\n\n{_before()}"
    )
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


def _options(table: Table) -> str:
    rows = ["| label | property | what it does | values | default |", "| --- | --- | --- | --- | --- |"]
    titles = [title for title in dict.fromkeys((*GROUPS, *(o.group for o in table), *FOLDED)) if _in(table, title)]
    for title in sorted(titles, key=lambda each: each in FOLDED):
        rows.append(f"| **{title}**{' (*Advanced*)' if title in FOLDED else ''} | | | | |")
        rows += [_row(option) for option in _in(table, title)]
    return "\n".join(rows) + "\n"


def _in(table: Table, title: str) -> list[Option]:
    return [option for option in table if option.group == title]


def _row(option: Option) -> str:
    return f"| *{option.label}* | `{option.name}` | {option.description} | {_values(option)} | {_shown(option)} |"


def _values(option: Option) -> str:
    if option.items:
        return ", ".join(f"`{identifier}` *{label}*" for identifier, label, _ in option.items)
    if isinstance(option.default, bool):
        return "on, off"
    if isinstance(option.default, str):
        return "name of a vertex group"
    if option.bounds is None:
        return ""
    least, most = option.bounds
    return f"{least:g} … {most:g}" if most < 1e6 else (f"from {least:g}" if least > -1e6 else "any number")


def _shown(option: Option) -> str:
    if isinstance(option.default, bool):
        return "on" if option.default else "off"
    return f"`{option.default}`" if option.items else str(option.default)


def _before() -> str:
    rows = ["| operator | name before | now |", "| --- | --- | --- |"]
    for operator, table in (("mesh.fair_region", FAIR), ("mesh.fair_fill", FILL), ("mesh.fair_fillet", FILLET)):
        for name, (option, before) in names_before(table).items():
            values = f": {', '.join(f'`{value}`' for value in before.values)}" if before.values else ""
            rows.append(f"| `{operator}` | `{name}`{values} | {advice(option, before)} |")
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    for path, text in presets().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
