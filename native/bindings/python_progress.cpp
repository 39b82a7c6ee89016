#include "bindings/python_progress.h"

namespace fairing::bindings {

bool PythonProgress::operator()(double fraction, std::string_view stage) {
    const py::gil_scoped_acquire gil;
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (callback_.is_none()) return true;
        return goes_on(callback_(fraction, py::str(stage.data(), stage.size())));
    } catch (...) {
        failure_ = std::current_exception();
        return false;
    }
}

// A callback that returns its fraction would cancel at 0: truth is asked of nothing but booleans, NumPy's included.
bool PythonProgress::goes_on(const py::object& answer) {
    if (answer.is_none()) return true;
    py::detail::make_caster<bool> boolean;
    constexpr bool convert = false;
    if (!boolean.load(answer, convert)) {
        throw py::type_error("progress: the callback returned " + std::string(py::repr(answer)) +
                             "; False cancels, None or True goes on");
    }
    return py::detail::cast_op<bool>(boolean);
}

}  // namespace fairing::bindings
