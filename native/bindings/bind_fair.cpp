#include <exception>

#include "api/fair.h"
#include "bindings/convert.h"
#include "bindings/topics.h"

namespace fairing::bindings {

namespace {

// Calls back into Python with the GIL held. A Python exception (KeyboardInterrupt included) travels as a Cancelled
// through the engine and is rethrown by the caller, so that it is never destroyed without the GIL.
class PythonProgress {
public:
    explicit PythonProgress(py::object callback) : callback_(std::move(callback)) {}

    bool operator()(double fraction, std::string_view stage) {
        const py::gil_scoped_acquire gil;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (callback_.is_none()) return true;
            const py::object answer = callback_(fraction, py::str(stage.data(), stage.size()));
            return answer.is_none() || answer.cast<bool>();
        } catch (...) {
            failure_ = std::current_exception();
            return false;
        }
    }

    [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }

private:
    py::object callback_;
    std::exception_ptr failure_;
};

const char* termination_name(Termination termination) {
    switch (termination) {
        case Termination::converged: return "converged";
        case Termination::iteration_limit: return "iteration_limit";
        case Termination::stalled: return "stalled";
    }
    return "stalled";
}

py::dict to_dict(const FairResult& result) {
    py::list warnings;
    for (const Diagnostic& warning : result.warnings) warnings.append(from_diagnostic(warning));
    py::dict dict;
    dict["vertices"] = from_points(result.vertices);
    dict["fixed"] = from_indices(result.fixed);
    dict["mean_curvature"] = from_vector(result.mean_curvature);
    dict["boundary_angle"] = from_vector(result.boundary_angle);
    dict["converged"] = result.converged;
    dict["polished"] = result.polished;
    dict["termination"] = termination_name(result.termination);
    dict["iterations"] = result.iterations;
    dict["residual"] = result.residual;
    dict["initial_residual"] = result.initial_residual;
    dict["levels"] = py::tuple(py::cast(result.levels));
    dict["seconds"] = py::cast(result.seconds);
    dict["warnings"] = py::tuple(warnings);
    return dict;
}

struct Options {
    std::string equation;
    std::string inner_fairness;
    std::string normals;
    double load;
    double tolerance;
    int max_iterations;
};

// The names have been checked by the package.
Equation to_equation(const std::string& name) {
    if (name == "constant") return Equation::constant;
    if (name == "minimal_energy") return Equation::minimal_energy;
    return name == "minimal" ? Equation::minimal : Equation::harmonic;
}

FairOptions to_fair_options(const Options& options, const std::optional<IntArray>& neighbours) {
    FairOptions result;
    result.solver.equation = to_equation(options.equation);
    result.solver.load = options.load;
    result.solver.normals = options.normals == "averaged" ? NormalKind::averaged : NormalKind::fitted;
    result.solver.tolerance = options.tolerance;
    result.solver.max_iterations = options.max_iterations;
    result.inner_fairness = options.inner_fairness == "conformal" ? InnerFairness::conformal : InnerFairness::uniform;
    if (neighbours) {
        const Indices flat = to_indices(*neighbours);
        auto& edges = result.neighbours.emplace();
        for (std::size_t k = 0; k + 1 < flat.size(); k += 2) edges.push_back({flat[k], flat[k + 1]});
    }
    return result;
}

py::dict fair_arrays(const DoubleArray& vertices, const IntArray& triangles, const std::optional<IntArray>& fixed,
                     const std::optional<DoubleArray>& fixed_normals, const std::optional<DoubleArray>& reference,
                     const std::optional<IntArray>& neighbours, const Options& options, const py::object& callback) {
    const MeshInput input{to_points(vertices), to_triangles(triangles), to_optional(fixed, to_indices),
                          to_optional(fixed_normals, to_points)};
    const auto m0 = to_optional(reference, to_points);
    const FairOptions fair_options = to_fair_options(options, neighbours);
    PythonProgress progress(callback);
    FairResult result;
    try {
        const py::gil_scoped_release released;
        result = fair(input, m0, fair_options, std::ref(progress));
    } catch (const Cancelled&) {
        if (progress.failure()) std::rethrow_exception(progress.failure());
        throw;
    }
    return to_dict(result);
}

}  // namespace

void bind_fair(py::module_& module) {
    py::class_<Options>(module, "Options")
        .def(py::init<std::string, std::string, std::string, double, double, int>(), py::kw_only(), py::arg("equation"),
             py::arg("inner_fairness"), py::arg("normals"), py::arg("load"), py::arg("tolerance"),
             py::arg("max_iterations"));
    module.def("fair", &fair_arrays, py::arg("vertices"), py::arg("triangles"), py::arg("fixed"),
               py::arg("fixed_normals"), py::arg("reference"), py::arg("neighbours"), py::arg("options"),
               py::arg("progress"));
}

}  // namespace fairing::bindings
