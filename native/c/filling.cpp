#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "api/fill.h"
#include "api/new_patch.h"
#include "base/columns.h"
#include "base/errors.h"
#include "bindings/words.h"
#include "c/shared.h"
#include "mesh/loops.h"

struct fairing_filling {  // NOLINT(readability-identifier-naming): as the header calls it
    std::vector<fairing::FilledHole> holes;
    fairing::Points points;
    fairing::Triangles triangles;
    std::vector<fairing_hole> about;
    std::vector<fairing::Indices> loops;
    std::vector<std::string> texts;
};

namespace {

using namespace fairing;
using namespace fairing::c;

FillOptions to_fill_options(const fairing_fill_options& given) {
    require(given.spacing >= 0.0 && std::isfinite(given.spacing), "options.spacing: a length, or 0, is needed");
    require(given.longest >= 0 && given.max_vertices >= 0, "options.longest, max_vertices: 0 or more is needed");
    require(given.longest_length >= 0.0, "options.longest_length: a length, or 0, is needed");
    FillOptions options;
    options.fair = to_options(given.surface);
    options.bridge = given.bridge != 0;
    options.spacing = given.spacing;
    options.spread = given.spacing > 0.0 ? Spread::equal : Spread::boundary;
    options.max_vertices = given.max_vertices;
    return options;
}

NamedLoops to_loops(const int* loops, const size_t* sizes, size_t count, std::size_t point_count) {
    NamedLoops named;
    for (std::size_t l = 0; l < count; ++l) {
        Indices& loop = named.loops.emplace_back(loops, loops + sizes[l]);
        loops += sizes[l];
        Indices wrong;
        std::ranges::copy_if(loop, std::back_inserter(wrong),
                             [&](int v) { return v < 0 || static_cast<std::size_t>(v) >= point_count; });
        if (!wrong.empty())
            throw MeshError(
                {Code::index_range, "loops: some name a vertex that does not exist", wrong, ElementKind::vertex, {}});
    }
    return named;
}

// One after the other: the new numbers of each begin behind those before.
void join(fairing_filling& filling, int old_count) {
    std::vector<Vector3> points;
    std::vector<Eigen::Vector3i> triangles;
    for (const FilledHole& hole : filling.holes) {
        const auto first = static_cast<int>(points.size());
        fairing_hole& about = filling.about.emplace_back();
        about.first_point = points.size();
        about.first_triangle = triangles.size();
        about.point_count = static_cast<std::size_t>(hole.vertices.cols());
        about.triangle_count = static_cast<std::size_t>(hole.triangles.cols());
        for (const auto point : hole.vertices.colwise()) points.emplace_back(point);
        for (const auto corners : hole.triangles.colwise())
            triangles.emplace_back(corners.unaryExpr([&](int v) { return v < old_count ? v : v + first; }));
    }
    filling.points = as_columns(points);
    filling.triangles = as_columns(triangles);
}

// Its texts and loops live in the filling.
void tell_of_each(fairing_filling& filling) {
    filling.texts.reserve(filling.holes.size());
    filling.loops.reserve(filling.holes.size());
    for (std::size_t k = 0; k < filling.holes.size(); ++k) {
        const FilledHole& hole = filling.holes[k];
        fairing_hole& about = filling.about[k];
        Indices& around = filling.loops.emplace_back();
        for (const Indices& loop : hole.loops) around.insert(around.end(), loop.begin(), loop.end());
        about.loop = around.data();
        about.loop_size = around.size();
        filling.texts.push_back(hole.left_because ? hole.left_because->message : bindings::equation_of(hole.report));
        if (hole.left_because) {
            about.left_code = code_name(hole.left_because->code).data();
            about.left_message = filling.texts.back().c_str();
            continue;
        }
        about.equation = filling.texts.back().c_str();
        about.converged = hole.report.converged;
        about.worst_join = largest(hole.report.join);
    }
}

fairing_filling* told(std::unique_ptr<fairing_filling> filling, int old_count) {
    join(*filling, old_count);
    tell_of_each(*filling);
    return filling.release();
}

FilledHole left_open(const LeftOpen& left) {
    FilledHole hole;
    hole.loops = {left.loop};
    hole.left_because = left.reason;
    return hole;
}

}  // namespace

fairing_fill_options fairing_default_fill_options(void) {
    fairing_options surface = fairing_default_options();
    surface.inner_fairness = "conformal";
    return {sizeof(fairing_fill_options), surface, 0.0, 0, 0, 0.0, 0};
}

fairing_status fairing_fill(const double* points, size_t point_count, const int* triangles, size_t triangle_count,
                            const int* loops, const size_t* loop_sizes, size_t loop_count,
                            const fairing_fill_options* options, fairing_progress progress, void* user,
                            fairing_filling** filling, fairing_error* error) {
    return guarded(error, [&] {
        require(points && triangles && filling, "points, triangles and filling: none may be NULL");
        require(loop_count == 0 || (loops && loop_sizes), "loops and loop_sizes: none may be NULL");
        *filling = nullptr;
        const fairing_fill_options given = given_or(options, fairing_default_fill_options());
        const FillOptions wanted = to_fill_options(given);
        const View<Points> all = points_of({points, point_count});
        const HoledMesh mesh({all, triangles_of({triangles, triangle_count}, point_count)});
        NamedLoops named = to_loops(loops, loop_sizes, loop_count, point_count);
        named.longest = given.longest;
        named.longest_length = given.longest_length;
        const Holes found = find_holes(mesh, named, wanted.bridge);
        auto made = std::make_unique<fairing_filling>();
        made->holes = fill(mesh, found.holes, {}, wanted, calling(progress, user));
        std::ranges::transform(found.left, std::back_inserter(made->holes), left_open);
        *filling = told(std::move(made), static_cast<int>(point_count));
    });
}

fairing_status fairing_remesh(const double* points, size_t point_count, const int* triangles, size_t triangle_count,
                              const unsigned char* selected, const fairing_fill_options* options,
                              fairing_progress progress, void* user, fairing_filling** filling, fairing_error* error) {
    return guarded(error, [&] {
        require(points && triangles && selected && filling, "points, triangles, selected, filling: none may be NULL");
        *filling = nullptr;
        const fairing_fill_options given = given_or(options, fairing_default_fill_options());
        const FillOptions wanted = to_fill_options(given);
        const SelectedMesh mesh({points, point_count}, {triangles, triangle_count}, selected);
        NewPatch found = new_patch(mesh.input(given.surface.side), {},
                                   {wanted.fair, {wanted.spacing, 0, wanted.spread}, false, wanted.max_vertices},
                                   calling(progress, user));
        auto made = std::make_unique<fairing_filling>();
        FilledHole& patch = made->holes.emplace_back();
        patch.loops = boundary_loops(mesh.inside, static_cast<int>(point_count));
        patch.vertices = std::move(found.vertices);
        patch.triangles = std::move(found.triangles);
        patch.report = std::move(found.report);
        *filling = told(std::move(made), static_cast<int>(point_count));
    });
}

void fairing_free_filling(fairing_filling* filling) { delete filling; }

const double* fairing_new_points(const fairing_filling* filling, size_t* count) {
    if (count) *count = static_cast<std::size_t>(filling->points.cols());
    return filling->points.data();
}

const int* fairing_new_triangles(const fairing_filling* filling, size_t* count) {
    if (count) *count = static_cast<std::size_t>(filling->triangles.cols());
    return filling->triangles.data();
}

size_t fairing_hole_count(const fairing_filling* filling) { return filling->about.size(); }

fairing_hole fairing_hole_at(const fairing_filling* filling, size_t hole) {
    return hole < filling->about.size() ? filling->about[hole] : fairing_hole{};
}
