#include "start/automatic_equation.h"

#include "start/swept_tube.h"

namespace fairing {

Equation automatic_equation(const std::vector<Indices>& loops, const Points& points, const Points& normals) {
    const auto length = tube_length(loops, points, normals);
    return length && *length > longest_harmonic_tube ? Equation::least_variation : Equation::harmonic;
}

}  // namespace fairing
