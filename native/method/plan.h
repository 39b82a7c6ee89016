// Which strategies a patch is solved by, and in which order: data, decided before anything is solved.
#pragma once

#include <string>
#include <vector>

#include "method/traits.h"

namespace fairing {

enum class Step {
    // The equation asked for.
    levels,           // from coarse to fine over the user's connectivity (method/nested)
    direct,           // at once on the user's mesh (method/direct)
    own_mesh,         // on a mesh of the engine's own, the vertices placed on it (method/own_mesh)
    uniform_weights,  // all of these with uniform weights, where the problem's turn triangles over
    low_passed,       // on a mesh of the engine's own between loops without their short waves (method/own_mesh)
    lifted_pins,      // the surface without pins, lifted to pins that have a radius (method/pinned)
    // What stands in for it.
    least_variation,  // the surface of least variation, also as the equation asked for
    old_shape,        // the shape before, as smooth as it can be (stand_in/smoothed)
    loft,             // between several loops (stand_in/lofted)
    first_surface,    // where nothing better is found (method/nested)
};

// For the log and for people.
const char* name_of(Step step);

struct Plan {
    std::vector<Step> equation;   // the first surface that is accepted is the answer
    std::vector<Step> stand_ins;  // in their order, where the equation has no surface

    bool operator==(const Plan&) const = default;
};

// "direct, own mesh | least variation".
std::string text_of(const Plan& plan);

// `lifts_pins`: isolated pins may have a radius.
Plan plan_for(const Problem& problem, const Traits& traits, bool lifts_pins);

}  // namespace fairing
