#include "api/soft_base.h"
#include "base/parallel.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"
#include "boundary/bad_boundary.h"
#include "boundary/boundary_fit.h"
#include "boundary/chain_end.h"
#include "boundary/feather.h"
#include "boundary/fitted_boundary.h"
#include "boundary/least_variation_curve.h"
#include "detail/denoised.h"
#include "geometry/hard_edges.h"

namespace fairing::bindings {

namespace {

py::array from_flags(const std::vector<char>& flags) {
    py::array_t<bool> result(static_cast<py::ssize_t>(flags.size()));
    for (std::size_t k = 0; k < flags.size(); ++k) result.mutable_at(static_cast<py::ssize_t>(k)) = flags[k] != 0;
    result.attr("flags").attr("writeable") = false;
    return std::move(result);
}

py::dict to_dict(const SurroundingNormals& result) {
    py::dict dict;
    dict["normals"] = from_points(result.normals);
    dict["fitted"] = from_flags(result.fitted);
    dict["errors"] = from_vector(result.errors);
    dict["curvatures"] = from_vector(result.curvatures);
    dict["curvature_errors"] = from_vector(result.curvature_errors);
    return dict;
}

py::array hard_edge_array(const DoubleArray& vertices, const IntArray& triangles, const IntArray& marked) {
    const VertexPairs found = hard_edges(to_points(vertices), to_triangles(triangles), to_pairs(marked));
    py::array_t<int> result({static_cast<py::ssize_t>(found.size()), py::ssize_t{2}});
    for (std::size_t k = 0; k < found.size(); ++k) {
        for (std::size_t end = 0; end < 2; ++end)
            result.mutable_at(static_cast<py::ssize_t>(k), static_cast<py::ssize_t>(end)) = found[k][end];
    }
    result.attr("flags").attr("writeable") = false;
    return std::move(result);
}

py::dict surrounding_normal_arrays(const DoubleArray& vertices, const IntArray& triangles, const IntArray& where,
                                   const IntArray& creases) {
    return to_dict(
        surrounding_normals(to_points(vertices), to_triangles(triangles), to_indices(where), to_pairs(creases)));
}

py::dict boundary_normal_arrays(const DoubleArray& vertices, const IntArray& inside, const IntArray& outside,
                                const IntArray& where, const IntArray& creases, bool all_inside) {
    const Points points = to_points(vertices);
    const Triangles within = to_triangles(inside);
    const Triangles beyond = to_triangles(outside);
    const SideRule rule = all_inside ? SideRule::inside : SideRule::automatic;
    const BoundaryNormals found =
        boundary_normals({points, within, beyond}, to_indices(where), to_pairs(creases), rule);
    py::dict dict = to_dict(found.normals);
    dict["from_inside"] = from_flags(found.from_inside);
    return dict;
}

py::array bad_outline_array(const DoubleArray& vertices, const IntArray& triangles, const IntArray& outline) {
    const Indices vertices_of_outline = to_indices(outline);
    Indices bad = bad_vertices(fit_surroundings(to_points(vertices), to_triangles(triangles), vertices_of_outline));
    for (int& place : bad) place = vertices_of_outline[place];
    return from_indices(bad);
}

py::array feather_weight_array(const DoubleArray& vertices, const IntArray& inside, const IntArray& outside,
                               double width, const IntArray& stops) {
    return from_vector(
        feather_weights(to_points(vertices), to_triangles(inside), to_triangles(outside), width, to_indices(stops)));
}

std::pair<py::array, py::array> soft_base_arrays(const DoubleArray& vertices, const IntArray& triangles,
                                                 const IntArray& fixed, const DoubleArray& base,
                                                 const py::array_t<bool>& faired,
                                                 const std::tuple<double, double, double>& sizes, int threads,
                                                 const py::object& callback) {
    PythonRun run(callback);
    const MeshInput mesh{view_points(vertices), to_triangles(triangles), to_indices(fixed), {}};
    const Points fair = to_points(base);
    const std::vector<char> marks(faired.data(), faired.data() + faired.size());
    const auto [detail, diameter, width] = sizes;
    const SoftBaseSizes lengths{detail, diameter, width};
    const SoftBase result = run.without_gil([&](const ProgressCallback& progress) {
        const Threads team(threads);
        return soft_base({mesh, fair, marks}, lengths, progress);
    });
    return {from_points(result.base), from_points(result.soft)};
}

py::array denoised_array(const DoubleArray& vertices, const IntArray& triangles, const IntArray& fixed,
                         const DoubleArray& sizes, int threads, const py::object& callback) {
    PythonRun run(callback);
    const Points points = to_points(vertices);
    const Triangles faces = to_triangles(triangles);
    const Indices held = to_indices(fixed);
    const VectorX lengths = to_vector(sizes);
    return from_points(run.without_gil([&](const ProgressCallback& progress) {
        const Threads team(threads);
        return denoised({points, faces, held}, lengths, Progress(progress));
    }));
}

py::dict fitted_boundary_arrays(const DoubleArray& vertices, const IntArray& triangles, const IntArray& outline) {
    const FittedBoundary result = fitted_boundary(to_points(vertices), to_triangles(triangles), to_indices(outline));
    py::dict dict = to_dict(result.normals);
    dict["vertices"] = from_points(result.vertices);
    dict["moved"] = from_indices(result.moved);
    dict["held"] = from_indices(result.held);
    dict["noise"] = result.noise;
    return dict;
}

// Rows: beginning and end.
py::array fair_curve_array(const DoubleArray& places, const DoubleArray& directions,
                           const std::vector<double>& shares) {
    const Points ends = to_points(places);
    const Points ways = to_points(directions);
    const auto count = static_cast<Eigen::Index>(shares.size());
    return from_points(least_variation_curve({ends.col(0), ways.col(0)}, {ends.col(1), ways.col(1)},
                                             Eigen::Map<const VectorX>(shares.data(), count)));
}

py::tuple chain_end(const DoubleArray& chain) {
    const ChainEnd end = end_of_chain(to_points(chain));
    return py::make_tuple(from_points(end.direction), from_points(end.curvature));
}

}  // namespace

void bind_outline(py::module_& module) {
    module.def("hard_edges", &hard_edge_array, py::arg("vertices"), py::arg("triangles"), py::arg("marked"));
    module.def("surrounding_normals", &surrounding_normal_arrays, py::arg("vertices"), py::arg("triangles"),
               py::arg("at"), py::arg("creases"));
    module.def("boundary_normals", &boundary_normal_arrays, py::arg("vertices"), py::arg("inside"), py::arg("outside"),
               py::arg("at"), py::arg("creases"), py::arg("all_inside"));
    module.def("bad_outline", &bad_outline_array, py::arg("vertices"), py::arg("outside"), py::arg("outline"));
    module.def("mend_outline", &fitted_boundary_arrays, py::arg("vertices"), py::arg("outside"), py::arg("outline"));
    module.def("feather_weights", &feather_weight_array, py::arg("vertices"), py::arg("inside"), py::arg("outside"),
               py::arg("width"), py::arg("stops"));
    module.def("soft_base", &soft_base_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("base"), py::arg("faired"), py::arg("sizes"), py::arg("threads"), py::arg("progress"));
    module.def("denoised", &denoised_array, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("sizes"), py::arg("threads"), py::arg("progress"));
    module.def("fair_curve", &fair_curve_array, py::arg("places"), py::arg("directions"), py::arg("shares"));
    module.def("chain_end", &chain_end, py::arg("chain"));
}

}  // namespace fairing::bindings
