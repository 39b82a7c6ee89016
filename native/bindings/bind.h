// The one way to bind a function: its arguments and its result are converted with the GIL held, and what it does in
// between runs without, can be cancelled, and throws what convert.h translates.
#pragma once

#include "api/fair.h"
#include "bindings/convert.h"
#include "bindings/python_run.h"

namespace fairing::bindings {

using MaybeIndices = std::optional<Indices>;
using MaybePoints = std::optional<Points>;
using MaybeNumbers = std::optional<VectorX>;

// A result as convert.h and pybind11 have it; others are shown by a function of their own, with the GIL held.
struct AsItIs {
    template <typename Result>
    py::object operator()(Result&& result) const {
        return py::cast(std::forward<Result>(result));
    }
};

// What the object of a class is made of, by py::init.
struct ForInit {
    template <typename Object>
    Object operator()(Object&& object) const {
        return std::forward<Object>(object);
    }
};

// What is kept for an argument during a call.
template <typename Argument>
struct Kept {
    using Type = Argument;
};
template <typename Matrix>
struct Kept<View<Matrix>> {
    using Type = Matrix;
};
template <typename Argument>
using KeptFor = typename Kept<std::decay_t<Argument>>::Type;

template <typename Function>
struct Signature {};

template <typename Work, typename Show, typename Result, typename... Arguments>
auto in_run(Work work, Show show, Signature<std::function<Result(Arguments...)>> /*of*/) {
    return [=](const KeptFor<Arguments>&... arguments) {
        PythonRun run;
        return show(run.without_gil([&](const ProgressCallback&) { return work(arguments...); }));
    };
}

// Work that tells its progress: Python's callback comes last.
template <typename Work, typename Show, typename Result, typename... Arguments>
auto in_run(Work work, Show show, Signature<std::function<Result(const ProgressCallback&, Arguments...)>> /*of*/) {
    return [=](const KeptFor<Arguments>&... arguments, const py::object& callback) {
        PythonRun run(callback);
        return show(run.without_gil([&](const ProgressCallback& progress) { return work(progress, arguments...); }));
    };
}

// Work that also shows a first surface: behind the callback comes what is shown it, or None.
template <typename Work, typename Show, typename Result, typename... Arguments>
auto in_run(Work work, Show show,
            Signature<std::function<Result(const ProgressCallback&, const Preview&, Arguments...)>> /*of*/) {
    return [=](const KeptFor<Arguments>&... arguments, const py::object& callback, const py::object& receiver) {
        PythonRun run(callback);
        Preview preview;
        if (!receiver.is_none()) preview = [&](const Points& vertices) { run.give(receiver, vertices); };
        return show(
            run.without_gil([&](const ProgressCallback& progress) { return work(progress, preview, arguments...); }));
    };
}

template <typename Work, typename Show = AsItIs>
auto in_run(Work work, Show show = {}) {
    return in_run(work, show, Signature<decltype(std::function(work))>{});
}

template <typename Work, typename Show = AsItIs>
void bind(py::module_& module, const char* name, Work work, Show show = {}) {
    module.def(name, in_run(work, show));
}

}  // namespace fairing::bindings
