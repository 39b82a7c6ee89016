#include "method/bulb.h"

#include <algorithm>
#include <numbers>

#include "geometry/target_surface.h"
#include "problem/surface_state.h"
#include "start/several_outlines.h"
#include "start/swept_start.h"

namespace fairing {

namespace {

// Where tubes are long for the area between them, what their outlines ask for reaches everywhere: rings, pipes shorter
// than two and a half radii and joints with arms of less are none. Of blends that are none 0.24 to 0.37 was measured.
bool has_room(const Patch& patch, const Points& points) {
    constexpr double of_joints = 0.4;
    const int loops = patch.loop_count();
    return loops > 1 && length_between(patch, points) > (loops == 2 ? longest_single : of_joints);
}

double largest_distance(const Problem& problem, const Points& points, const Points& from) {
    const SurfaceState state = measured_surface(problem, from);
    const TargetSurface target(problem.patch, from, state.normals);
    double largest = 0.0;
    for (int v = 0; v < problem.patch.free_count; ++v) {
        const SurfacePoint nearest = target.project(points.col(v), target.at_vertex(v).triangle);
        largest = std::max(largest, (target.position(nearest) - points.col(v)).norm());
    }
    return largest;
}

// Bulbs and waists were off that tube by a sixth of the radius and more. On graded meshes measuring how their curvature
// varies takes five times as long as their solution, and tells of the mesh. The tube's places are looked for on the
// surface, not the other way round: a graded mesh that is laid on a tube has chords that leave it by an eighth.
bool is_swept(const Problem& problem, const Points& points, const Progress& progress) {
    constexpr double near = 0.05;  // of the tube's radius
    const auto tube = tube_between(problem);
    if (!tube) return false;
    const auto swept = swept_start(problem, *tube, progress.here());
    if (!swept) return false;
    const double radius = std::min(tube->first().girth(), tube->last().girth()) / (2.0 * std::numbers::pi);
    return largest_distance(problem, *swept, points) < near * radius;
}

}  // namespace

bool may_be_bulb(const Problem& problem, const Points& points, const Progress& progress) {
    return has_room(problem.patch, points) && !is_swept(problem, points, progress);
}

}  // namespace fairing
