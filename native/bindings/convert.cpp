#include "bindings/convert.h"

#include "base/memory.h"

namespace fairing::bindings {

namespace {

std::string& package() {
    static std::string name;
    return name;
}

py::object package_type(const char* name) { return py::module_::import((package() + ".results").c_str()).attr(name); }

void raise_mesh_error(const MeshError& error) {
    const py::object exception = package_type("MeshError")(from_diagnostic(error.diagnostic()));
    PyErr_SetObject(package_type("MeshError").ptr(), exception.ptr());
}

}  // namespace

py::handle read_only(py::array array) {
    array.attr("flags").attr("writeable") = false;
    return array.release();
}

py::object from_diagnostic(const Diagnostic& diagnostic) {
    return package_type("Diagnostic")(std::string(code_name(diagnostic.code)), diagnostic.message, diagnostic.elements,
                                      diagnostic.kind == ElementKind::vertex ? "vertex" : "triangle",
                                      diagnostic.figures);
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
