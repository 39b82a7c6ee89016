// Which strategies a patch is solved by, and in which order: data, decided before anything is solved.
#pragma once

#include "base/shared.h"
#include "problem/problem.h"

namespace fairing {

// Computed once for each problem, which it refers to.
class Traits {
public:
    explicit Traits(const Problem& problem);

    bool is_large;    // solved from coarse to fine
    bool is_tube;     // two boundary loops: several surfaces may fit, and a coarser mesh may lead from one to another
    bool has_levels;  // large, or between smooth loops that determine one surface, where coarse levels pay earlier
    // Curvature varies so much along the boundary that noise or folds of the surroundings must be the cause.
    bool is_jagged;
    // It varies so much that no surface has met such a boundary.
    bool is_beyond_reach;
    // Over smooth short loops a far coarser level begins.
    bool begins_small;

    // Several loops, each of them the end of a tube (shape/girth): their surface of least variation keeps its girth.
    bool is_between_tubes;

    // Only several loops hold the patch, and its old shape is known, which can replace a surface that is not found.
    bool has_old_shape;

    // The problem between loops without their short waves.
    [[nodiscard]] const Problem& low_passed() const { return *low_passed_; }
    // Share of poor triangles of the membrane by uniform weights. Of random patches between several real loops, 15 of
    // 113 with a larger share than 1/50 had a harmonic surface, and 80 of 128 with less.
    [[nodiscard]] double poor_share_of_membrane() const { return *poor_share_; }

private:
    Deferred<double> poor_share_;
    Deferred<Problem> low_passed_;
};

// The problem between loops without their short waves (boundary/low_passed_boundary).
Problem low_passed(const Problem& problem);

// The largest distance from the loops to the low-passed ones, units of D.
double distance_of_low_passed(const Problem& problem);

enum class Step {
    // The equation asked for.
    levels,           // from coarse to fine over the user's connectivity (method/nested)
    direct,           // at once on the user's mesh (method/direct)
    proxy_mesh,       // on a mesh of the engine's own, the vertices projected onto it (method/proxy_surface)
    uniform_weights,  // all of these with uniform weights, where the problem's turn triangles over
    low_passed,       // on a mesh of the engine's own between loops without their short waves (method/proxy_surface)
    // What stands in for it.
    least_variation,  // the surface of least variation, also as the equation asked for
    old_shape,        // the shape before, as smooth as it can be (stand_in/stand_in)
    loft,             // between several loops (stand_in/stand_in)
    first_surface,    // where nothing better is found (method/nested)
};

// For the log and for people.
const char* name_of(Step step);

struct Plan {
    std::vector<Step> equation;   // the first surface that is accepted is the answer
    std::vector<Step> stand_ins;  // in their order, where the equation has no surface

    bool operator==(const Plan&) const = default;
};

// "direct, proxy mesh | least variation".
std::string text_of(const Plan& plan);

Plan plan_for(const Problem& problem, const Traits& traits);

}  // namespace fairing
