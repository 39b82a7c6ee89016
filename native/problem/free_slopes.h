// Boundary loops and curves at which the surface finds its own slope.
#pragma once

#include "problem/problem.h"

namespace fairing {

// The equation for a patch whose fixed vertices may be free in their slope. Δ_B H = 0 needs the slope everywhere along
// curves. Where a curve of pins leaves it free, the surface of least variation is taken: its natural conditions at such
// a curve keep planes, spheres and circular cylinders. Inside a single loop without any slope these are as many as
// there are spheres through a circle: the soap film is taken, a flat disc over a flat loop. Pins without fixed
// neighbours leave the equation as it is.
Equation equation_for(const Patch& patch, Equation asked);

// The problem with slopes at its pins, read off the surface (3 × local vertices), for stages that need slopes.
Problem with_slopes_of(const Problem& problem, const Points& points);

// The same, where a loop has given normals too: by how much these turn about the border away from the surface's is
// carried on along the loop.
Problem with_slopes_carried_on(const Problem& problem, const Points& points);

}  // namespace fairing
