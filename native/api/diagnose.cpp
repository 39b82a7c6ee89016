#include "api/diagnose.h"

#include <Eigen/Geometry>

#include "api/component.h"
#include "continuity/joined.h"
#include "geometry/face_geometry.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "geometry/triangle.h"
#include "geometry/vertex_normal.h"
#include "method/plan.h"
#include "pins/spread_pins.h"
#include "shape/limits.h"

namespace fairing {

namespace {

void warn_of_sharp_boundary(const Patch& patch, const Points& prescribed, Diagnostics& warnings) {
    constexpr double widest_turn = 20.0;  // degrees: 18 edges to a circle are not worth a word
    Indices sharp;
    double widest = 0.0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[e][1] != none) continue;
        const auto [a, b] = patch.edge_ends[e];
        if (patch.pin[a] || patch.pin[b]) continue;
        const double turn = degrees_between(prescribed.col(a - patch.free_count), prescribed.col(b - patch.free_count));
        widest = std::max(widest, turn);
        if (turn > widest_turn) sharp.insert(sharp.end(), {patch.to_input[a], patch.to_input[b]});
    }
    if (sharp.empty()) return;
    warnings.push_back({Code::sharp_boundary,
                        "the normals along the boundary turn by up to " + std::to_string(std::lround(widest)) +
                            "° from one vertex to the next: a finer boundary makes the surface more accurate there",
                        sharp,
                        ElementKind::vertex,
                        {{"degrees", widest}, {"edges", size_of(sharp) / 2}}});
}

// The end of a sentence on a component, and the figures in it.
struct Reason {
    std::string text;
    Figures figures;
};

Reason reason_of_folds(const Solution& solution) {
    const bool turned = solution.flaw == Flaw::folded;
    const Indices& bad = solution.bad_triangles;
    return {"has a surface, but its vertices can't be projected onto it without folds: " +
                counted(bad.size(), "triangle is", "triangles are") +
                (turned ? " turned over" : " passing through others"),
            {{turned ? "turned_over" : "passing_through", size_of(bad)}}};
}

// Angles: degrees at the fixed vertices.
Reason reason_of(const Solution& solution, const VectorX& angles) {
    if (solution.reached_load > 0.0) {
        return {"reached only " + std::to_string(std::lround(100.0 * solution.reached_load)) +
                    " % of its bulge and keeps that surface; more may have no solution",
                {{"load_share", solution.reached_load}}};
    }
    if (solution.flaw == Flaw::collapsed) {
        return {"collapsed to a point or a line: add vertices to `fixed`", {{"area", 0.0}}};
    }
    if (solution.flaw == Flaw::behind) {
        const auto wrong = (angles.array() > turned_back).count();
        const auto all = (angles.array() > 0.0).count();
        return {"meets its boundary from the wrong side at " + std::to_string(wrong) + " of " + std::to_string(all) +
                    " vertices: select less, so that more of the shape stays outside",
                {{"from_behind", static_cast<double>(wrong)}, {"outline_vertices", static_cast<double>(all)}}};
    }
    return {"did not converge; its positions are the best that were found", {}};
}

Reason reason_of_join(const Solution& solution) {
    switch (solution.join) {
        case Join::other_mesh:
            return {"the triangles are too irregular to measure it on: remesh them", {{"proxy_mesh", 1.0}}};
        case Join::no_tangent_join:
            return {"the surface that is only tangent was not found either", {{"no_tangent_join", 1.0}}};
        case Join::not_found:
            return {"the iteration for it did not converge to an acceptable surface; let the boundary lie further out",
                    {{"not_found", 1.0}}};
        case Join::too_rough:
            return {
                "the curvature around looks like noise (" + std::to_string(std::lround(100.0 * solution.smooth_share)) +
                    " % of it is smooth over twelve vertices, " +
                    std::to_string(std::lround(100.0 * least_smooth_share)) + " % are needed): smooth the surroundings",
                {{"smooth_share", solution.smooth_share}}};
        default:
            return {"the surroundings determine it too little: leave three rings of regular triangles around the patch",
                    {}};
    }
}

std::string_view reason_of(Pins pins) {
    switch (pins) {
        case Pins::too_close: return "some are nearer to each other than two radii; a smaller radius may do";
        case Pins::no_boundary: return "nothing but pins holds the surface";
        case Pins::curvature_met: return "a radius has no effect with continuity 'G2'";
        case Pins::no_surface: return "the surface through the points was not found either";
        default: return "no acceptable surface was found with it";
    }
}

}  // namespace

Indices input_numbers(const Patch& patch, Indices triangles) {
    for (int& t : triangles) t = patch.input_triangle[t];
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

bool has_collapsed_fan(const Patch& patch, const Points& points) {
    std::vector<char> has_area(patch.vertex_count(), 0);
    for (const auto corners : patch.triangles.colwise()) {
        if (!(triangle_shape(points.col(corners[0]), points.col(corners[1]), points.col(corners[2])) > 0.0)) continue;
        for (int v : corners) has_area[v] = 1;
    }
    const auto end = has_area.begin() + patch.free_count;
    return std::find(has_area.begin(), end, 0) != end;
}

bool is_usable_reference(const Patch& patch, const Points& reference, Diagnostics& warnings) {
    constexpr double sliver = 0.02;          // a right triangle of 90 : 1
    constexpr double tolerated_share = 0.1;  // of the triangles: fewer hang on what is around them
    Indices bad = input_numbers(patch, flipped_triangles(patch, reference));
    for (int t = 0; t < patch.triangle_count(); ++t) {
        const auto corners = patch.triangles.col(t);
        const double shape =
            triangle_shape(reference.col(corners[0]), reference.col(corners[1]), reference.col(corners[2]));
        if (!(shape >= sliver)) bad.push_back(patch.input_triangle[t]);
    }
    // A vertex whose whole neighbourhood is a point or a line hangs on nothing.
    const bool collapsed = has_collapsed_fan(patch, reference);
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    if (!collapsed && static_cast<double>(bad.size()) <= tolerated_share * patch.triangle_count()) return true;
    warnings.push_back(
        about(Code::reference_unusable,
              counted(bad.size(), "triangle of the reference mesh is a sliver or turned over",
                      "triangles of the reference mesh are slivers or turned over") +
                  ", so that no distribution of vertices can be read off it; uniform inner fairness was used",
              bad, ElementKind::triangle, "triangles"));
    return false;
}

void warn_of_missing_detail(Diagnostics& warnings) {
    warnings.push_back(
        {Code::reference_unusable,
         "triangles of the old patch have no area, so that no detail can be read off it; it was left out",
         {},
         {},
         {{"old_skin", 1.0}}});
}

void warn_of_folded_detail(const Patch& patch, const Indices& triangles, Diagnostics& warnings) {
    if (triangles.empty()) return;
    warnings.push_back({Code::flipped_triangles,
                        counted(triangles.size(), "triangle is", "triangles are") +
                            " turned over by the detail put back, for lack of room: lower `detail` or `detail_size`",
                        input_numbers(patch, triangles),
                        ElementKind::triangle,
                        {{"triangles", size_of(triangles)}}});
}

void warn_of_precision(const Patch& patch, const View<Points>& input, const Precision& wanted, Diagnostics& warnings) {
    constexpr double tolerated_share = 1e-3;  // of the mean border edge
    double length = 0.0;
    int count = 0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[e][1] != none) continue;
        const auto [a, b] = patch.edge_ends[e];
        length += (input.col(patch.to_input[a]) - input.col(patch.to_input[b])).stableNorm();
        ++count;
    }
    double farthest = 0.0;
    for (int v : patch.to_input) farthest = std::max(farthest, input.col(v).cwiseAbs().maxCoeff());
    const double spacing = farthest * std::numeric_limits<double>::epsilon();
    const double edge = count > 0 ? length / count : wanted.diameter;
    if (spacing <= std::min(tolerated_share * edge, wanted.tolerance * wanted.diameter)) return;
    warnings.push_back(
        {Code::precision,
         "this far from the origin coordinates are too coarse for these edges: move the mesh nearer to the "
         "origin",
         {},
         {},
         {{"spacing", spacing}, {"edge", edge}}});
}

Diagnostics failures_of(const Patch& patch, const Solution& solution, Termination end, const VectorX& angles) {
    const bool folds = end == Termination::folded;
    Reason reason = folds ? reason_of_folds(solution) : reason_of(solution, angles);
    reason.figures["free_vertices"] = patch.free_count;
    const std::string text =
        "a component of " + counted(patch.free_count, "free vertex ", "free vertices ") + reason.text;
    Figures not_converged =
        folds ? Figures{{"free_vertices", patch.free_count}, {"folds", size_of(solution.bad_triangles)}}
              : reason.figures;
    Diagnostics result{{Code::not_converged, text, Indices(free_vertices(patch).begin(), free_vertices(patch).end()),
                        ElementKind::vertex, std::move(not_converged)}};
    if (folds) {
        result.push_back({Code::folded, text, input_numbers(patch, solution.bad_triangles), ElementKind::triangle,
                          std::move(reason.figures)});
    }
    return result;
}

void warn_of_join(const Patch& patch, const Solution& solution, Diagnostics& warnings) {
    if (solution.join == Join::tangent || solution.join == Join::curvature) return;
    const auto fixed = fixed_vertices(patch);
    Indices vertices;
    if (solution.join == Join::partly_curvature) {
        for (int place : solution.tangent_only) vertices.push_back(fixed[place]);
    } else {
        vertices.assign(fixed.begin(), fixed.end());
    }
    auto [why, figures] = reason_of_join(solution);
    figures["vertices"] = size_of(vertices);
    figures["outline_vertices"] = static_cast<double>(fixed.size());
    const std::string share = vertices.size() == fixed.size()
                                  ? "all " + std::to_string(fixed.size())
                                  : std::to_string(vertices.size()) + " of " + std::to_string(fixed.size());
    warnings.push_back({Code::g2_not_met,
                        share + " boundary vertices are met in their slope, not in their curvature: " + why, vertices,
                        ElementKind::vertex, std::move(figures)});
}

namespace {

void warn_of_sharp_pins(const Patch& patch, const Solution& solution, Diagnostics& warnings) {
    Indices pins = sharp_pins(patch, solution.points);
    if (pins.empty()) return;
    for (int& place : pins) place = fixed_vertices(patch)[place];
    warnings.push_back(about(Code::pins_not_spread,
                             counted(pins.size(), "pin is the tip of a spike", "pins are tips of spikes") +
                                 ": the surface rises far within a short distance",
                             pins, ElementKind::vertex, "tips"));
}

}  // namespace

void warn_of_pins(const Patch& patch, const Solution& solution, Diagnostics& warnings) {
    warn_of_sharp_pins(patch, solution, warnings);
    if (solution.pins == Pins::absent || solution.pins == Pins::spread) return;
    Indices pins = isolated_pins(patch);
    for (int& place : pins) place = fixed_vertices(patch)[place];
    Figures figures{{"pins", size_of(pins)}};
    if (solution.pins == Pins::too_close) figures["close"] = 1.0;
    warnings.push_back({Code::pins_not_spread,
                        counted(pins.size(), "pin acts in a point, not over its radius: ",
                                "pins act in a point, not over their radius: ") +
                            std::string(reason_of(solution.pins)),
                        pins, ElementKind::vertex, figures});
}

namespace {

// Boundary vertices that a surface meets at more than 20° from the tangent plane prescribed.
Indices kinks_of(const Problem& problem, const Solution& solution) {
    const VectorX angles = boundary_angles(problem.patch, solution.boundary_normals, problem.fixed_normals);
    Indices kinks;
    for (int k = 0; k < angles.size(); ++k) {
        if (angles[k] > off_slope) kinks.push_back(fixed_vertices(problem.patch)[k]);
    }
    return kinks;
}

const char* taken(Provenance provenance) {
    if (is_loft(provenance)) return "a loft was taken";
    if (provenance == Provenance::old_shape) return "the old shape was taken, as smooth as it can be";
    if (provenance == Provenance::first_surface) return "a bi-Laplacian surface was taken";
    return "the surface of least variation was taken";
}

// A loft and a smoothed shape may leave tangent planes, and name where they do.
void add_kinks(const Problem& problem, const Solution& solution, Diagnostic& diagnostic) {
    if (solution.provenance == Provenance::least_variation) return;
    Indices kinks = kinks_of(problem, solution);
    if (kinks.empty()) return;
    diagnostic.figures["kinks"] = size_of(kinks);
    diagnostic.message += ", with a kink at " + counted(kinks.size(), "boundary vertex", "boundary vertices");
    diagnostic.elements = std::move(kinks);
}

}  // namespace

Diagnostic no_solution(const Problem& problem, const Solution& solution) {
    const Patch& patch = problem.patch;
    const std::string free = counted(patch.free_count, "free vertex", "free vertices");
    const bool harmonic = problem.options.equation == Equation::harmonic;
    const std::string name = harmonic ? "harmonic surface" : "surface of that equation";
    Figures figures{{"free_vertices", patch.free_count}};
    if (harmonic) figures["harmonic"] = 1.0;
    if (is_loft(solution.provenance)) figures["loft"] = 1.0;
    if (solution.provenance == Provenance::old_shape) figures["smoothed"] = 1.0;
    if (solution.provenance == Provenance::first_surface) figures["bilaplacian"] = 1.0;
    const std::string text = "no " + name + " fits the boundary of a component of " + free;
    if (solution.provenance == Provenance::low_passed) {
        figures["distance"] = distance_of_low_passed(problem);
        return {Code::no_solution, text + " as it is: the surface runs smoothly past it, with gaps",
                Indices(free_vertices(patch).begin(), free_vertices(patch).end()), ElementKind::vertex, figures};
    }
    const auto all = free_vertices(patch);
    Diagnostic diagnostic{Code::no_solution, text + "; " + taken(solution.provenance), Indices(all.begin(), all.end()),
                          ElementKind::vertex, figures};
    add_kinks(problem, solution, diagnostic);
    return diagnostic;
}

void warn_of_folds(Indices flipped, Indices crossing, Diagnostics& warnings) {
    const auto warn = [&](Code code, Indices triangles, const char* one, const char* many) {
        if (triangles.empty()) return;
        const std::string text = counted(triangles.size(), one, many);
        warnings.push_back(about(code, text, std::move(triangles), ElementKind::triangle, "triangles"));
    };
    warn(Code::flipped_triangles, std::move(flipped), "triangle of the result is turned over",
         "triangles of the result are turned over");
    warn(Code::self_intersection, std::move(crossing), "triangle of the result passes through others of the patch",
         "triangles of the result pass through others of the patch");
}

void diagnose(const Patch& patch, const Solution& solution, const Points& prescribed, Diagnostics& warnings) {
    Indices flipped = solution.flipped ? *solution.flipped : flipped_triangles(patch, solution.points);
    Indices crossing = solution.crossings ? *solution.crossings : crossing_triangles(patch.triangles, solution.points);
    warn_of_folds(input_numbers(patch, std::move(flipped)), input_numbers(patch, std::move(crossing)), warnings);
    warn_of_sharp_boundary(patch, prescribed, warnings);
}

}  // namespace fairing
