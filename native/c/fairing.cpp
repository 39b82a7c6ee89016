#include "c/fairing.h"

#include <algorithm>
#include <memory>

#include "bindings/words.h"
#include "boundary/boundary_fit.h"
#include "boundary/surrounding_fit.h"
#include "c/shared.h"
#include "mesh/loops.h"

struct fairing_result {  // NOLINT(readability-identifier-naming): as the header calls it
    fairing::FairResult found;
    std::string equation;
    std::string termination;
};

namespace {

using namespace fairing;
using namespace fairing::c;

// Those that are selected, or those that aren't; MeshError where a vertex doesn't exist.
Triangles chosen(std::span<const int> triangles, const unsigned char* selected, bool wanted) {
    Indices flat;
    for (std::size_t t = 0; 3 * t < triangles.size(); ++t) {
        if ((selected[t] != 0) == wanted) flat.insert(flat.end(), &triangles[3 * t], &triangles[3 * t] + 3);
    }
    return Eigen::Map<const Triangles>(flat.data(), 3, static_cast<Eigen::Index>(flat.size() / 3));
}

SurroundingNormals slopes(const Surroundings& mesh, const Indices& outline, std::string_view side) {
    if (side == "outside") return surrounding_normals(mesh.points, mesh.outside, outline, {});
    require(side == "inside" || side == "automatic", "options.side: outside, inside or automatic is needed");
    return boundary_normals(mesh, outline, {}, side == "inside" ? SideRule::inside : SideRule::automatic).normals;
}

// Border vertices whose slope is known, with it. Others are left out: they stay, with that of their own triangles.
void add_boundary(MeshInput& input, const Surroundings& mesh, std::string_view side) {
    Indices outline;
    for (const Indices& loop : boundary_loops(mesh.patch, static_cast<int>(mesh.points.cols())))
        outline.insert(outline.end(), loop.begin(), loop.end());
    std::ranges::sort(outline);
    outline.erase(std::ranges::unique(outline).begin(), outline.end());
    const SurroundingNormals found = slopes(mesh, outline, side);
    Indices known;
    for (int k = 0; k < static_cast<int>(outline.size()); ++k)
        if (found.normals.col(k).squaredNorm() > 0.0) known.push_back(k);
    input.fixed_normals = found.normals(Eigen::all, known);
    for (int& place : known) place = outline[place];
    input.fixed = known;
}

const Diagnostic* warning_at(const fairing_result* result, int warning) {
    const bool exists = result && warning >= 0 && warning < static_cast<int>(result->found.warnings.size());
    return exists ? &result->found.warnings[static_cast<std::size_t>(warning)] : nullptr;
}

}  // namespace

int fairing_interface(void) { return FAIRING_INTERFACE; }

const char* fairing_version(void) { return FAIRING_VERSION; }

fairing_options fairing_default_options(void) {
    return {sizeof(fairing_options), "harmonic", "automatic", "uniform", 0.0, 1e-6, 1, 0};
}

fairing_status fairing_fair_faces(const double* points, size_t point_count, const int* triangles, size_t triangle_count,
                                  const unsigned char* selected, const fairing_options* options,
                                  fairing_progress progress, void* user, fairing_result** result,
                                  fairing_error* error) {
    return guarded(error, [&] {
        require(points && triangles && selected && result, "points, triangles, selected and result: none may be NULL");
        *result = nullptr;
        require(!options || options->size == sizeof(fairing_options),
                "options.size: sizeof(fairing_options) is needed");
        const fairing_options given = options ? *options : fairing_default_options();
        const FairOptions wanted = to_options(given);
        const std::span<const int> flat(triangles, 3 * triangle_count);
        check_indices(flat, point_count);
        const Points all = Eigen::Map<const Points>(points, 3, static_cast<Eigen::Index>(point_count));
        const Triangles inside = chosen(flat, selected, true);
        const Triangles outside = chosen(flat, selected, false);
        require(inside.cols() > 0, "selected: no triangle is selected");
        MeshInput input{all, inside, {}, {}, {}, outside};
        add_boundary(input, {all, inside, outside}, given.side);
        auto made = std::make_unique<fairing_result>();
        made->found = fair(std::move(input), {}, wanted, calling(progress, user));
        made->equation = bindings::equation_of(made->found);
        made->termination = bindings::termination_words.word(made->found.termination);
        *result = made.release();
    });
}

void fairing_free(fairing_result* result) { delete result; }

const double* fairing_points(const fairing_result* result) { return result->found.vertices.data(); }

int fairing_converged(const fairing_result* result) { return result->found.converged; }

const char* fairing_equation(const fairing_result* result) { return result->equation.c_str(); }

const char* fairing_termination(const fairing_result* result) { return result->termination.c_str(); }

double fairing_worst_boundary_angle(const fairing_result* result) { return largest(result->found.boundary_angle); }

double fairing_worst_join(const fairing_result* result) { return largest(result->found.join); }

int fairing_warning_count(const fairing_result* result) { return static_cast<int>(result->found.warnings.size()); }

const char* fairing_warning_code(const fairing_result* result, int warning) {
    const Diagnostic* found = warning_at(result, warning);
    return found ? code_name(found->code).data() : nullptr;
}

const char* fairing_warning_message(const fairing_result* result, int warning) {
    const Diagnostic* found = warning_at(result, warning);
    return found ? found->message.c_str() : nullptr;
}

const int* fairing_warning_elements(const fairing_result* result, int warning, int* count) {
    const Diagnostic* found = warning_at(result, warning);
    if (count) *count = found ? static_cast<int>(found->elements.size()) : 0;
    return found ? found->elements.data() : nullptr;
}
