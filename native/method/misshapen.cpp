#include "method/misshapen.h"

#include "geometry/angle_defects.h"
#include "method/girths.h"
#include "start/several_outlines.h"
#include "start/shape_before.h"

namespace fairing {

namespace {

constexpr double least_share = 0.5;
constexpr double most_times = 1.4;  // a pipe of three radii whose ends lean outwards by 15° has 1.29
// Of a tube that swells to one side. A forearm had 1.31, off by three quarters of a radius; what an artist keeps 1.14.
// Where three arms meet, cross-sections are wide and beside those of a film that is given for a start.
constexpr double most_times_aside = 1.2;
constexpr double least_waves = 0.15;  // of 2π: a pipe with a waist of four fifths has as much
constexpr double differing = 0.1;     // of 2π

bool swells(const Patch& patch, const Girths& girths, const Points& points) {
    const bool is_to_one_side = patch.loop_count() == 2 && girths.lies_aside(points);
    return !girths.wide(points, is_to_one_side ? most_times_aside : most_times).empty();
}

}  // namespace

bool is_misshapen(const Problem& problem, const Points& points, const Progress& progress) {
    if (!joins_outlines(problem) || bent_both_ways(problem.patch, points) < least_waves) return false;
    const auto before = shape_before(problem, progress);
    if (!before) return false;
    const auto girths = Girths::of(problem.patch, *before, progress);
    return girths && (!girths->narrow(points, least_share).empty() || swells(problem.patch, *girths, points));
}

bool is_wavier(const Patch& patch, const Points& points, const Points& other) {
    return bent_both_ways(patch, points) > bent_both_ways(patch, other) + differing;
}

}  // namespace fairing
