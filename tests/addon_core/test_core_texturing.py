"""Colours for new faces: closed forms, whatever the triangles, the seams and the places of the faces on the image."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import fairing
from core.boundary_colours import Picture
from core.colours import Coding
from core.grain import Grain
from core.texels import MARGIN, Window, spread
from core.textured_mesh import TexturedMesh
from core.texturing import NOTHING_AROUND, Textured, textured

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
LIGHT = Coding(srgb=False, straight=False, clipped=False)
BYTES = Coding(srgb=True, straight=True, clipped=True)
SIZE = 256  # texels
LOW, HIGH = 0.1, 0.7  # where the sheet lies on the image

Field = Callable[[Floats, Floats], Floats]


def sheet(cells: int = 12, seed: int = 0, turned: bool = True) -> tuple[Floats, NDArray[np.int64]]:
    """(n, 2) in the unit square, shaken inside, and triangles whose diagonals go either way."""
    rng = np.random.default_rng(seed)
    steps = np.linspace(0.0, 1.0, cells + 1)
    points = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    inside = (np.abs(points - 0.5) < 0.49).all(axis=1)
    points[inside] += rng.uniform(-0.25, 0.25, (np.count_nonzero(inside), 2)) / cells
    row, column = np.divmod(np.arange(cells**2), cells)
    a = row * (cells + 1) + column
    b, c, d = a + 1, a + cells + 2, a + cells + 1
    other = (rng.random(cells**2) < 0.5)[:, None] & turned
    first = np.where(other, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(other, np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return points, np.concatenate([first, second])


def textured_sheet(cells: int = 12, seed: int = 0) -> TexturedMesh:
    """A flat sheet with a hole of new triangles in its middle, as large on the image as around."""
    points, triangles = sheet(cells, seed)
    new = (np.abs(points[triangles].mean(axis=1) - 0.5) < 0.25).all(axis=1)
    places = SIZE * (LOW + (HIGH - LOW) * points[triangles])
    space = np.column_stack([points @ [[3.0, 0.0], [0.0, 3.0]], np.zeros(len(points))])
    return TexturedMesh(space, triangles, places, np.zeros(len(triangles), np.int64), new)


def centres() -> tuple[Floats, Floats]:
    """The places on the sheet of all texels."""
    steps = ((np.arange(SIZE) + 0.5) / SIZE - LOW) / (HIGH - LOW)
    x, y = np.meshgrid(steps, steps)
    return x, y


def picture_of(field: Field, mesh: TexturedMesh, coding: Coding = LIGHT) -> Picture:
    """The field in all channels where old triangles are, and something else elsewhere."""
    x, y = centres()
    light = np.repeat(field(x, y)[..., None], 4, axis=2)
    light[..., 3] = 1.0
    light[~covered(mesh, ~mesh.new)] = [1.0, 0.0, 1.0, 1.0]
    stored = coding.encoded(light)
    return Picture((np.round(stored * 255) / 255 if coding.clipped else stored).astype(np.float32), coding)


def covered(mesh: TexturedMesh, of: Mask) -> Mask:
    """The texels with their centres in these triangles, by a test of all pairs near."""
    found = np.zeros((SIZE, SIZE), dtype=bool)
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    for corners in mesh.places[of]:
        low, high = np.floor(corners.min(axis=0)).astype(int), np.ceil(corners.max(axis=0)).astype(int)
        part = np.s_[low[1] : high[1] + 1, low[0] : high[0] + 1]
        to = corners - np.stack([x[part], y[part]], axis=-1)[..., None, :]
        ahead = np.roll(to, -1, axis=2)
        turns = to[..., 0] * ahead[..., 1] - to[..., 1] * ahead[..., 0]
        found[part] |= (turns > 0).all(axis=2) | (turns < 0).all(axis=2)
    return found


def error(result: Textured, field: Field, mesh: TexturedMesh) -> float:
    """The largest difference at texels of new triangles that did not move."""
    x, y = centres()
    inside = covered(mesh, mesh.new)
    assert np.count_nonzero(inside) > 1000
    return float(np.abs(result.pixels[0][inside, 0] - field(x, y)[inside]).max())


def ramp(x: Floats, y: Floats) -> Floats:
    return 0.2 + 0.5 * x - 0.3 * y * 0.5


def saddle(x: Floats, y: Floats) -> Floats:
    return 0.5 + (x - 0.4) ** 2 - (y - 0.5) ** 2


def wave(x: Floats, y: Floats) -> Floats:
    """Harmonic: z⁴, three turns around the middle of the hole."""
    z = 2.0 * (x - 0.5 + 1j * (y - 0.5))
    return 0.5 + 0.5 * np.real(z**4)


def test_a_ramp_goes_on() -> None:
    mesh = textured_sheet()
    picture = picture_of(ramp, mesh)
    result = textured(mesh, [picture])
    assert not result.moved.any()
    assert error(result, ramp, mesh) < 1e-5
    old = covered(mesh, ~mesh.new)
    assert np.array_equal(result.pixels[0][old], picture.pixels[old])


def test_a_ramp_of_light_goes_on_in_bytes() -> None:
    """To the last step of what sRGB stores."""
    mesh = textured_sheet()
    picture = picture_of(ramp, mesh, BYTES)
    result = textured(mesh, [picture])
    x, y = centres()
    inside = covered(mesh, mesh.new)
    wanted = BYTES.encoded(np.stack([ramp(x, y)] * 3 + [np.ones_like(x)], axis=-1))[inside, 0]
    assert np.abs(result.pixels[0][inside, 0] - wanted).max() < 1.0 / 255.0


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("cells", [4, 12, 48])
@pytest.mark.parametrize("field", [saddle, wave])
def test_harmonic_fields_go_on(field: Field, cells: int, seed: int) -> None:
    """However few triangles there are, and however they are cut."""
    mesh = textured_sheet(cells, seed)
    result = textured(mesh, [picture_of(field, mesh)])
    assert error(result, field, mesh) < 0.5 / 255.0


def test_detail_of_the_boundary_alone_reaches_inwards() -> None:
    """Noise around dies away within some texels, and no colour leaves the range of what is around by much."""
    mesh = textured_sheet()
    noise = np.random.default_rng(2).normal(size=(SIZE, SIZE))
    result = textured(mesh, [picture_of(lambda x, y: 0.5 + 0.1 * noise, mesh)])
    x, y = centres()
    deep = (np.abs(x - 0.5) < 0.15) & (np.abs(y - 0.5) < 0.15)
    assert np.abs(result.pixels[0][deep, 0] - 0.5).max() < 0.03
    assert np.abs(result.pixels[0][covered(mesh, mesh.new), 0] - 0.5).max() < 0.4


def test_colours_are_read_from_one_island_only() -> None:
    """Half a texel from it lies another one, in a colour of its own; and nothing of the new part's place is read."""
    mesh = textured_sheet()
    picture = picture_of(ramp, mesh)
    strip = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]) * [60.0, 12.0]
    other = mesh.places[mesh.new].reshape(-1, 2).min(axis=0) + strip
    count = len(mesh.points)
    beside = TexturedMesh(
        np.concatenate([mesh.points, [[9.0, 9.0, 9.0], [9.5, 9.0, 9.0], [9.0, 9.5, 9.0]]]),
        np.concatenate([mesh.triangles, [[count, count + 1, count + 2]]]),
        np.concatenate([mesh.places, other[None]]),
        np.append(mesh.image, 0),
        np.append(mesh.new, False),
    )
    result = textured(beside, [picture])
    assert result.moved.all()
    at, colours = in_place(beside, result)
    assert np.abs(colours[:, 0] - ramp(*at.T)).max() < 0.01
    magenta = fairing.texel_owners(other[None], SIZE, SIZE)[0] >= 0
    assert np.array_equal(result.pixels[0][magenta], picture.pixels[magenta])
    old = covered(mesh, ~mesh.new)
    assert np.array_equal(result.pixels[0][old], picture.pixels[old])


def in_place(mesh: TexturedMesh, result: Textured) -> tuple[Floats, Floats]:
    """(m, 2) where the middles of new triangles are on the sheet, and (m, 4) the colours at the texels there."""
    at = mesh.points[mesh.triangles[mesh.chosen]].mean(axis=1)[:, :2] / 3.0
    x, y = np.floor(result.places.mean(axis=1)).astype(int).T
    return at, result.pixels[0][y, x]


def crowded(mesh: TexturedMesh, free: float) -> TexturedMesh:
    """The mesh with its new part laid over the old one, and a square of that width left free on the image."""
    places = mesh.places.copy()
    places[mesh.new] = mesh.places[mesh.new] - [60.0, 0.0]
    count = len(mesh.points)
    wall = [[[0, 0], [SIZE, 0], [SIZE, SIZE - free]], [[0, 0], [SIZE, SIZE - free], [0, SIZE - free]]]
    wall += [
        [[free, SIZE - free], [SIZE, SIZE - free], [SIZE, SIZE]],
        [[free, SIZE - free], [SIZE, SIZE], [free, SIZE]],
    ]
    far = np.full((3, 3), 50.0) + np.eye(3)
    return TexturedMesh(
        np.concatenate([mesh.points, far]),
        np.concatenate([mesh.triangles, np.tile([count, count + 1, count + 2], (4, 1))]),
        np.concatenate([places, np.array(wall, dtype=float)]),
        np.append(mesh.image, np.zeros(4, dtype=np.int64)),
        np.append(mesh.new, np.zeros(4, dtype=bool)),
    )


def test_where_room_is_short_new_faces_get_fewer_texels() -> None:
    """A quarter as wide is enough for a harmonic colour; and the texels are where the free square is."""
    mesh = textured_sheet()
    wide = np.ptp(mesh.places[mesh.new], axis=(0, 1))
    result = textured(crowded(mesh, 48.0), [picture_of(ramp, mesh)])
    assert np.ptp(result.places, axis=(0, 1)) == pytest.approx(wide / 4.0)
    assert result.places[..., 0].max() < 48.0 and result.places[..., 1].min() > SIZE - 48.0
    at, colours = in_place(mesh, result)
    assert np.abs(colours[:, 0] - ramp(*at.T)).max() < 0.02


def test_without_room_nothing_is_done() -> None:
    mesh = textured_sheet()
    with pytest.raises(ValueError, match="no free part for"):
        textured(crowded(mesh, 24.0), [picture_of(ramp, mesh)])


def test_folded_places_are_laid_out_anew() -> None:
    """The new part's places are folded over, so that two parts of it would share their texels."""
    mesh = textured_sheet()
    places = mesh.places.copy()
    middle = 0.5 * SIZE * (LOW + HIGH)
    places[mesh.new, :, 0] = middle - np.abs(places[mesh.new][..., 0] - middle)
    result = textured(replace(mesh, places=places), [picture_of(ramp, mesh)])
    assert result.moved.all()
    _, count = fairing.texel_owners(result.places, SIZE, SIZE)
    assert count == np.count_nonzero(fairing.texel_owners(result.places, SIZE, SIZE)[0] >= 0)
    at, colours = in_place(mesh, result)
    assert np.abs(colours[:, 0] - ramp(*at.T)).max() < 0.01


def test_a_round_new_part_without_places_is_laid_out_in_pieces() -> None:
    """A whole ball but for a cap, as large on the image as on the surface, and no piece over another one."""
    points, triangles = ball()
    new = points[triangles].mean(axis=1)[:, 2] > -0.8
    places = np.zeros((len(triangles), 3, 2))
    texel = 0.02
    places[~new] = 40.0 + points[triangles[~new]][..., :2] / texel
    mesh = TexturedMesh(points, triangles, places, np.zeros(len(triangles), np.int64), new)
    picture = Picture(np.full((512, 512, 4), 0.25, dtype=np.float32), LIGHT)
    result = textured(mesh, [picture])
    owners, count = fairing.texel_owners(result.places, 512, 512)
    assert count == np.count_nonzero(owners >= 0)
    surface = mesh.areas(mesh.chosen)[0].sum() / texel**2
    assert 0.6 * surface < count < surface
    assert np.abs(result.pixels[0] - 0.25).max() < 1e-6


def ball(rings: int = 24) -> tuple[Floats, NDArray[np.int64]]:
    """A unit ball of quads in halves, its poles closed by fans."""
    count = 2 * rings
    lift, turn = np.meshgrid(np.pi * np.arange(1, rings) / rings, 2 * np.pi * np.arange(count) / count, indexing="ij")
    rows = np.stack([np.sin(lift) * np.cos(turn), np.sin(lift) * np.sin(turn), np.cos(lift)], axis=-1).reshape(-1, 3)
    points = np.concatenate([rows, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    i, j = np.divmod(np.arange((rings - 2) * count), count)
    a, b = i * count + j, i * count + (j + 1) % count
    step = np.arange(count)
    last = (rings - 2) * count
    north = np.stack([step, (step + 1) % count, np.full(count, len(rows))], axis=1)
    south = np.stack([last + (step + 1) % count, last + step, np.full(count, len(rows) + 1)], axis=1)
    between = [np.stack([a, a + count, b + count], axis=1), np.stack([a, b + count, b], axis=1)]
    return points, np.concatenate([*between, north, south])


def test_what_hangs_together_with_nothing_textured_is_left() -> None:
    mesh = textured_sheet()
    count = len(mesh.points)
    alone = TexturedMesh(
        np.concatenate([mesh.points, mesh.points[:3] + 9.0]),
        np.concatenate([mesh.triangles, [[count, count + 1, count + 2]]]),
        np.concatenate([mesh.places, mesh.places[:1]]),
        np.append(mesh.image, 0),
        np.append(mesh.new, True),
    )
    result = textured(alone, [picture_of(ramp, mesh)])
    assert np.flatnonzero(result.left).tolist() == [len(mesh.chosen)]
    with pytest.raises(ValueError, match=NOTHING_AROUND):
        textured(replace(mesh, new=np.ones(len(mesh.new), dtype=bool)), [picture_of(ramp, mesh)])


def test_two_images_share_one_surface() -> None:
    """The left half is on one of them, the right half on the other; the ramp runs on over both."""
    mesh = textured_sheet()
    image = (mesh.points[mesh.triangles].mean(axis=1)[:, 0] > 1.5).astype(np.int64)
    mesh = replace(mesh, image=image)
    left = replace(mesh, new=mesh.new | (image == 1))
    right = replace(mesh, new=mesh.new | (image == 0))
    result = textured(mesh, [picture_of(ramp, left), picture_of(ramp, right)])
    x, y = centres()
    for number in (0, 1):
        inside = covered(mesh, mesh.new & (image == number))
        assert np.abs(result.pixels[number][inside, 0] - ramp(x, y)[inside]).max() < 1e-5


@pytest.mark.parametrize("coding", [LIGHT, BYTES, Coding(False, True, True), Coding(True, False, True)])
def test_colours_come_back_as_they_were_stored(coding: Coding) -> None:
    stored = np.random.default_rng(0).uniform(0.01, 1.0, (50, 4)).astype(np.float32)
    assert np.abs(coding.encoded(coding.decoded(stored)) - stored).max() < 1e-6


def test_light_is_not_what_srgb_stores() -> None:
    stored = np.array([[0.5, 0.02, 1.0, 1.0], [0.5, 0.5, 0.5, 0.5]], dtype=np.float32)
    assert BYTES.decoded(stored)[0] == pytest.approx([0.2140411, 0.02 / 12.92, 1.0, 1.0])
    assert BYTES.decoded(stored)[1] == pytest.approx([0.10702, 0.10702, 0.10702, 0.5], rel=1e-4)
    assert BYTES.encoded(np.array([[2.0, -1.0, 0.0, 1.0]]))[0] == pytest.approx([1.0, 0.0, 0.0, 1.0], abs=1e-6)


def test_transparent_colours_count_for_nothing() -> None:
    """Around one half is clear, with red in its colours, the other opaque and green: no red appears."""
    mesh = textured_sheet()
    x, _ = centres()
    pixels = np.where((x < 0.5)[..., None], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 1.0]).astype(np.float32)
    result = textured(mesh, [Picture(pixels, BYTES)])
    found = result.pixels[0][covered(mesh, mesh.new)]
    assert found[:, 0].max() == 0.0
    assert found[found[:, 3] > 0.01, 1] == pytest.approx(1.0, abs=1e-4)
    assert found[:, 3].min() < 0.1 and found[:, 3].max() > 0.9


def test_a_margin_is_coloured_but_not_over_others() -> None:
    """As far as filters reach; half of the way to what is another's."""
    colours = np.zeros((12, 12, 4))
    known, taken = np.zeros((12, 12), dtype=bool), np.zeros((12, 12), dtype=bool)
    known[:, :3], taken[:, 8:] = True, True
    colours[known] = [0.1, 0.2, 0.3, 1.0]
    found = spread(colours, known, taken)
    assert found[:, :5].all() and not found[:, 5:].any()
    assert np.abs(colours[:, :5] - [0.1, 0.2, 0.3, 1.0]).max() < 1e-12
    taken[:] = False
    assert spread(colours, known, taken)[:, : 3 + MARGIN].all()
    assert not spread(colours, known, taken)[:, 3 + MARGIN :].any()


def test_grain_has_the_spread_and_the_waves_of_its_source() -> None:
    rng = np.random.default_rng(3)
    noise = rng.normal(size=(200, 200, 3))
    smooth = noise + np.roll(noise, 1, axis=1)  # neighbours along rows are alike by a half
    _, x = np.mgrid[:200, :200] / 200.0
    pixels = np.concatenate([0.5 + 0.02 * smooth + x[..., None], np.ones((200, 200, 1))], axis=2).astype(np.float32)
    mask = np.zeros((200, 200), dtype=bool)
    mask[20:180, 30:190] = True
    source = Grain.of(pixels, mask)
    assert source is not None
    grain = source.on(Window(3, 5, 150, 170), 1)
    assert grain.shape == (170, 150, 3)
    assert abs(grain.mean()) < 0.002
    assert grain.std() == pytest.approx(0.02 * np.sqrt(2.0), rel=0.1)

    def alike(axis: int) -> float:
        return float((grain * np.roll(grain, 1, axis=axis)).mean() / grain.var())

    assert alike(1) == pytest.approx(0.5, abs=0.12)
    assert abs(alike(0)) < 0.12
    assert np.array_equal(grain, source.on(Window(3, 5, 150, 170), 1))


def test_grain_comes_from_the_mask_alone() -> None:
    rng = np.random.default_rng(3)
    pixels = np.ones((100, 100, 4), dtype=np.float32)
    mask = np.zeros((100, 100), dtype=bool)
    mask[10:60, 10:60] = True
    pixels[mask, :3] = 0.5 + 0.01 * rng.normal(size=(2500, 3))
    source = Grain.of(pixels, mask)
    assert source is not None
    assert np.abs(source.on(Window(0, 0, 90, 90), 1)).max() < 0.08
    mask[:] = False
    mask[10:20, 10:90] = True
    assert Grain.of(pixels, mask) is None


def test_detail_is_looked_for_further_away_where_there_is_little_around() -> None:
    """Around a small new part the images of old triangles are too narrow; those further away are wide."""
    mesh = textured_sheet(48)
    middle = np.linalg.norm(mesh.points[mesh.triangles].mean(axis=1) - [1.5, 1.5, 0.0], axis=1)
    mesh = replace(mesh, new=middle <= np.sort(middle)[1])
    noise = np.random.default_rng(2).normal(size=(SIZE, SIZE))
    picture = picture_of(lambda x, y: 0.5 + 0.1 * noise, mesh)
    assert not np.array_equal(textured(mesh, [picture], 1.0).pixels[0], textured(mesh, [picture]).pixels[0])
    samples = [np.count_nonzero(sample) for sample in mesh.samples()]
    assert len(samples) > 3 and sorted(samples) == samples and samples[-1] == np.count_nonzero(~mesh.new)


def test_a_stretched_place_is_laid_out_anew_where_it_finds_no_room() -> None:
    """One corner of the new part is thrown across the image; as large as on the surface there is room."""
    mesh = textured_sheet()
    places = mesh.places.copy()
    corner = mesh.triangles == mesh.triangles[mesh.chosen[0], 0]
    places[corner & mesh.new[:, None]] = [SIZE - 1.0, 3.0]
    result = textured(replace(mesh, places=places), [picture_of(ramp, mesh)])
    assert result.moved.all()
    assert np.ptp(result.places, axis=(0, 1)).max() < 0.6 * (HIGH - LOW) * SIZE
    at, colours = in_place(mesh, result)
    assert np.abs(colours[:, 0] - ramp(*at.T)).max() < 0.02
