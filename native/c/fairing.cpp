#include "c/fairing.h"

#include <memory>

#include "api/measure.h"
#include "bindings/words.h"
#include "c/shared.h"

struct fairing_result {  // NOLINT(readability-identifier-naming): as the header calls it
    fairing::FairResult found;
    std::string equation;
    std::string termination;
};

namespace {

using namespace fairing;
using namespace fairing::c;

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
        const fairing_options given = given_or(options, fairing_default_options());
        const FairOptions wanted = to_options(given);
        const SelectedMesh mesh({points, point_count}, {triangles, triangle_count}, selected);
        auto made = std::make_unique<fairing_result>();
        made->found = fair(mesh.input(given.side), {}, wanted, calling(progress, user));
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

fairing_status fairing_mean_curvature(const double* points, size_t point_count, const int* triangles,
                                      size_t triangle_count, double* curvatures, fairing_error* error) {
    return guarded(error, [&] {
        require(points && triangles && curvatures, "points, triangles and curvatures: none may be NULL");
        const View<Points> all = points_of({points, point_count});
        const Triangles faces = triangles_of({triangles, triangle_count}, point_count);
        const VectorX found = mean_curvature({all, faces, {}, {}}, NormalKind::fitted);
        std::copy_n(found.data(), found.size(), curvatures);
    });
}
