// The one way to bind a function: its arguments and its result are converted with the GIL held, and what it does in
// between runs without, can be cancelled, and throws what convert.h translates.
#pragma once

#include "bindings/convert.h"
#include "bindings/python_run.h"

namespace fairing::bindings {

using MaybeIndices = std::optional<Indices>;
using MaybePoints = std::optional<Points>;

// A result as convert.h and pybind11 have it; others are shown by a function of their own, with the GIL held.
struct AsItIs {
    template <typename Result>
    py::object operator()(Result&& result) const {
        return py::cast(std::forward<Result>(result));
    }
};

template <typename Work, typename Show, typename Result, typename... Arguments>
auto in_run(Work work, Show show, Result (Work::* /*of*/)(Arguments...) const) {
    return [=](const std::decay_t<Arguments>&... arguments) {
        PythonRun run;
        return show(run.without_gil([&](const ProgressCallback&) { return work(arguments...); }));
    };
}

// Work that tells its progress: Python's callback comes last.
template <typename Work, typename Show, typename Result, typename... Arguments>
auto in_run(Work work, Show show, Result (Work::* /*of*/)(const ProgressCallback&, Arguments...) const) {
    return [=](const std::decay_t<Arguments>&... arguments, const py::object& callback) {
        PythonRun run(callback);
        return show(run.without_gil([&](const ProgressCallback& progress) { return work(progress, arguments...); }));
    };
}

// `names`: of the arguments.
template <std::size_t Count, typename Work, typename Show = AsItIs>
void bind(py::module_& module, const char* name, const char* const (&names)[Count],  // NOLINT: a list in braces
          Work work, Show show = {}) {
    [&]<std::size_t... K>(std::index_sequence<K...>) {
        module.def(name, in_run(work, show, &Work::operator()), py::arg(names[K])...);
    }(std::make_index_sequence<Count>{});
}

}  // namespace fairing::bindings
