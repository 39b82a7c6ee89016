// How many new vertices a surface may take: what is out of proportion is refused before it is made.
#pragma once

#include "base/types.h"

namespace fairing {

struct Limit {
    double flat;     // about how many there would be over flat surfaces
    double most;     // of the new vertices
    bool is_chosen;  // by the caller

    // `asked`: the caller's; 0: `out_of_proportion` times as many as over flat surfaces, within bounds.
    static Limit of(double flat, int asked);

    // Throws OUT_OF_PROPORTION with the vertices around where so many would be too many. What is left of a search in
    // vain (`found`: it was not) deserves no large mesh, however large it is: nothing is always accepted then.
    void check(double count, Indices around, bool found = true) const;
};

}  // namespace fairing
