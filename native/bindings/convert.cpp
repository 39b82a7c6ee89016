#include "bindings/convert.h"

#include "base/errors.h"
#include "base/memory.h"

namespace fairing::bindings {

namespace {

py::array read_only(py::array array) {
    array.attr("flags").attr("writeable") = false;
    return array;
}

std::string& package() {
    static std::string name;
    return name;
}

py::object package_type(const char* name) { return py::module_::import((package() + "._types").c_str()).attr(name); }

void raise_mesh_error(const MeshError& error) {
    const py::object exception = package_type("MeshError")(from_diagnostic(error.diagnostic()));
    PyErr_SetObject(package_type("MeshError").ptr(), exception.ptr());
}

}  // namespace

View<Points> view_points(const DoubleArray& array) { return View<Points>::Map(array.data(), 3, array.shape(0)); }

Points to_points(const DoubleArray& array) { return view_points(array); }

Triangles to_triangles(const IntArray& array) { return Eigen::Map<const Triangles>(array.data(), 3, array.shape(0)); }

Indices to_indices(const IntArray& array) { return {array.data(), array.data() + array.size()}; }

py::array from_points(const Points& points) {
    return read_only(py::array_t<double>({points.cols(), Eigen::Index{3}}, points.data()));
}

py::array from_triangles(const Triangles& triangles) {
    return read_only(py::array_t<int>({triangles.cols(), Eigen::Index{3}}, triangles.data()));
}

VectorX to_vector(const DoubleArray& array) { return Eigen::Map<const VectorX>(array.data(), array.size()); }

py::array from_vector(const VectorX& values) { return read_only(py::array_t<double>(values.size(), values.data())); }

py::array from_indices(const Indices& indices) {
    return read_only(py::array_t<int>(static_cast<py::ssize_t>(indices.size()), indices.data()));
}

std::vector<std::array<int, 2>> to_pairs(const IntArray& array) {
    const Indices flat = to_indices(array);
    std::vector<std::array<int, 2>> pairs;
    for (std::size_t k = 0; k + 1 < flat.size(); k += 2) pairs.push_back({flat[k], flat[k + 1]});
    return pairs;
}

py::object from_diagnostic(const Diagnostic& diagnostic) {
    return package_type("Diagnostic")(
        std::string(code_name(diagnostic.code)), diagnostic.message, from_indices(diagnostic.elements),
        diagnostic.kind == ElementKind::vertex ? "vertex" : "triangle", diagnostic.figures);
}

void register_errors(const py::module_& module) {
    const auto name = module.attr("__name__").cast<std::string>();
    package() = name.substr(0, name.rfind('.'));
    // NOLINTNEXTLINE(performance-unnecessary-value-param): the signature that pybind11 wants
    py::register_local_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const MeshError& error) {
            raise_mesh_error(error);
        } catch (const SolverError& error) {
            PyErr_SetString(package_type("SolverError").ptr(), error.what());
        } catch (const MemoryShortage& error) {
            PyErr_SetString(PyExc_MemoryError, error.what());
        } catch (const std::bad_alloc&) {
            PyErr_SetString(PyExc_MemoryError, "not enough memory");
        } catch (const Cancelled& error) {
            PyErr_SetString(package_type("Cancelled").ptr(), error.what());
        }
    });
}

}  // namespace fairing::bindings
