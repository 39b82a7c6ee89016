#include "c/shared.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>
#include <set>
#include <stdexcept>

#include "base/errors.h"
#include "base/memory.h"
#include "bindings/words.h"
#include "boundary/boundary_fit.h"
#include "boundary/surrounding_fit.h"
#include "mesh/loops.h"

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

View<Points> points_of(Triples<double> points) {
    return View<Points>::Map(points.numbers, 3, static_cast<Eigen::Index>(points.count));
}

Triangles triangles_of(Triples<int> triangles, std::size_t point_count) {
    Triangles all = Eigen::Map<const Triangles>(triangles.numbers, 3, static_cast<Eigen::Index>(triangles.count));
    Diagnostic wrong{
        Code::index_range, "triangles: some name a vertex that does not exist", {}, ElementKind::triangle, {}};
    for (int t = 0; t < static_cast<int>(all.cols()); ++t)
        if (all.col(t).minCoeff() < 0 || static_cast<std::size_t>(all.col(t).maxCoeff()) >= point_count)
            wrong.elements.push_back(t);
    if (!wrong.elements.empty()) throw MeshError(wrong);
    return all;
}

SelectedMesh::SelectedMesh(Triples<double> given, Triples<int> triangles, const unsigned char* selected)
    : points(points_of(given)) {
    const Triangles all = triangles_of(triangles, given.count);
    Indices own;
    Indices others;
    for (int t = 0; t < static_cast<int>(all.cols()); ++t) (selected[t] != 0 ? own : others).push_back(t);
    require(!own.empty(), "selected: no triangle is selected");
    inside = all(Eigen::all, own);
    outside = all(Eigen::all, others);
}

MeshInput SelectedMesh::input(std::string_view side) const {
    std::set<int> border;
    for (const Indices& loop : boundary_loops(inside, static_cast<int>(points.cols())))
        border.insert(loop.begin(), loop.end());
    const Indices boundary(border.begin(), border.end());
    require(side == "outside" || side == "inside" || side == "automatic",
            "options.side: outside, inside or automatic is needed");
    const SideRule rule = side == "inside" ? SideRule::inside : SideRule::automatic;
    const SurroundingNormals found = side == "outside"
                                         ? surrounding_normals(points, outside, boundary, {})
                                         : boundary_normals({points, inside, outside}, boundary, {}, rule).normals;
    Indices known;
    for (int k = 0; k < static_cast<int>(boundary.size()); ++k)
        if (found.normals.col(k).squaredNorm() > 0.0) known.push_back(k);
    const Points normals = found.normals(Eigen::all, known);
    for (int& place : known) place = boundary[place];
    return {points, inside, known, normals, std::nullopt, outside};
}

ProgressCallback calling(fairing_progress progress, void* user) {
    if (!progress) return {};
    return [=](double fraction, std::string_view stage) {
        return progress(fraction, std::string(stage).c_str(), user) != 0;
    };
}

double largest(const VectorX& values) { return values.size() ? values.maxCoeff() : 0.0; }

}  // namespace fairing::c
