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

}  // namespace fairing
