"""python -m fairing on files, with meshio and trimesh where they are installed."""

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fairing
from fairing.command import batch, cluster, files
from fairing.command.work import GOOD, LOOK, UNUSABLE, judged
from fairing.objects.parts import Parts, Polygons
from test_mesh_objects import COLUMNS, dented, holed, radius, split, tube


@pytest.fixture
def meshio() -> Any:
    return pytest.importorskip("meshio")


def written(path: Path, points: np.ndarray, triangles: np.ndarray) -> Path:
    """A PLY file."""
    plyfile = pytest.importorskip("plyfile")
    files.ply.write(plyfile, path, Parts(points, Polygons.of(triangles), {"height": points[:, 2]}), None)
    return path


@pytest.fixture
def scan(tmp_path: Path) -> Path:
    """A tube with a hole of 12 edges; its ends have 32."""
    return written(tmp_path / "scan.ply", *holed())


def report_of(tmp_path: Path, *words: object) -> tuple[int, list[dict[str, Any]]]:
    """Run with a report; return the exit status and what it says of each file."""
    report = tmp_path / "report.json"
    status = batch.main([*map(str, words), "--json", str(report)])
    return status, json.loads(report.read_text(encoding="utf-8"))


def test_fill(scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, (report,) = report_of(tmp_path, "fill", scan, "--longest", 20)
    made, _ = files.read(scan.with_name("scan_filled.ply"))
    assert (status, report["verdict"], report["converged"]) == (0, "good", True)
    assert abs(radius(made.points) - 1).max() < 1e-4
    assert len(made.points) - len(holed()[0]) == report["vertices"] > 0
    assert abs(made.vertex_data["height"] - made.points[:, 2]).max() < 0.02
    assert report["left_open"] == 0 and report["written"].endswith("scan_filled.ply")
    assert capsys.readouterr().out.startswith(f"{scan}: good")


def test_fair(meshio: Any, tmp_path: Path) -> None:
    points, quads, selected = dented()
    source, target = tmp_path / "dented.vtk", tmp_path / "new" / "fair.vtk"
    meshio.Mesh(points, [("quad", quads)], {}, {"dent": [selected.astype(np.int32)]}).write(source)
    (tmp_path / "faces.txt").write_text("\n".join(map(str, np.flatnonzero(selected))))
    for how in (["--select", "dent"], ["--faces", tmp_path / "faces.txt"]):
        status, (report,) = report_of(tmp_path, "fair", source, "-o", target, *how)
        assert (status, report["verdict"]) == (0, "good"), report
        assert abs(radius(meshio.read(target).points) - 1).max() < 1e-4
        target.unlink()
    status, (report,) = report_of(tmp_path, "fair", source, "-o", target, "--sphere", 0, 0, 0, 0.01)
    assert (status, "no face" in report["reason"], target.exists()) == (3, True, False)
    meshio.Mesh(points[quads[0]], [("quad", [[0, 1, 2, 3]])]).write(source)
    status, (report,) = report_of(tmp_path, "fair", source, "-o", target, "--sphere", 0, 0, 0, 9)
    assert (status, report["verdict"], target.exists()) == (3, UNUSABLE, False)  # of one face nothing is free


def test_fillet(tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    trimesh.creation.box().export(tmp_path / "box.obj")
    status, (report,) = report_of(tmp_path, "fillet", tmp_path / "box.obj", "--width", 0.2)
    rounded = trimesh.load(report["written"], force="mesh", process=False)
    assert status in (0, 1) and report["converged"]
    assert 0.85 < rounded.volume < 1.0 and rounded.is_watertight
    given = ("--width", 0.2, "--faces", "quads")
    status, (report,) = report_of(tmp_path, "fillet", tmp_path / "box.obj", *given)
    assert status in (0, 1) and report["converged"]


def test_measure(scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, (report,) = report_of(tmp_path, "measure", scan)
    assert status == 0
    assert sorted(hole["edges"] for hole in report["holes"]) == [12, 32, 32]
    longest = max(hole["length"] for hole in report["holes"])
    assert longest == pytest.approx(2 * COLUMNS * np.sin(np.pi / COLUMNS), rel=1e-5)
    assert (report["hard_edges"], report["crossing_triangles"], report["outer_borders"]) == (0, 0, 0)
    assert "3 holes of 12, 32, 32 edges" in capsys.readouterr().out


def test_several_files_at_once(scan: Path, tmp_path: Path) -> None:
    """Each in a process; what is wrong with one stops no other, the reports are in the order of the files."""
    broken, closed = tmp_path / "broken.ply", tmp_path / "closed.ply"
    broken.write_text("ply\n")
    points, quads = tube()
    written(closed, points, split(quads))
    names = [broken, scan, tmp_path / "missing.ply", closed]
    status, reports = report_of(
        tmp_path, "fill", *names, "--longest", 20, "--into", tmp_path / "out", "--jobs", 2, "--format", ".off"
    )
    assert status == 3
    assert [Path(report["file"]).name for report in reports] == [name.name for name in names]
    assert [report["verdict"] for report in reports] == [UNUSABLE, GOOD, UNUSABLE, GOOD]
    assert "nothing to fill" in reports[3]["reason"] and "no such file" in reports[2]["reason"]
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"scan_filled.off", "closed_filled.off"}


def _done_or_dead(job: Any, *more: Any) -> Any:
    """On a worker, which dies the first time that a file of this name comes."""
    place = Path(job[0])  # of this machine, as the workers are
    if place.stem == "deadly" and not place.with_suffix(".died").exists():
        place.with_suffix(".died").touch()
        os._exit(1)
    return _done(job, *more)


_done = cluster._done


def test_a_cluster_does_the_same(scan: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two worker processes, one of which dies once; by content, and by addresses of fsspec."""
    distributed = pytest.importorskip("distributed")
    names = [shutil.copy(scan, tmp_path / f"{name}.ply") for name in ("a", "deadly", "b")] + [tmp_path / "no.ply"]
    monkeypatch.setattr(cluster, "_done", _done_or_dead)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as two:
        for name in (tmp_path / "out", f"file://{tmp_path}/far"):
            words = ["fill", *names, f"file://{scan}", "--longest", 20, "--into", name]
            status, reports = report_of(tmp_path, *words, "--dask", two.scheduler_address)
            assert (status, [report["verdict"] for report in reports]) == (3, [GOOD] * 3 + [UNUSABLE, GOOD])
            assert (tmp_path / "deadly.died").exists() and "no.ply" in reports[3]["reason"]
            places = [Path(report["written"].removeprefix("file://")) for report in reports if "written" in report]
            assert all(abs(radius(files.read(place)[0].points) - 1).max() < 1e-4 for place in places)


@pytest.mark.skipif(os.name == "nt", reason="a console's interrupt can't be sent to one process alone")
def test_an_interrupt_keeps_what_is_done(scan: Path, tmp_path: Path) -> None:
    """No further file begins; the report has those that are done, each of them written."""
    names = [str(scan)] + [str(shutil.copy(scan, tmp_path / f"{number}.ply")) for number in range(399)]
    words = ["fill", *names, "--longest", "20", "--into", str(tmp_path / "out"), "--jobs", "2"]
    command = [sys.executable, "-u", "-m", "fairing", *words, "--json", str(tmp_path / "report.json")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None and running.stdout.readline()
        running.send_signal(signal.SIGINT)
        _, said = running.communicate()
    reports = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert (running.returncode, said) == (130, "interrupted\n")
    assert 0 < len(reports) < len(names)
    assert all(Path(report["written"]).is_file() for report in reports)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("fill a.ply b.ply -o c.ply", "--into"),
        ("fair a.ply", "--select"),
        ("fillet a.ply", "--width"),
        ("fill a.ply --jobs 0", "--jobs"),
        ("fill s3://bucket/a.ply", "--dask"),
        ("", "COMMAND"),
    ],
)
def test_wrong_arguments_end_with_two(words: str, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        batch.parsed(words.split())
    assert ended.value.code == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("kind", [".vtk", ".glb", ".obj", ".off", ".stl"])
def test_from_one_format_to_another(scan: Path, kind: str, tmp_path: Path) -> None:
    """What a format can't have is said."""
    pytest.importorskip("meshio" if kind == ".vtk" else "trimesh")
    status, (report,) = report_of(tmp_path, "fill", scan, "--format", kind, "--longest", 20)
    assert status == 0 and report["not_written"] == ([] if kind == ".vtk" else ["height"])
    assert abs(radius(files.read(Path(report["written"]))[0].points) - 1).max() < 1e-4
    status, (report,) = report_of(tmp_path, "fill", scan, "--format", ".doc")
    assert status == 3 and ".vtk" in report["reason"]


def test_the_verdict_looks_at_warnings_and_the_join() -> None:
    points, quads, selected = dented()
    good = fairing.fair_faces((points, quads), selected).result
    assert judged(good) == (GOOD, "")
    kinked = points.copy()
    kinked[COLUMNS * 11 :, 0] += 3.0  # the upper end stands aside: no tube of constant slope
    grade, reason = judged(fairing.fair_faces((kinked, quads), selected).result)
    assert grade in (LOOK, UNUSABLE) and reason
    stopped = fairing.fair_faces((points, quads), selected, max_iterations=1, otherwise="stop").result
    assert stopped.converged or judged(stopped)[0] == UNUSABLE
