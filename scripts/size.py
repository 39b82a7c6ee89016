"""How large each part of the tree is, beside its ceiling in meta/size.toml, which only goes down.

size.py            1 where a part is above its ceiling
size.py --lower    lowers the ceilings to what there is
"""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
CEILINGS = ROOT / "meta/size.toml"


def counted(part: dict[str, Any]) -> int:
    """How often the part's pattern stands in those files of its folders whose names fit."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", *part["folders"]]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()
    paths = [ROOT / name for name in listed if re.search(part["files"], name) and (ROOT / name).is_file()]
    return sum(len(re.findall(part["counts"], path.read_text(encoding="utf-8"))) for path in paths)


def main() -> int:
    """Print each part with what is counted and its ceiling."""
    text = CEILINGS.read_text(encoding="utf-8")
    above = 0
    for name, part in tomllib.loads(text).items():
        count, most = counted(part), part["most"]
        above += count > most
        print(f"{name}: {count} of {most}{'  ABOVE ITS CEILING' if count > most else ''}")
        if "--lower" in sys.argv and count < most:
            head, rest = text.split(f'["{name}"]', 1)
            text = head + f'["{name}"]' + re.sub(r"(?m)^most = \d+$", f"most = {count}", rest, count=1)
    CEILINGS.write_text(text, encoding="utf-8")
    return int(above > 0)


if __name__ == "__main__":
    sys.exit(main())
