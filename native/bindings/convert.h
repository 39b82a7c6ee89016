// numpy ↔ Eigen. An (n, 3) C-ordered array and a 3 × n column-major matrix share their memory layout.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>

#include "base/errors.h"
#include "base/view.h"

namespace fairing::bindings {

namespace py = pybind11;

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using IntArray = py::array_t<int, py::array::c_style | py::array::forcecast>;

Points to_points(const DoubleArray& array);
View<Points> view_points(const DoubleArray& array);
Triangles to_triangles(const IntArray& array);
Indices to_indices(const IntArray& array);
VectorX to_vector(const DoubleArray& array);  // (k,)
std::vector<std::array<int, 2>> to_pairs(const IntArray& array);

template <typename Array, typename Convert>
auto to_optional(const std::optional<Array>& array, Convert convert) -> std::optional<decltype(convert(*array))> {
    if (!array) return std::nullopt;
    return convert(*array);
}

// Arrays handed out are marked read-only.
py::array from_points(const Points& points);
py::array from_triangles(const Triangles& triangles);
py::array from_vector(const VectorX& values);
py::array from_indices(const Indices& indices);

// fairing.Diagnostic of the Python package.
py::object from_diagnostic(const Diagnostic& diagnostic);

// MeshError, SolverError and Cancelled become the exceptions of the package that this module is in, whatever its name:
// Blender's add-on has a copy under a name of its own. To be called before anything else.
void register_errors(const py::module_& module);

}  // namespace fairing::bindings
