// Calls of the engine without the GIL that report to a Python callback.
#pragma once

#include <exception>

#include "base/progress.h"
#include "bindings/convert.h"

namespace fairing::bindings {

// Calls back into Python with the GIL held. A Python exception (KeyboardInterrupt included) travels as a Cancelled
// through the engine and is rethrown by the caller, so that it is never destroyed without the GIL.
class PythonProgress {
public:
    explicit PythonProgress(py::object callback) : callback_(std::move(callback)) {}

    bool operator()(double fraction, std::string_view stage);
    [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }

private:
    static bool goes_on(const py::object& answer);

    py::object callback_;
    std::exception_ptr failure_;
};

// solve(ProgressCallback) without the GIL; an exception of the callback comes out in place of the Cancelled that it
// became.
template <typename Solve>
auto without_gil(const py::object& callback, const Solve& solve) {
    PythonProgress progress(callback);
    try {
        const py::gil_scoped_release released;
        return solve(std::ref(progress));
    } catch (const Cancelled&) {
        if (progress.failure()) std::rethrow_exception(progress.failure());
        throw;
    }
}

}  // namespace fairing::bindings
