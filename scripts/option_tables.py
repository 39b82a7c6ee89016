"""Writes docs/options.md from the add-on's own descriptions of its options.

usage: python scripts/option_tables.py
"""

from __future__ import annotations

from pathlib import Path
from textwrap import fill

import plain_addon  # noqa: F401

ROOT = Path(__file__).resolve().parents[1]

from addon.options.options import FairOptions  # noqa: E402
from addon.options.other_options import CurvesOptions, DenoiseOptions, FilletOptions, FillOptions  # noqa: E402
from addon.options.table import FOLDED, GROUPS, Chosen, Option, Table, table  # noqa: E402

PAGE = ROOT / "docs" / "options.md"
OPERATORS: tuple[tuple[str, str, type[Chosen]], ...] = (
    ("mesh.fair_region", "Fair Region", FairOptions),
    ("mesh.fair_fill", "Fair Fill", FillOptions),
    ("mesh.fair_fillet", "Fair Fillet", FilletOptions),
    ("mesh.fair_denoise", "Fair Denoise", DenoiseOptions),
    ("mesh.fair_from_curves", "Fair From Curves", CurvesOptions),
)
HEAD = """\
# Options

Made by `scripts/option_tables.py` from the add-on's own list: don't edit it here. The
[user guide](user_guide.md#options) has pictures of what they do.
"""


def page() -> str:
    """Return the whole page."""
    parts, told = [HEAD], set[str]()
    for operator, label, of in OPERATORS:
        again = [f"*{option.label}*" for option in table(of) if _row(option) in told]
        above = fill(f"As above: {', '.join(again)}.", 120) + "\n\n" if again else ""
        parts.append(f"## {label}\n`{operator}`\n\n{above}{_options(table(of), told)}")
        told |= {_row(option) for option in table(of)}
    return "\n".join(parts)


def _options(options: Table, told: set[str]) -> str:
    """The rows that no operator above has."""
    options = tuple(option for option in options if _row(option) not in told)
    rows = ["| option | what it does | values | default |", "| --- | --- | --- | --- |"]
    titles = [title for title in dict.fromkeys((*GROUPS, *(o.group for o in options), *FOLDED)) if _in(options, title)]
    for title in sorted(titles, key=lambda each: each in FOLDED):
        rows.append(f"| **{title}**{' (*Advanced*)' if title in FOLDED else ''} | | | |")
        rows += [_row(option) for option in _in(options, title)]
    return "\n".join(rows) + "\n"


def _in(options: Table, title: str) -> list[Option]:
    return [option for option in options if option.group == title]


def _row(option: Option) -> str:
    return f"| *{option.label}* `{option.name}` | {option.description} | {_values(option)} | {_shown(option)} |"


def _values(option: Option) -> str:
    if option.items:
        return ", ".join(f"`{identifier}` *{label}*" for identifier, label, _ in option.items)
    if isinstance(option.default, bool):
        return ""
    if isinstance(option.default, str):
        return "vertex group"
    least, most = option.bounds
    return f"{least:g} … {most:g}" if most < 1e6 else (f"from {least:g}" if least > -1e6 else "any number")


def _shown(option: Option) -> str:
    if isinstance(option.default, bool):
        return "on" if option.default else "off"
    return f"`{option.default}`" if option.items else str(option.default)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
