"""python -m fairing on files as other programs write them: read, filled, and written with all that was in them."""

import json
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fairing
import odd_files
from fairing.command import batch, files
from fairing.objects.parts import Parts, Polygons
from test_mesh_objects import COLUMNS, holed, radius, split, tube

pytest.importorskip("plyfile")
trimesh = pytest.importorskip("trimesh")
LOST = {
    "points_lines.obj": ["l", "p", "vp"], "binary_attribute.stl": ["stl"], "NCOFF .5 .5 .5 1.off": ["normals"],
    "STCNOFF.off": ["normals", "uv"],
}  # fmt: skip
GOOD, BROKEN = odd_files.good(), odd_files.broken()


def report_of(folder: Path, *words: object) -> tuple[int, list[dict[str, Any]]]:
    status = batch.main([*map(str, words), "--json", str(folder / "report.json")])
    return status, json.loads((folder / "report.json").read_text(encoding="utf-8"))


def filled(source: Path, *words: object) -> tuple[Parts, dict[str, Any]]:
    """What was written, and the report."""
    target = source.with_name("out" + source.suffix)
    status, (report,) = report_of(source.parent, "fill", source, "-o", target, *words)
    assert status in (0, 1), report
    return files.read(target)[0], report


def volume(mesh: Parts) -> float:
    corners = mesh.points[mesh.triangles]
    return float(np.einsum("ti,ti->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


@pytest.mark.parametrize("name", GOOD)
def test_odd_files_are_read(name: str, tmp_path: Path) -> None:
    """The box is closed, with nothing lost but what stands in no mesh."""
    if name == "long_name.stl":
        pytest.importorskip("meshio")
    (tmp_path / name).write_bytes(GOOD[name])
    before = files.read(tmp_path / name)[0]
    mesh, report = filled(tmp_path / name)
    assert volume(mesh) == pytest.approx(1.0)
    assert not len(fairing.borders.hole_loops(mesh.points, mesh.triangles[mesh.sound]).loops)
    assert np.array_equal(mesh.points[: len(before.points)], before.points)
    lost = {*LOST.get(name, [])}
    assert mesh.vertex_data.keys() == before.vertex_data.keys()
    assert mesh.face_data.keys() - lost == before.face_data.keys() - lost
    for key, values in before.vertex_data.items():
        assert mesh.vertex_data[key].dtype == values.dtype
    assert report["not_written"] == sorted(lost)


def test_faces_and_colours_of_off_files_stay(tmp_path: Path) -> None:
    (tmp_path / "box.off").write_bytes(GOOD["NCOFF .5 .5 .5 1.off"])
    mesh, _ = filled(tmp_path / "box.off")
    assert mesh.faces.sizes.tolist()[:5] == [4] * 5
    assert mesh.vertex_data["colors"][0].tolist() == [9, 8, 7]
    assert mesh.face_data["colors"][0].tolist() == [0.5, 0.5, 0.5, 1.0]


def test_numbers_that_need_more_than_two_bytes_are_written(tmp_path: Path) -> None:
    (tmp_path / "box.ply").write_bytes(GOOD["ascii.ply"])
    _, write = files.read(tmp_path / "box.ply")
    large = Parts(np.random.default_rng(0).random((70_000, 3)), Polygons(np.array([0, 1, 69_999]), np.array([3])))
    write(tmp_path / "large.ply", large)
    assert np.array_equal(files.read(tmp_path / "large.ply")[0].faces.corners, large.faces.corners)


def test_broken_files_are_rows_of_the_report(tmp_path: Path) -> None:
    """The batch goes on, and nothing but the report is on the standard output."""
    for name, raw in BROKEN.items():
        (tmp_path / name).write_bytes(raw)
    (tmp_path / "box.off").write_bytes(GOOD["plain.off"])
    sources = [tmp_path / name for name in [*BROKEN, "missing.ply", "box.off"]]
    command = [
        sys.executable,
        "-m",
        "fairing",
        "fill",
        *map(str, sources),
        "--into",
        str(tmp_path / "out"),
        "--json",
        "-",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    reports = json.loads(done.stdout)
    assert (done.returncode, "Traceback" in done.stderr) == (3, False)
    assert [report["verdict"] for report in reports] == ["unusable"] * (len(sources) - 1) + ["good"]
    assert all(report["reason"] for report in reports[:-1])


@pytest.mark.parametrize("seed", range(4))
def test_damaged_files_are_read_or_told(seed: int, tmp_path: Path) -> None:
    """Bytes that are cut off, changed or doubled: a mesh that can be worked with, or ValueError, soon."""
    rng = np.random.default_rng(seed)
    for name in rng.permutation([*GOOD])[:60].tolist():
        raw = bytearray(GOOD[name])
        at, other = rng.integers(len(raw), size=2).tolist()
        inserted = [
            bytes(rng.integers(256, size=3).tolist()),
            b"99999999999",
            b"nan",
            b"-1",
            b"\n",
            bytes(raw[other:][:20]),
        ]
        raw[at : at + int(rng.integers(3))] = inserted[int(rng.integers(6))]
        (tmp_path / name).write_bytes(raw[:at] if rng.random() < 0.1 else raw)
        try:
            mesh, write = files.read(tmp_path / name)
        except ValueError as error:
            assert str(tmp_path) in str(error)
            continue
        assert len(mesh.triangles) == len(mesh.sound) > 0
        write(tmp_path / f"again_{name}", mesh)


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian"])
def test_properties_of_a_ply_file_stay(form: str, tmp_path: Path) -> None:
    """Bytes are blended and stay bytes; types, order and comments stay, and elements that are not known."""
    points, triangles = holed()
    plyfile = pytest.importorskip("plyfile")
    header = plyfile.PlyData([], form == "ascii", "<", ["of a scanner"])
    red = np.rint(127 + 120 * points[:, 2]).astype(np.uint8)
    data = {"colors": np.column_stack([red, red, red]), "quality": points[:, 2].astype(np.float32)}
    source = tmp_path / "scan.ply"
    mesh = Parts(points, Polygons.of(triangles), data, {"flags": np.arange(len(triangles))})
    files.ply.write(plyfile, source, mesh, header)
    before = source.read_bytes().partition(b"end_header")[0].decode()
    extra = "element camera 1\nproperty float view_px\nproperty list uchar int ids\n"
    row = b"0.5 2 7 8\n" if form == "ascii" else struct.pack("<fBii", 0.5, 2, 7, 8)
    source.write_bytes(source.read_bytes().replace(b"end_header", extra.encode() + b"end_header") + row)
    mesh, _ = filled(source, "--longest", 20)
    raw = (tmp_path / "out.ply").read_bytes()
    head, _, body = raw.partition(b"end_header\n")
    lines = head.decode().splitlines()
    assert "property uchar red" in lines and "comment of a scanner" in lines and body.endswith(row)
    assert [line for line in lines if "property" in line] == [
        *(x for x in before.splitlines() if "property" in x),
        *extra.splitlines()[1:],
    ]
    new = mesh.points[len(points) :]
    assert len(new) and abs(mesh.vertex_data["red"][len(points) :] - (127 + 120 * new[:, 2])).max() < 3
    assert np.array_equal(mesh.vertex_data["red"][: len(points)], red)
    assert np.array_equal(mesh.face_data["flags"][: len(triangles)], np.arange(len(triangles)))


def test_objects_groups_and_materials_of_an_obj_file_stay(tmp_path: Path) -> None:
    """New faces have those of the nearest; the materials' file is named from another folder."""
    points, triangles = holed()
    left = points[triangles].mean(axis=1)[:, 2] < 0
    lines = ["mtllib m.mtl", *(f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist())]
    for name, mine in (("left", left), ("right", ~left)):
        lines += [f"o {name}", f"g {name} all", f"usemtl {name}", "s off"]
        lines += ["f " + " ".join(map(str, row)) for row in (triangles[mine] + 1).tolist()]
    (tmp_path / "tube.obj").write_text("\n".join(lines))
    (tmp_path / "m.mtl").write_text("newmtl left\nnewmtl right\n")
    target = tmp_path / "out" / "tube.obj"
    status, _ = report_of(tmp_path, "fill", tmp_path / "tube.obj", "-o", target, "--longest", 20)
    now, faces = {}, {"left": [], "right": []}
    for word, *rest in map(str.split, target.read_text().splitlines()):
        now[word] = rest
        if word == "f":
            assert now["usemtl"] == now["o"] == now["g"][:1] and now["g"][1:] == ["all"]
            faces[rest and now["o"][0]].append([int(each) - 1 for each in rest])
    mesh = files.read(target)[0]
    assert status == 0 and (target.parent / now["mtllib"][0]).samefile(tmp_path / "m.mtl")
    assert np.array_equal(mesh.points[: len(points)], points)
    assert len(faces["left"]) > left.sum() and len(faces["right"]) > (~left).sum()
    assert mesh.points[np.concatenate(faces["left"])][:, 2].max() < 0.2


def test_a_seam_goes_on_over_a_hole(tmp_path: Path) -> None:
    """The tube's image ends where it begins, in the hole: no new face reaches over the image, the picture goes on."""
    points, quads = tube()
    across = np.arange(COLUMNS + 1) / COLUMNS
    row, column = np.divmod(np.arange(len(quads)), COLUMNS)
    kept = ~((row >= 6) & (row < 10) & ((column < 2) | (column >= COLUMNS - 2)))
    texture = [f"vt {u!r} {z!r}" for z in (points[::COLUMNS, 2] / 2 + 0.5).tolist() for u in across.tolist()]
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()] + texture
    for quad, i, k in zip(quads[kept].tolist(), column[kept].tolist(), row[kept].tolist(), strict=True):
        first = k * (COLUMNS + 1) + i
        names = zip(quad, (first, first + 1, first + COLUMNS + 2, first + COLUMNS + 1), strict=True)
        lines.append("f " + " ".join(f"{v + 1}/{t + 1}" for v, t in names))
    (tmp_path / "tube.obj").write_text("\n".join(lines))
    before = files.read(tmp_path / "tube.obj")[0]
    mesh, _ = filled(tmp_path / "tube.obj", "--longest", 20)
    assert len(before.points) == len(points) + ROWS_OF_SEAM and mesh.face_data.keys() == before.face_data.keys()
    new = mesh.own[len(before.own) :]
    u = mesh.vertex_data["uv"][new, 0]
    true = np.mod(np.arctan2(mesh.points[new, 1], mesh.points[new, 0]) / (2 * np.pi), 1)
    off = np.abs(np.mod(u - true + 0.5, 1) - 0.5)
    lines = (tmp_path / "out.obj").read_text().splitlines()
    assert sum(line.startswith("v ") for line in lines) == len(np.unique(mesh.points, axis=0))
    assert len(new) > 20 and np.ptp(u, axis=1).max() < 2.5 / COLUMNS
    assert off.max() < 0.02
    assert not len(fairing.borders.hole_loops(mesh.points, mesh.triangles).torn)


ROWS_OF_SEAM = 17 - 3  # the tube's rows of vertices without those inside the hole, which the seam parts


def test_a_seam_goes_on_over_a_fillet() -> None:
    """A tube with a lid, each with an image of its own, and the tube's ends where it begins."""
    angle = 2 * np.pi * np.arange(COLUMNS + 1) / COLUMNS
    side = np.column_stack([np.tile(angle / (2 * np.pi), 2), np.repeat([0.0, 1.0], COLUMNS + 1)])
    at = np.column_stack([np.cos(angle), np.sin(angle)])
    lower, upper = (np.insert(at, 2, z, axis=1) for z in (-1.0, 1.0))
    places = np.concatenate([lower, upper, upper[:-1]])
    places[COLUMNS], places[2 * COLUMNS + 1] = places[0], places[COLUMNS + 1]
    k = np.arange(COLUMNS)
    walls = np.column_stack([k, k + 1, k + COLUMNS + 2, k + COLUMNS + 1])
    lid = 2 * (COLUMNS + 1) + k
    uv = np.concatenate([side, 5 + places[lid, :2]])
    mesh = Parts(places, Polygons.of([*walls, lid]), {"uv": uv})
    made, result = fairing.fillet_edges(mesh, width=0.2)
    u = made.vertex_data["uv"][made.own, 0]
    on_lid = (u > 3).any(axis=1)
    assert result.converged and (u[on_lid] > 3).all() and np.ptp(u[~on_lid], axis=1).max() < 0.1
    found = fairing.borders.hole_loops(made.points, made.triangles)
    assert [len(loop) for loop in found.loops] == [COLUMNS] and not found.torn


def test_objects_of_a_scene_stay(tmp_path: Path) -> None:
    """Two objects share a mesh of two primitives; the hole between these is closed once, and both objects show it."""
    points, triangles = holed()
    scene = trimesh.Scene()
    upper = points[triangles].mean(axis=1)[:, 2] > 0.1
    for name, mine in (("upper", upper), ("lower", ~upper)):
        part = trimesh.Trimesh(points, triangles[mine], process=False)
        part.remove_unreferenced_vertices()
        place = trimesh.transformations.translation_matrix([3, 0, 0])
        if name == "upper":  # mirrored in its file
            part.apply_transform(np.diag([1, 1, -1, 1]))
            place[2, 2] = -1
        scene.add_geometry(part, geom_name=name, node_name=name, transform=place)
    scene.export(str(tmp_path / "tube.glb"))
    mesh, report = filled(tmp_path / "tube.glb", "--longest", 20)
    after = trimesh.load_scene(tmp_path / "out.glb", process=False)
    assert report["verdict"] == "good" and {*after.graph.nodes_geometry} == {"upper", "lower"}
    assert not report["warnings"] and all(part.volume > 0 for part in after.geometry.values())
    assert {*after.geometry} == {"upper", "lower"}
    assert abs(radius(mesh.points - [3, 0, 0]) - 1).max() < 1e-4
    found = fairing.borders.hole_loops(mesh.points, mesh.triangles)
    assert sorted(map(len, found.loops)) == [COLUMNS, COLUMNS] and not found.torn
    _, (report,) = report_of(tmp_path, "fill", tmp_path / "tube.glb", "--format", ".off", "--longest", 20)
    assert report["not_written"] == ["object"]


def test_a_surface_through_other_faces_is_never_good(tmp_path: Path) -> None:
    """A ball lies in the way of a tube's new wall."""
    points, triangles = holed()
    at = np.array([np.cos(0.98), np.sin(0.98), -0.05])  # the middle of the hole
    ball = points * [0.1, 0.1, 0.1]
    mesh = np.concatenate([points, ball + at]), np.concatenate([triangles, split(tube()[1]) + len(points)])
    result = fairing.fill_holes(mesh, longest=20).result
    (warning,) = (each for each in result.warnings if each.code == "SELF_INTERSECTION")
    assert len(warning.elements) > 4
    (tmp_path / "two.off").write_text(odd_files.off(mesh[0], mesh[1]))
    status, (report,) = report_of(tmp_path, "fill", tmp_path / "two.off", "--longest", 20)
    assert (status, report["verdict"]) == (1, "look") and "passes through" in report["reason"]
    assert Path(report["written"]).is_file()


def test_pieces_that_are_wound_the_other_way_are_turned(tmp_path: Path) -> None:
    points, triangles = holed()
    mixed = triangles.copy()
    mixed[100:300] = mixed[100:300, ::-1]
    (new_points, faces), result = fairing.fill_holes((points, mixed), longest=20)
    alike = fairing.fill_holes((points, triangles), longest=20).mesh
    assert np.allclose(new_points, alike[0])
    corners = new_points[faces]
    outwards = np.einsum(
        "ti,ti->t",
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, :2],
        corners.mean(axis=1)[:, :2],
    )
    assert (outwards > 0).all()
    (said,) = (each for each in result.warnings if each.code == "INCONSISTENT_WINDING")
    assert len(said.elements) == 200


@pytest.mark.parametrize("begin", range(6))
def test_a_concave_face_is_cut_within_itself(begin: int) -> None:
    """Whatever its first corner; where it is one."""
    corners = np.roll([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], -begin, axis=0)
    mesh = Parts(np.column_stack([corners, np.zeros(6)]), Polygons.of([range(6)]))
    at = mesh.points[mesh.own]
    areas = np.cross(at[:, 1] - at[:, 0], at[:, 2] - at[:, 0])[:, 2] / 2
    assert len(areas) == 4 and (areas > 0).all() and areas.sum() == pytest.approx(3.0)


def test_each_hole_has_a_row_of_its_own(tmp_path: Path) -> None:
    """Two tubes; at the rim of the second one's hole two fins stand on one edge: the first one's hole is filled."""
    points, triangles = holed()
    count = len(points)
    (rim,) = (loop for loop in fairing.borders.hole_loops(points, triangles).loops if len(loop) == 12)
    places = np.concatenate([points, points + np.array([4, 0, 0]), [[9, 9, 9], [9, 9, 8]]])
    a, b = rim[:2] + count
    faces = np.concatenate([triangles, triangles + count, [[a, b, 2 * count], [b, a, 2 * count + 1]]])
    (tmp_path / "two.off").write_text(odd_files.off(places, faces))
    status, (report,) = report_of(tmp_path, "fill", tmp_path / "two.off", "--longest", 20)
    mesh = files.read(Path(report["written"]))[0]
    first, *others = report["holes"]
    assert (status, report["verdict"], first["verdict"], first["edges"]) == (1, "look", "good", 12)
    assert np.allclose(first["at"], points[rim].mean(axis=0), atol=1e-5)
    assert others and all(each["verdict"] == "unusable" and each["reason"] for each in others)
    assert report["reason"].startswith(f"{len(others)} of {1 + len(others)} holes can't be filled")
    assert abs(radius(mesh.points[len(places) :]) - 1).max() < 1e-4 and len(mesh.points) > len(places)
