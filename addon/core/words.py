"""The words for the engine's errors and warnings, by code and case. Plain Python, no bpy."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Words:
    """The sentence for one case of a code; `many` is for several elements or, where it names them, islands.

    Both may have the fields {n} (elements), {first} (a vertex), {ends} (of an edge), {islands}, and all figures.
    """

    one: str
    many: str = ""
    when: str = ""  # the figure that only this case has; the last case of a code has none


DOUBLED = "The new surface doubles back onto faces that stick out into the boundary: delete these first, or select them"
_CROSSING_WIRES = (
    "Edges that were drawn across the hole cross each other, or enclose a place of their own, at vertex {first}: give "
    "them a common vertex, or delete some"
)
_DISSOLVE = "dissolve it, or split that edge there and use Merge by Distance"
SPREAD_UNIFORMLY = "Distribution would turn faces over here: Uniform was used instead"
EDGES_HELD = "Hard edges run through the selection and are held, though not marked: Pin Edges: None rounds them off"
EDGES_LET_GO = "Hard edges that run through the selection are not marked and were let go: no usable surface holds them"
_SLOPE_ONLY = (
    "{vertices:.0f} of the boundary's {outline_vertices:.0f} vertices are met in slope only, not in curvature. "
)

_NO_TENSION = "Tension counts for nothing here: "

WORDS: dict[str, tuple[Words, ...]] = {
    "NONFINITE": (
        Words("The normal at vertex {first} is NaN or infinite", when="normals"),
        Words(
            "Coordinates as large as {largest_coordinate:.0e} overflow when they are added: scale the mesh down",
            when="largest_coordinate",
        ),
        Words(
            "Vertex {first} has a coordinate that is NaN or infinite",
            "{n} vertices, {first} among them, have a coordinate that is NaN or infinite",
        ),
    ),
    "INDEX_RANGE": (Words("A face has a corner that does not exist: the mesh is damaged"),),
    "NONMANIFOLD_EDGE": (
        Words("Two faces lie on the same vertices at the edge {ends}: delete one of them", when="doubled_triangles"),
        Words(DOUBLED, when="doubles"),
        Words(_CROSSING_WIRES, when="wires"),
        Words("More than two faces meet at the edge {ends}: delete the extra ones, or pin both ends"),
    ),
    "NONMANIFOLD_VERTEX": (
        Words(
            "{n} vertices of the boundary, {first} among them, share their place with another one: use Merge by "
            "Distance where the mesh is torn, move them apart where the boundary touches itself",
            when="meeting",
        ),
        Words("A vertex of the boundary lies on its edge {ends} (a T-junction): " + _DISSOLVE, when="on_edge"),
        Words(
            "{on_edges:.0f} vertices of the boundary lie on edges of it, {ends} among them (T-junctions): "
            "dissolve them, or split these edges there and use Merge by Distance",
            when="on_edges",
        ),
        Words(
            "Edges of the boundary cross each other at {n} vertices, {first} among them: move them apart",
            when="crossing",
        ),
        Words(
            "The boundary touches itself or another one at vertex {first}: split it",
            "The boundary touches itself or another one at {n} vertices, {first} among them: split them",
            when="pinches",
        ),
        Words(
            "Free vertex {first} joins several fans of faces: split it, or pin it",
            "{n} free vertices, {first} among them, join several fans of faces: split them, or pin them",
        ),
    ),
    "NOT_ORIENTABLE": (
        Words(
            "The faces have a single side (a Möbius strip) through vertex {first}: "
            "cut them open, or select a part that has two sides"
        ),
    ),
    "NO_BOUNDARY": (
        Words(
            "A closed part of the selection has nothing to hold it and was left as it is: "
            "leave some of its faces unselected, or pin vertices",
            when="left_alone",
        ),
        Words("A part of the selection is held in a single point: pin more of its vertices", when="points"),
        Words("The selection is closed and has nothing to hold it: leave some faces unselected, or pin vertices"),
    ),
    "NO_FREE_VERTICES": (Words("No vertex is free to move: all are on the boundary or pinned"),),
    "ZERO_NORMAL": (
        Words(
            "The surface has no direction at vertex {first}: the faces there have no area, or turn against each other. "
            "Use Merge by Distance, or pin it"
        ),
    ),
    "NOT_A_LOOP": (Words("The boundary to be filled is no loop of border edges: check vertex {first}"),),
    "NOT_A_HOLE": (
        Words(
            "The border of {n} edges through vertex {first} goes around the outside of a flat sheet: "
            "no surface closes it",
            when="endless",
        ),
        Words(
            "The border of {n} edges through vertex {first} runs around the outside of a sheet of faces: "
            "to fill it all the same, select it alone"
        ),
    ),
    "EDGES_LEFT_ALONE": (
        Words(
            "A hard edge ends at the hole, at vertex {first}, and no other one goes on from there: draw an edge "
            "(select two vertices, F) where it is to run",
            "{n} hard edges end at the hole, at vertex {first} and others, and don't go on from there: draw edges "
            "(select two vertices, F) where they are to run",
            when="lonely",
        ),
        Words(
            "{n} hard edges end at the hole, at vertex {first} and others, and may be joined in several ways: draw "
            "edges (select two vertices, F) where they are to run",
            when="ambiguous",
        ),
        Words(
            "{n} hard edges end at the hole, at vertex {first} and others: too many to be joined. Draw edges (select "
            "two vertices, F) where they are to run"
        ),
    ),
    "NO_QUAD_ROWS": (
        Words("The quads are in no rows: edges that stay run through them", when="curves"),
        Words("The quads are in no rows: more than two boundary loops are joined", when="several"),
        Words("The quads are in no rows: the lines beside the seam have no pairs", when="seams"),
        Words("The quads are in no rows: no pattern of them fits the corners of the boundary"),
    ),
    "OUT_OF_PROPORTION": (
        Words(
            "The surface would take about {count:,.0f} new vertices, and {limit:,.0f} are accepted: raise Spacing, or "
            "Vertex Limit"
        ),
    ),
    "NO_SEAM": (Words("There is no seam to round: select the edges, or faces with hard edges between them"),),
    "SEAM_ON_BORDER": (
        Words("The seam lies on an open border, where it has nothing to round on the other side: deselect these edges"),
    ),
    "WIDTH_TOO_LARGE": (
        Words("A width of {width:.4g} leaves nothing of the part with {n} vertices, {first} among them: make it less"),
    ),
    "WIRES_END": (
        Words(
            "A curve of edges ends at vertex {first}: join that end to another curve, or deselect it",
            "Curves of edges end at {n} vertices, {first} among them: join each end to another curve, or deselect it",
        ),
    ),
    "WIRES_CROSS": (
        Words("Edges cross, or lie on each other, at vertex {first}: give them a common vertex, or move them apart"),
    ),
    "NO_CELL": (
        Words(
            "The curve through vertex {first} divides nothing, as one cell lies on both of its sides: deselect it, or "
            "draw edges that divide this cell",
            when="both_sides",
        ),
        Words(
            "The curves through vertex {first} go around openings alone: draw edges across these, or choose Fill "
            "Openings",
            when="openings",
        ),
        Words(
            "The outline of a cell passes vertex {first} twice: draw an edge that divides it",
            when="pinched",
        ),
        Words("No edge without a face is selected: select closed curves of edges"),
    ),
    "UNCLEAR_CELLS": (
        Words(
            "A surface along the curve through vertex {first} would come back to its own other side: deselect it",
            when="one_sided",
        ),
        Words(
            "Edges leave vertex {first} one above the other, so that no surface passes through all of them: part them, "
            "or deselect some"
        ),
    ),
    "NOT_TANGENT": (
        Words(
            "The surface turns back by {degrees:.0f}° at {n} vertex of the boundary: unfold the faces there",
            "The surface turns back by up to {degrees:.0f}° at {n} vertices of the boundary: unfold the faces there",
            when="folded_back",
        ),
        Words(
            "The surface has a kink of {degrees:.0f}° at {n} vertex of the boundary, where its edges are longer than "
            "the wall is thick: subdivide it",
            "The surface has kinks of up to {degrees:.0f}° at {n} vertices of the boundary, where its edges are longer "
            "than the wall is thick: subdivide it",
        ),
    ),
    "LOOPS_NOT_JOINED": (
        Words(
            "The faces around the boundary through vertex {first} are turned over, seen from the others: flip them",
            when="turned",
        ),
        Words(
            "The faces around the boundary through vertex {first} lie between it and the others: delete some of them",
            when="between",
        ),
        Words("No surface joins these boundary loops"),
    ),
    "DEGENERATE_FACE": (
        Words(
            "{n} face has a corner twice and was left out",
            "{n} faces have a corner twice and were left out",
            when="repeated",
        ),
        Words(
            "{n} face between fixed vertices has a corner that is NaN or infinite and was left out",
            "{n} faces between fixed vertices have a corner that is NaN or infinite and were left out",
            when="unbounded",
        ),
        Words("{n} face has a part without area", "{n} faces have a part without area"),
    ),
    "INCONSISTENT_WINDING": (
        Words(
            "{n} face is wound against the others; a copy with one winding was solved",
            "{n} faces are wound against the others; a copy with one winding was solved",
        ),
    ),
    "OPEN_BORDER_IN_SELECTION": (
        Words(
            "{n} vertex on an open border stays where it is; where this is a seam of doubled vertices, "
            "use Merge by Distance first",
            "{n} vertices on an open border stay where they are; where this is a seam of doubled vertices, "
            "use Merge by Distance first",
        ),
    ),
    "NORMALS_FROM_PATCH": (
        Words("The normals at the boundary come from the selection, so the result depends on its present shape"),
    ),
    "NORMALS_OPPOSE_WINDING": (
        Words(
            "The normal at {n} vertex of the boundary points to the faces' back: turn it round, or flip the faces",
            "The normals at {n} vertices of the boundary point to the faces' back: turn them round, or flip the faces",
        ),
    ),
    "PIN_NORMAL_IGNORED": (
        Words(
            "{n} pinned vertex has no pinned neighbour: its position counts, its normal doesn't",
            "{n} pinned vertices have no pinned neighbour: their position counts, their normal doesn't",
        ),
    ),
    "SHARP_BOUNDARY": (
        Words(
            "The normals along the boundary turn by up to {degrees:.0f}° from one vertex to the next; "
            "a finer boundary gives a more accurate surface"
        ),
    ),
    "FLIPPED_TRIANGLES": (
        Words("{n} face of the result is turned over", "{n} faces of the result are turned over", when="triangles"),
        Words(SPREAD_UNIFORMLY),
    ),
    "FOLDED": (
        Words(
            "The surface was found, but {n} face can't be placed on it without folds",
            "The surface was found, but {n} faces can't be placed on it without folds",
        ),
    ),
    "SELF_INTERSECTION": (
        Words(
            "{n} face of the result passes through others of the selection",
            "{n} faces of the result pass through others of the selection",
        ),
    ),
    "REFERENCE_UNUSABLE": (
        Words(
            "Some faces of the selection have no area, so that no skin can be read off it: the result is smooth. "
            "Merge vertices by distance first",
            when="old_skin",
        ),
        Words(
            "Some faces of the sample have no area, so that no skin can be copied: the result is smooth. "
            "Leave them out of Detail From",
            when="sample_skin",
        ),
        Words(
            "{n} face is a needle or turned over, so that no spacing can be read off the mesh: Uniform was used",
            "{n} faces are needles or turned over, so that no spacing can be read off the mesh: Uniform was used",
        ),
    ),
    "NOT_CONVERGED": (
        Words(
            "An island of {free_vertices:.0f} free vertices has a surface with {load_share:.0%} of its bulge; "
            "there may be none with more",
            "{islands} islands, of {free_vertices:.0f} free vertices in all, have surfaces with {load_share:.0%} of "
            "their bulge at most; there may be none with more",
            when="load_share",
        ),
        Words(
            "An island of {free_vertices:.0f} free vertices collapsed to a point or a line: "
            "pin more vertices around it",
            "{islands} islands, of {free_vertices:.0f} free vertices in all, collapsed to points or lines: "
            "pin more vertices around them",
            when="area",
        ),
        Words(
            "An island of {free_vertices:.0f} free vertices runs into its boundary from behind at {from_behind:.0f} of "
            "{outline_vertices:.0f} vertices: where little of a shape is left outside, leave more of it",
            "{islands} islands, of {free_vertices:.0f} free vertices in all, run into their boundaries from behind at "
            "{from_behind:.0f} of {outline_vertices:.0f} vertices: where little of a shape is left outside, leave "
            "more of it",
            when="from_behind",
        ),
        Words(
            "No fair surface was found for an island of {free_vertices:.0f} free vertices",
            "No fair surface was found for {islands} islands, of {free_vertices:.0f} free vertices in all",
        ),
    ),
    "NO_SOLUTION": (
        Words(
            "No surface meets the jagged boundary: it follows it smoothly, up to {distance:.1%} of its size off",
            when="distance",
        ),
        Words(
            "No fair surface fits these boundary loops: the old shape was smoothed as far as it goes",
            when="smoothed",
        ),
        Words(
            "No surface of Least Variation passes through these curves, as through rough ones: a thin plate was taken, "
            "which bends more",
            when="plate",
        ),
        Words("No fair surface was found: a smooth one was taken at once, and is kept", when="bilaplacian"),
        Words(
            "No fair surface fits these boundary loops: a loft joins them, with a kink at {n} vertex",
            "No fair surface fits these boundary loops: a loft joins them, with a kink at {n} vertices",
            when="kinks",
        ),
        Words("No fair surface fits these boundary loops: a loft joins them", when="loft"),
        Words("No harmonic surface fits the boundary: Least Variation was used", when="harmonic"),
        Words("No surface of that shape fits the boundary: Least Variation was used"),
    ),
    "PRECISION": (Words("This far from the origin, coordinates are too coarse: move the object nearer to it"),),
    "G2_NOT_MET": (
        Words(
            _SLOPE_ONLY + "The curvature around it looks like noise: smooth the surroundings, or grow the selection",
            when="smooth_share",
        ),
        Words(
            _SLOPE_ONLY + "The search for a surface with the curvature did not converge: grow or shrink the selection",
            when="not_found",
        ),
        Words(
            _SLOPE_ONLY + "The faces are too irregular to measure the curvature of the new surface: Remesh first",
            when="own_mesh",
        ),
        Words(
            _SLOPE_ONLY + "No surface with that slope was found to begin with: see the other messages",
            when="no_tangent_join",
        ),
        Words(
            _SLOPE_ONLY + "Too little of the curvature is known outside: leave three rings of regular faces around it"
        ),
    ),
    "TENSION_NOT_MET": (
        Words(_NO_TENSION + "lone pinned vertices have no slope to carry", when="lone_pins"),
        Words(_NO_TENSION + "a surface that finds its slope at edges or borders has none", when="other_equation"),
        Words(_NO_TENSION + "the faces are too irregular for it: Remesh first", when="own_mesh"),
        Words(_NO_TENSION + "no surface was found to begin with: see the other messages", when="no_tangent_join"),
        Words(_NO_TENSION + "no surface with it was found: choose one nearer to 1"),
    ),
    "PINS_NOT_SPREAD": (
        Words(
            "The surface forms a spike at {n} pinned vertex: move it nearer, or pin more around it",
            "The surface forms a spike at {n} pinned vertices: move them nearer, or pin more around them",
            when="tips",
        ),
        Words(
            "{n} pin acts in a point: pins are nearer to each other than two radii, so make the radius smaller",
            "{n} pins act in points: some are nearer to each other than two radii, so make the radius smaller",
            when="close",
        ),
        Words("{n} pin acts in a point, not over its radius", "{n} pins act in points, not over their radius"),
    ),
    "OUTLINE_KEPT": (
        Words(
            "Smooth Boundary was left out: with {n} boundary vertex moved, the result is worse",
            "Smooth Boundary was left out: with {n} boundary vertices moved, the result is worse",
            when="worse",
        ),
        Words(
            "{n} vertex of a noisy boundary keeps its place",
            "{n} vertices of a noisy boundary keep their place",
        ),
    ),
}


def counted(count: int, one: str, many: str) -> str:
    """Return the number with the phrase that goes with it."""
    return f"{count} {one if count == 1 else many}"
