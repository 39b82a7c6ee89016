#include "c/shared.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

#include "base/errors.h"
#include "base/memory.h"
#include "bindings/words.h"

namespace fairing::c {

namespace {

void copy_text(std::span<char> target, std::string_view text) {
    std::size_t count = std::min(text.size(), target.size() - 1);
    // No character of several bytes is cut.
    while (count < text.size() && count > 0 && (static_cast<unsigned char>(text[count]) & 0xC0U) == 0x80U) --count;
    std::memcpy(target.data(), text.data(), count);
    target[count] = '\0';
}

void fill_error(fairing_error* error, std::string_view code, std::string_view message) {
    if (!error) return;
    *error = {};
    copy_text(error->code, code);
    copy_text(error->message, message);
}

void fill_error(fairing_error* error, const Diagnostic& diagnostic) {
    if (!error) return;
    fill_error(error, code_name(diagnostic.code), diagnostic.message);
    const std::size_t count = std::min(diagnostic.elements.size(), std::size(error->elements));
    std::copy_n(diagnostic.elements.begin(), count, error->elements);
    error->element_count = static_cast<int>(count);
    error->of_triangles = diagnostic.kind == ElementKind::triangle;
}

}  // namespace

fairing_status guarded(fairing_error* error, const std::function<void()>& work) {
    try {
        fill_error(error, "", "");
        work();
        return FAIRING_OK;
    } catch (const MeshError& thrown) {
        fill_error(error, thrown.diagnostic());
        return FAIRING_MESH_ERROR;
    } catch (const Cancelled& thrown) {
        fill_error(error, "", thrown.what());
        return FAIRING_CANCELLED;
    } catch (const SolverError& thrown) {
        fill_error(error, "", thrown.what());
        return FAIRING_SOLVER_ERROR;
    } catch (const MemoryShortage& thrown) {
        fill_error(error, "", thrown.what());
        return FAIRING_NO_MEMORY;
    } catch (const std::bad_alloc&) {
        fill_error(error, "", "not enough memory");
        return FAIRING_NO_MEMORY;
    } catch (const std::invalid_argument& thrown) {
        fill_error(error, "", thrown.what());
        return FAIRING_BAD_ARGUMENT;
    } catch (const std::exception& thrown) {
        fill_error(error, "", thrown.what());
        return FAIRING_INTERNAL_ERROR;
    }
}

void require(bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(message);
}

FairOptions to_options(const fairing_options& given) {
    require(given.equation && given.side && given.inner_fairness, "options: begin with fairing_default_options()");
    require(std::isfinite(given.bulge), "options.bulge: a finite number is needed");
    require(given.tolerance > 0.0 && given.tolerance < 1.0, "options.tolerance: between 0 and 1 is needed");
    require(given.threads >= 0, "options.threads: 0 or more is needed");
    FairOptions options;
    options.solver.equation = bindings::equation_words.value(given.equation);
    options.solver.otherwise = given.stand_in ? Otherwise::least_variation : Otherwise::stop;
    options.solver.tolerance = given.tolerance;
    options.bulge = given.bulge;
    options.inner_fairness = bindings::fairness_words.value(given.inner_fairness);
    options.pin_radius = 0.1;  // as fair() of the Python package
    options.threads = given.threads;
    return options;
}

void check_indices(std::span<const int> triangles, std::size_t point_count) {
    Diagnostic wrong{
        Code::index_range, "triangles: some name a vertex that does not exist", {}, ElementKind::triangle, {}};
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const bool exists = triangles[k] >= 0 && static_cast<std::size_t>(triangles[k]) < point_count;
        const int triangle = static_cast<int>(k / 3);
        if (!exists && (wrong.elements.empty() || wrong.elements.back() != triangle))
            wrong.elements.push_back(triangle);
    }
    if (!wrong.elements.empty()) throw MeshError(wrong);
}

ProgressCallback calling(fairing_progress progress, void* user) {
    if (!progress) return {};
    return [=](double fraction, std::string_view stage) {
        return progress(fraction, std::string(stage).c_str(), user) != 0;
    };
}

double largest(const VectorX& values) { return values.size() ? values.maxCoeff() : 0.0; }

}  // namespace fairing::c
