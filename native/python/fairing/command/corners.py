"""Values at the corners of faces, as OBJ and some PLY files have them: a vertex for each value, and back."""

from __future__ import annotations

import numpy as np

from fairing.objects.parts import PLACE, Data, Parts, Polygons, alike
from fairing.results import FloatArray, IntArray


def by_vertices(points: FloatArray, faces: Polygons, stores: tuple[Data, Data], at_corners: Data) -> Parts:
    """Parts with a vertex for each value (Σ sizes, c) that a point has at corners; the points keep their order.

    ``stores``: data of points and of faces. What has less than three corners is no face.
    """
    if (faces.sizes < 3).any():
        whole = faces.sizes > 2
        at_corners = {name: values[np.repeat(whole, faces.sizes)] for name, values in at_corners.items()}
        stores = stores[0], {name: values[whole] for name, values in stores[1].items()}
        faces = faces.chosen(whole)
    unused = np.setdiff1d(np.arange(len(points)), faces.corners)
    if not at_corners:
        return Parts(points, faces, *stores)
    rows = np.column_stack([faces.corners, *at_corners.values()]).astype(np.float64)
    every = np.concatenate([rows, np.pad(unused[:, None], ((0, 0), (0, rows.shape[1] - 1)))])
    _, kept, corners = np.unique(every.view(np.int64), axis=0, return_index=True, return_inverse=True)
    order = np.argsort(every[kept, 0], kind="stable")
    made = every[kept[order]]
    places = made[:, 0].astype(np.int32)
    data = {name: values[places] for name, values in stores[0].items()}
    ends = np.cumsum([1, *(values.shape[1] for values in at_corners.values())])
    for (name, values), begin, end in zip(at_corners.items(), ends, ends[1:], strict=False):
        data[name] = made[:, begin:end].astype(values.dtype)
    number = np.argsort(order)[corners.ravel()[: len(rows)]].astype(np.int32)
    return Parts(points[places], Polygons(number, faces.sizes), data | {PLACE: places}, stores[1])


def by_points(parts: Parts) -> tuple[IntArray, IntArray, Data]:
    """(p,) a vertex for each point of a file, in order, (n,) the point of each vertex, and data that all agree on."""
    whole = np.arange(len(parts.points), dtype=np.int32)
    if PLACE not in parts.vertex_data:
        return whole, whole, parts.vertex_data
    places, point = alike(np.column_stack([parts.vertex_data[PLACE], parts.points]))
    others = {name: values for name, values in parts.vertex_data.items() if name != PLACE}
    kept = {name: values[places] for name, values in others.items() if np.array_equal(values[places][point], values)}
    return places, point, kept
