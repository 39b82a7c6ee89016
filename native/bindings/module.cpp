#include "bindings/convert.h"
#include "bindings/python_run.h"
#include "bindings/topics.h"

PYBIND11_MODULE(_core, module) {
    module.doc() = "Engine of the fairing package; use the package, not this module.";
    module.attr("__version__") = FAIRING_VERSION;
    pybind11::list codes;
    for (const std::string_view name : fairing::code_names()) codes.append(pybind11::str(name.data(), name.size()));
    module.attr("CODES") = pybind11::tuple(codes);
    fairing::bindings::register_errors(module);
    fairing::bindings::end_runs_at_exit();
    fairing::bindings::bind_fair(module);
    fairing::bindings::bind_fill(module);
    fairing::bindings::bind_fillet(module);
    fairing::bindings::bind_holes(module);
    fairing::bindings::bind_measure(module);
    fairing::bindings::bind_meshing(module);
    fairing::bindings::bind_boundary(module);
    fairing::bindings::bind_shape(module);
}
