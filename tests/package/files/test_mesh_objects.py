"""One call for meshes as other libraries hold them; each library is the real one, where it is installed."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import fairing

COLUMNS, ROWS = 32, 16
Arrays = tuple[np.ndarray, np.ndarray]


def tube() -> Arrays:
    """A tube of radius 1 and its quads, counter-clockwise seen from outside."""
    angle, height = np.meshgrid(2 * np.pi * np.arange(COLUMNS) / COLUMNS, np.linspace(-1, 1, ROWS + 1))
    points = np.stack([np.cos(angle), np.sin(angle), height], axis=-1).reshape(-1, 3)
    i, k = (part.ravel() for part in np.meshgrid(np.arange(COLUMNS), np.arange(ROWS)))
    a, b = k * COLUMNS + i, k * COLUMNS + (i + 1) % COLUMNS
    return points, np.column_stack([a, b, b + COLUMNS, a + COLUMNS]).astype(np.int32)


def dented() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The tube with its middle dented, and a mask of the quads there."""
    points, quads = tube()
    row = np.arange(len(quads)) // COLUMNS
    depth = 0.1 * np.clip(1 - (points[:, 2] / 0.375) ** 2, 0, None) ** 2  # no hard edge where it begins
    points[:, :2] *= 1 - depth[:, None]
    return points, quads, (row >= 5) & (row < 11)


def split(quads: np.ndarray) -> np.ndarray:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def holed() -> Arrays:
    """The tube's triangles without some at one place; its ends have 32 edges, the hole 12."""
    points, quads = tube()
    row, column = np.divmod(np.arange(len(quads)), COLUMNS)
    return points, split(quads[~((row >= 6) & (row < 9) & (column >= 4) & (column < 7))])


def test_new_quads_are_faces_of_four_corners() -> None:
    """Those of a tube of quads go on in a hole; libraries that hold triangles alone get two of each."""
    points, quads = tube()
    row, column = np.divmod(np.arange(len(quads)), COLUMNS)
    hole = (row >= 6) & (row < 9) & (column >= 4) & (column < 8)
    mesh, result = fairing.fill_holes((points, quads[~hole]), longest=20, faces="quads")
    assert mesh[1].shape == quads.shape
    assert result.quads is not None and len(result.quads.quads) == hole.sum()
    assert abs(radius(mesh[0]) - 1).max() < 1e-2
    trimesh = pytest.importorskip("trimesh")
    halves = trimesh.Trimesh(
        points, split(quads[~hole]), process=False, face_attributes={"on": np.ones(2 * (~hole).sum())}
    )
    halves.vertex_attributes["normals"] = points  # a name that is not ours to take
    mesh, _ = fairing.fill_holes(halves, longest=20, faces="quads")
    assert len(mesh.faces) == len(mesh.face_attributes["on"]) == 2 * len(quads)
    assert len(mesh.vertex_attributes["normals"]) == len(mesh.vertices)


def radius(points: Any) -> np.ndarray:
    return np.linalg.norm(np.asarray(points)[:, :2], axis=1)


# Each library: how a mesh of it is made, with data at vertices and faces, and read.
class Trimesh:
    def __init__(self) -> None:
        self.library = pytest.importorskip("trimesh")

    def make(self, points: np.ndarray, faces: np.ndarray, at: np.ndarray, on: np.ndarray) -> Any:
        colours = np.column_stack([np.rint(255 * at)] * 3 + [np.full(len(at), 255)]).astype(np.uint8)
        return self.library.Trimesh(
            points, faces, process=False, vertex_attributes={"at": at}, face_attributes={"on": on},
            vertex_colors=colours, metadata={"name": "tube"},
        )  # fmt: skip

    def read(self, mesh: Any) -> tuple[Any, Any, Any, Any]:
        assert type(mesh) is self.library.Trimesh and mesh.metadata["name"] == "tube"
        at = mesh.vertex_attributes["at"]
        assert len(mesh.visual.vertex_colors) == len(at)
        assert abs(mesh.visual.vertex_colors[:, 0] / 255 - at).max() < 0.01
        return mesh.vertices, mesh.faces, at, mesh.face_attributes["on"]


class Pyvista:
    def __init__(self) -> None:
        self.library = pytest.importorskip("pyvista")

    def make(self, points: np.ndarray, faces: np.ndarray, at: np.ndarray, on: np.ndarray) -> Any:
        padded = np.column_stack([np.full(len(faces), faces.shape[1]), faces]).ravel()
        mesh = self.library.PolyData(points, padded)
        mesh.point_data["at"], mesh.cell_data["on"] = at, on
        return mesh

    def read(self, mesh: Any) -> tuple[Any, Any, Any, Any]:
        assert type(mesh) is self.library.PolyData
        faces = mesh.faces.reshape(-1, mesh.faces[0] + 1)[:, 1:] if mesh.is_all_triangles else mesh.irregular_faces
        return mesh.points, faces, mesh.point_data["at"], mesh.cell_data["on"]


class Meshio:
    def __init__(self) -> None:
        self.library = pytest.importorskip("meshio")

    def make(self, points: np.ndarray, faces: np.ndarray, at: np.ndarray, on: np.ndarray) -> Any:
        kind = "triangle" if faces.shape[1] == 3 else "quad"
        half = len(faces) // 2
        cells = [(kind, faces[:half]), ("line", np.array([[0, 1]])), (kind, faces[half:])]
        return self.library.Mesh(points, cells, {"at": at}, {"on": [on[:half], np.array([7]), on[half:]]})

    def read(self, mesh: Any) -> tuple[Any, Any, Any, Any]:
        assert type(mesh) is self.library.Mesh
        pairs = list(zip(mesh.cells, mesh.cell_data["on"], strict=True))
        assert [on.tolist() for block, on in pairs if block.type == "line"] == [[7]]
        blocks = [(block.data, on) for block, on in pairs if block.type != "line"]
        faces, on = (np.concatenate(part) for part in zip(*blocks, strict=True))
        return mesh.points, faces, mesh.point_data["at"], on


class Open3d:
    def __init__(self) -> None:
        self.library = pytest.importorskip("open3d")

    def make(self, points: np.ndarray, faces: np.ndarray, at: np.ndarray, on: np.ndarray) -> Any:
        o3d = self.library
        triangles = faces if faces.shape[1] == 3 else split(faces)
        numbers = on if faces.shape[1] == 3 else np.tile(on, 2)
        mesh = o3d.geometry.TriangleMesh(o3d.utility.Vector3dVector(points), o3d.utility.Vector3iVector(triangles))
        mesh.vertex_colors = o3d.utility.Vector3dVector(np.column_stack([at] * 3))
        mesh.triangle_material_ids = o3d.utility.IntVector(numbers.astype(np.int32))
        mesh.compute_vertex_normals()
        return mesh

    def read(self, mesh: Any) -> tuple[Any, Any, Any, Any]:
        assert type(mesh) is self.library.geometry.TriangleMesh
        normals, triangles = np.asarray(mesh.vertex_normals), np.asarray(mesh.triangles)
        assert normals.shape == np.asarray(mesh.vertices).shape
        assert abs(np.linalg.norm(normals[np.unique(triangles)], axis=1) - 1).max() < 1e-6
        assert np.asarray(mesh.triangle_normals).shape == triangles.shape
        return mesh.vertices, triangles, np.asarray(mesh.vertex_colors)[:, 0], np.asarray(mesh.triangle_material_ids)


LIBRARIES: list[Callable[[], Any]] = [Trimesh, Pyvista, Meshio, Open3d]


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__.lower())
def test_selected_faces_of_a_librarys_mesh(library: Callable[[], Any]) -> None:
    """The tube comes back; numbers and data stay; the mesh given is not touched."""
    host = library()
    points, quads, selected = dented()
    faces, chosen = (quads, selected) if library in (Pyvista, Meshio) else (split(quads), np.tile(selected, 2))
    at, on = points[:, 2] / 2 + 0.5, np.arange(len(faces), dtype=np.int32)
    given = host.make(points, faces, at, on)
    mesh, result = fairing.fair_faces(given, chosen)
    new_points, new_faces, new_at, new_on = host.read(mesh)
    assert result.converged
    assert abs(radius(new_points) - 1).max() < 1e-4
    assert np.array_equal(np.asarray(new_faces), faces)
    assert np.array_equal(new_at, host.read(given)[2]) and np.array_equal(new_on, on)
    assert np.allclose(np.asarray(host.read(given)[0]), points, atol=1e-7)


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__.lower())
def test_holes_of_a_librarys_mesh(library: Callable[[], Any]) -> None:
    """The hole is closed on the tube, its ends stay open; data goes on over it."""
    host = library()
    points, faces = holed()
    at, on = points[:, 2] / 2 + 0.5, np.arange(len(faces), dtype=np.int32)
    mesh, result = fairing.fill_holes(host.make(points, faces, at, on), longest=20)
    new_points, new_faces, new_at, new_on = host.read(mesh)
    count, old = len(points), len(faces)
    assert result.converged and len(result.loops) == 1
    assert abs(radius(new_points) - 1).max() < 1e-4
    assert np.array_equal(np.asarray(new_faces)[:old], faces)
    assert len(new_at) == len(new_points) > count and len(new_on) == len(new_faces) > old
    assert np.allclose(new_at[:count], at, atol=1e-6) and np.array_equal(new_on[:old], on)
    assert abs(new_at[count:] - (np.asarray(new_points)[count:, 2] / 2 + 0.5)).max() < 0.02  # linear along the tube
    rim = np.flatnonzero(np.isin(faces, result.loops[0]).any(axis=1))
    assert np.isin(new_on[old:], rim).all()


@pytest.mark.parametrize("library", [Trimesh, Meshio], ids=lambda kind: kind.__name__.lower())
def test_edges_of_a_librarys_mesh(library: Callable[[], Any]) -> None:
    """A cube with all edges rounded: inside of it, without its corners; each face's data where its faces were."""
    host = library()
    corner = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]], np.int32)
    on = np.tile(np.arange(6, dtype=np.int32), 2)
    mesh, result = fairing.fillet_edges(host.make(corner, split(quads), corner[:, 2], on), width=0.2)
    points, faces, at, new_on = host.read(mesh)
    points = np.asarray(points)
    assert result.converged
    assert points.min() > -1e-9 and points.max() < 1 + 1e-9
    assert len(points) == len(result.vertices)  # the eight corners are gone
    flat = np.array([[0, -1, 0], [0, 1, 1], [1, -1, 0], [1, 1, 1], [2, -1, 0], [2, 1, 1]])[[0, 1, 2, 3, 4, 5]]
    middle = points[np.asarray(faces)].mean(axis=1)
    for number, (axis, _, side) in enumerate(flat):
        mine = middle[np.asarray(new_on) == number]
        assert len(mine) and abs(mine[:, axis] - side).max() < 0.2
    assert abs(at - points[:, 2]).max() < 0.2


def test_arrays_and_polygons() -> None:
    points, quads, selected = dented()
    mesh, result = fairing.fair_faces((points, quads), selected)
    assert np.array_equal(mesh[1], quads) and result.converged
    assert abs(radius(mesh[0]) - 1).max() < 1e-4
    by_number, _ = fairing.fair_faces((points, quads), np.flatnonzero(selected))
    assert np.array_equal(by_number[0], mesh[0])
    mixed = [*quads[:-1].tolist(), quads[-1, :3].tolist(), quads[-1, [0, 2, 3]].tolist()]
    of_lists, _ = fairing.fair_faces((points, mixed), [*selected, False])
    assert [len(face) for face in of_lists[1]] == [len(face) for face in mixed]
    assert abs(radius(of_lists[0]) - 1).max() < 1e-4


def test_a_seam_is_no_border() -> None:
    """Files part vertices where texture coordinates end; the surface goes on, and both copies move alike."""
    points, quads, selected = dented()
    whole, _ = fairing.fair_faces((points, quads), selected)
    first = np.arange(ROWS + 1) * COLUMNS
    number = np.full(len(points), -1)
    number[first] = len(points) + np.arange(ROWS + 1)
    parted = quads.copy()
    last = np.arange(len(quads)) % COLUMNS == COLUMNS - 1
    parted[last] = np.where(number[quads[last]] >= 0, number[quads[last]], quads[last])
    mesh, result = fairing.fair_faces((np.concatenate([points, points[first]]), parted), selected)
    assert result.converged
    assert np.allclose(mesh[0][: len(points)], whole[0], atol=1e-9)
    assert np.array_equal(mesh[0][len(points) :], mesh[0][first])
    assert np.array_equal(mesh[1], parted)
    with pytest.raises(fairing.MeshError, match=r"longest|short|border"):
        fairing.fill_holes((np.concatenate([points, points[first]]), split(parted)), longest=20)


def test_a_mesh_that_is_not_known() -> None:
    for mesh in (np.zeros((3, 3)), "mesh.ply", (np.zeros((3, 3)), [[0, 1]]), (np.zeros((3, 3)), np.zeros((1, 3)))):
        with pytest.raises(ValueError, match=r"mesh|faces"):
            fairing.fair_faces(mesh, [0])


@pytest.mark.parametrize(
    ("selected", "words"),
    [
        ([], "no face"),
        ([9999], "there is no face 9999"),
        ([True, False], "mask of 512"),
        ("wall", "no data"),
        ([0.5], "integers"),
    ],
)
def test_a_selection_that_is_none(selected: Any, words: str) -> None:
    points, quads, _ = dented()
    with pytest.raises(ValueError, match=words):
        fairing.fair_faces((points, quads), selected)


def test_selected_by_a_name(caplog: pytest.LogCaptureFixture) -> None:
    host = Meshio()
    points, quads, selected = dented()
    mesh = host.make(points, quads, points[:, 2], selected.astype(np.int32))
    with caplog.at_level("INFO", logger="fairing"):
        fair, result = fairing.fair_faces(mesh, "on")
    assert abs(radius(fair.points) - 1).max() < 1e-4
    assert any("fair_faces" in line and result.termination in line for line in caplog.messages)
