// Knobs: where a disc bends much like a ball and much like a saddle, too.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// Whether it has one boundary loop, no handle and no pins.
bool is_plain_disc(const Patch& patch);

// By Gauss and Bonnet a boundary with its slopes settles the integral of the Gaussian curvature over a disc. A surface
// that does no more than it must has one sign of it nearly everywhere; a knob on a neck adds as much of both.
struct Knobs {
    double extent = 0.0;  // by how much, of 2π, the surface bends both like a ball and like a saddle
    Indices tops;         // of knobs: the most bent vertices, which make up half of the turn
};

// Of a surface (3 × local vertices). None where the patch is no disc or has pins. Tops only where the extent is more
// than `least_knob` and `calmer` of what it was `before`.
Knobs knobs_of(const Patch& patch, const Points& points, double before);

// Surfaces that sink below the lines that run on across them: a ridge, a bevel or a handle that loses its girth.
struct Sunken {
    double depth = 0.0;  // below the lines, of their length, in the median; not above 0 where it lies above them
    Indices deepest;     // vertices where it is as deep as that or deeper
};

// Lines run over the patch from vertex to vertex of its boundary, as cubics that leave both along the tangent planes
// there: only those that go straight on. `normals`: of the surroundings, at the fixed vertices. Of a surface (3 × local
// vertices); nothing where the patch is no disc, has pins, or hardly any such line.
Sunken sunken_of(const Patch& patch, const Points& points, const Points& normals);

}  // namespace fairing
