"""An interpreter that ends while the engine is at work in another thread: always in order, never by abort."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import shapes

BEGIN = """
import atexit, os, sys, threading, time
sys.path.insert(0, sys.argv[1])
import numpy as np, fairing, shapes
cap = shapes.cap(10_000)
goes_on = threading.Event(); goes_on.set()
begun = threading.Event()

def progress(fraction, stage):
    begun.set()
    return goes_on.is_set()

def fair(**options):
    return fairing.fair(cap.vertices, cap.triangles, fixed=cap.fixed, fixed_normals=cap.fixed_normals, **options)

def start(work, daemon=True):
    threading.Thread(target=work, daemon=daemon).start()
"""


def ended(program: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The program, run to its end by an interpreter of its own; it must end in order."""
    command = [sys.executable, "-c", BEGIN + program, str(Path(shapes.__file__).parent), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=180, check=False)
    assert done.returncode == 0, done.stderr
    return done


DAEMONS = {
    "calls again and again": """
def work():
    while True:
        try:
            fair(progress=progress)
        except fairing.Cancelled:
            pass

start(work)
start(work)
begun.wait()
""",
    "has no callback": """
small = shapes.cap(3000)

def work():
    begun.set()
    while True:
        fairing.maps.interpolate(small.vertices, small.triangles, small.fixed, small.vertices[small.fixed])

start(work)
begun.wait()
time.sleep(0.1)
""",
    "its callback never returns": """
held = threading.Lock()
held.acquire()

def wait(fraction, stage):
    begun.set()
    with held:
        return True

start(lambda: fair(progress=wait))
begun.wait()
""",
}
# It comes back after the end has stopped to wait, and while the interpreter takes its time to go.
DAEMONS |= {
    f"its {what} is still asleep when the interpreter is gone": f"""
class Slow:
    def __del__(self, sleep=time.sleep):
        sleep(2)

def wait(*_):
    begun.set()
    time.sleep(3)
    return True

sys.modules["slow"] = Slow()
start(lambda: fair({what}=wait))
begun.wait()
"""
    for what in ("progress", "preview")
}


@pytest.mark.parametrize("kind", DAEMONS)
def test_no_kind_of_daemon_aborts_or_holds_the_process(kind: str) -> None:
    ended(DAEMONS[kind])


DURING_A_RUN = """
start(lambda: fair(progress=progress))
begun.wait()
time.sleep(float(sys.argv[2]))
if sys.argv[3] == "cancelled":
    goes_on.clear()
"""


@pytest.mark.parametrize("delay", [0.0, 0.1, 0.25])
@pytest.mark.parametrize("state", ["running", "cancelled"])
def test_a_daemon_at_work_does_not_abort_the_process(state: str, delay: float) -> None:
    ended(DURING_A_RUN, str(delay), state)


def test_the_thread_that_ends_may_still_call() -> None:
    done = ended("""
def last():
    print(fair().converged)

atexit.unregister(last)
from fairing import _core
atexit._run_exitfuncs()  # those of the module, which refuse other threads from now on
atexit.register(last)
refused = []

def work():
    try:
        fair()
    except fairing.Cancelled:
        refused.append(True)

other = threading.Thread(target=work)
other.start()
other.join()
print(refused)
""")
    assert done.stdout.split() == ["[True]", "True"]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_forked_child_does_not_wait_for_the_runs_of_its_parent() -> None:
    done = ended("""
start(lambda: fair(progress=progress))
begun.wait()
child = os.fork()
if child == 0:
    print(fair(threads=1).converged, flush=True)
    sys.exit()
print(os.waitpid(child, 0)[1])
""")
    assert done.stdout.split() == ["True", "0"]


# The memory that a call takes at its peak.
# 2.4 with all fields in double precision and a copy of everything for each level, 1.7 with copies of the input, lists
# of uniform weights and old fields of the iteration.
MOST = 1.35  # kB for each free vertex, above the input


CALL = """
import sys
from pathlib import Path
import numpy as np
import fairing

def kilobytes(name):
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name))

made = {key: value for key, value in np.load(sys.argv[1]).items()}
vertices, triangles, fixed, normals = (made[key] for key in ("vertices", "triangles", "fixed", "normals"))
before = kilobytes("VmRSS")
Path("/proc/self/clear_refs").write_text("5")  # the peak starts anew
result = fairing.fair(vertices, triangles, fixed=fixed, fixed_normals=normals, threads=1)
assert result.converged
print(kilobytes("VmHWM") - before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the peak is read from Linux's /proc")
@pytest.mark.skipif("libasan" in os.environ.get("LD_PRELOAD", ""), reason="the address sanitizer keeps what is freed")
def test_a_large_patch_takes_little_for_each_vertex(tmp_path: Path) -> None:
    patch = shapes.cap(40_000)
    path = tmp_path / "patch.npz"
    np.savez(
        path, vertices=patch.vertices, triangles=patch.triangles, fixed=patch.fixed, normals=patch.fixed_normals
    )  # fmt: skip
    # 1.18 kB; what a helper holds at the same time depends on when it runs.
    call = [sys.executable, "-c", CALL, str(path)]
    peaks = [float(subprocess.run(call, capture_output=True, text=True, check=True).stdout) for _ in range(3)]
    assert min(peaks) <= MOST * len(patch.free)
