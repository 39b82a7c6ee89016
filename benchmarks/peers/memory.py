"""Peak memory of one call above its input, in a process of its own.

    python benchmarks/peers/memory.py FOLDER SHAPE SIZE TOOL

prints MB.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

LIMIT = 1200.0  # seconds


def above_input(folder: Path, shape: str, size: int, tool: str) -> float:
    """MB, measured by a new process; NaN where the call fails or takes too long there."""
    command = [sys.executable, __file__, str(folder), shape, str(size), tool]
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, check=True, env=paths)
    except (subprocess.TimeoutExpired, subprocess.CalledProcessError) as error:
        print(f"{tool}: {error}\n{error.stderr}", file=sys.stderr)
        return float("nan")
    return float(done.stdout.split()[-1])


def _status(name: str) -> float:
    """A line of the kernel's report on this process, MB."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name)) / 1024


def main() -> None:
    """Calls the tool once and prints the difference."""
    from problems import problem
    from tools import BY_NAME

    folder, shape, size, name = sys.argv[1:]
    made = problem(Path(folder), shape, int(size))
    _ = made.all_triangles, made.all_vertices, made.held, made.free
    before = _status("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")  # the peak starts anew
    answer = BY_NAME[name].call(made)
    assert len(answer.vertices) == len(made.vertices)
    print(_status("VmHWM") - before)


if __name__ == "__main__":
    main()
