#include <atomic>

#include "api/fair_solver.h"
#include "base/errors.h"
#include "bindings/bind.h"
#include "bindings/fair_options.h"
#include "bindings/topics.h"
#include "bindings/words.h"
#include "problem/solution.h"

namespace fairing::bindings {

py::dict to_dict(const FairResult& result) {
    py::list strategies;
    for (const StrategyTried& strategy : result.strategies)
        strategies.append(py::make_tuple(strategy.name, strategy.seconds));
    py::list levels;
    for (const int count : result.levels) levels.append(count);
    py::dict dict;
    dict["equation"] = equation_of(result);
    dict["provenance"] = provenance_words.word(result.provenance);
    dict["vertices"] = result.vertices;
    dict["base"] = result.base.cols() > 0 ? py::cast(result.base) : py::object(dict["vertices"]);
    dict["fixed"] = result.fixed;
    dict["mean_curvature"] = result.mean_curvature;
    dict["boundary_angle"] = result.boundary_angle;
    dict["join"] = result.join;
    dict["girth"] = py::none();
    if (result.girth) dict["girth"] = py::make_tuple(result.girth->least, result.girth->largest);
    dict["continuity"] = result.joins_curvature ? "G2" : "G1";
    dict["converged"] = result.converged;
    dict["polished"] = result.polished;
    dict["termination"] = termination_words.word(result.termination);
    dict["iterations"] = result.iterations;
    dict["residual"] = result.residual;
    dict["initial_residual"] = result.initial_residual;
    dict["levels"] = py::tuple(levels);
    dict["seconds"] = py::cast(result.seconds);
    dict["way"] = py::tuple(strategies);
    dict["warnings"] = py::tuple(py::cast(result.warnings));
    return dict;
}

namespace {

// Rows (i, j, λ) of edges.
void set_weights(Options& options, const Points& rows) {
    for (const auto row : rows.colwise())
        options.fair.custom.push_back({static_cast<int>(row[0]), static_cast<int>(row[1]), row[2]});
    options.fair.inner_fairness = InnerFairness::custom;
}

void set_paper(Options& options, const PaperOptions& paper) {
    options.fair.paper = paper;
    options.fair.solver.nested = paper.levels != 1;
}

std::optional<View<Points>> viewed(const MaybePoints& points) {
    return points ? std::optional<View<Points>>(*points) : std::nullopt;
}

// fairing.Solver's engine. A second call while one is running (from another thread, or from `progress`) is refused.
struct PythonSolver {
    FairSolver solver;
    std::atomic<bool> busy = false;

    PythonSolver(const Triangles& triangles, const MaybeIndices& fixed, const Options& options)
        : solver(triangles, fixed, options.held, options.fair) {}
};

struct Hold {
    PythonSolver& solver;
    explicit Hold(PythonSolver& held) : solver(held) {
        if (solver.busy.exchange(true)) throw std::runtime_error("this Solver is solving already: one call at a time");
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() { solver.busy = false; }
};

void bind_solver(py::module_& module) {
    // Calls change what they are given: a pointer stays one.
    py::class_<PythonSolver>(module, "Solver", py::module_local())
        .def(py::init(
            in_run([](const Triangles& triangles, const MaybeIndices& fixed,
                      const Options& options) { return std::make_unique<PythonSolver>(triangles, fixed, options); },
                   ForInit{})))
        .def("change", in_run([](PythonSolver* of, const Options& options) {
                 const Hold hold(*of);
                 of->solver.change(options.fair);
                 return true;
             }))
        .def("solve", in_run(
                          [](const ProgressCallback& progress, const Preview& preview, PythonSolver* of,
                             const Points& vertices, const MaybePoints& fixed_normals,
                             const MaybeNumbers& fixed_curvatures, const MaybePoints& reference) {
                              const Hold hold(*of);
                              return of->solver.solve(vertices, fixed_normals, fixed_curvatures, viewed(reference),
                                                      progress, preview);
                          },
                          &to_dict));
}

// An option that Python sets; `of`: where it is.
template <typename Group, typename Value>
void add(py::class_<Group>& options, const char* name, Value& (*of)(Group&)) {
    options.def_property(name, [of](Group& o) { return of(o); }, [of](Group& o, const Value& value) { of(o) = value; });
}

template <typename Group, typename Enum, std::size_t N>
void add(py::class_<Group>& options, const Words<Enum, N>& words, Enum& (*of)(Group&)) {
    options.def_property(
        std::string(words.option).c_str(), [&words, of](Group& o) { return words.word(of(o)); },
        [&words, of](Group& o, const std::string& word) { of(o) = words.value(word); });
}

void bind_paper_options(py::module_& module) {
    py::class_<PaperOptions> options(module, "PaperOptions", py::module_local());
    options.def(py::init<>())
        .def_readwrite("damping", &PaperOptions::damping)
        .def_readwrite("cg_steps", &PaperOptions::cg_steps)
        .def_readwrite("sweeps", &PaperOptions::h_sweeps)
        .def_readwrite("vertex_sweeps", &PaperOptions::vertex_sweeps)
        .def_readwrite("levels", &PaperOptions::levels);
    add(options, acceleration_words, +[](PaperOptions& o) -> Acceleration& { return o.acceleration; });
}

void bind_options(py::module_& module) {
    py::class_<Options> options(module, "Options", py::module_local());
    options.def(py::init<>());
    add(options, equation_words, +[](Options& o) -> Equation& { return o.fair.solver.equation; });
    add(options, otherwise_words, +[](Options& o) -> Otherwise& { return o.fair.solver.otherwise; });
    add(options, "load", +[](Options& o) -> double& { return o.fair.solver.load; });
    add(options, "bulge", +[](Options& o) -> double& { return o.fair.bulge; });
    add(options, fairness_words, +[](Options& o) -> InnerFairness& { return o.fair.inner_fairness; });
    add(options, method_words, +[](Options& o) -> Method& { return o.fair.method; });
    add(options, normal_words, +[](Options& o) -> NormalKind& { return o.fair.solver.normals; });
    add(options, "tolerance", +[](Options& o) -> double& { return o.fair.solver.tolerance; });
    add(options, "max_iterations", +[](Options& o) -> int& { return o.fair.solver.max_iterations; });
    add(options, "threads", +[](Options& o) -> int& { return o.fair.threads; });
    add(options, "detail", +[](Options& o) -> double& { return o.fair.detail.share; });
    add(options, "detail_size", +[](Options& o) -> double& { return o.fair.detail.size; });
    add(options, solve_start_words, +[](Options& o) -> Start& { return o.fair.start; });
    add(options, "creases", +[](Options& o) -> Indices& { return o.held.creases; });
    add(options, "smooth_curves", +[](Options& o) -> Indices& { return o.held.smooth_curves; });
    add(options, border_words, +[](Options& o) -> bool& { return o.held.fair_border; });
    add(options, "pin_radius", +[](Options& o) -> double& { return o.fair.pin_radius; });
    add(options, "neighbours", +[](Options& o) -> decltype(o.fair.neighbours)& { return o.fair.neighbours; });
    options.def_property("weights", nullptr, &set_weights);
    options.def_property("paper", nullptr, &set_paper);
}

// Option → its words.
template <typename... Words>
py::dict listed(const Words&... of_options) {
    py::dict all;
    const auto tell = [&](const auto& words) {
        py::list list;
        for (const auto& each : words.list) list.append(each.first);
        all[py::str(words.option)] = py::tuple(list);
    };
    (tell(of_options), ...);
    return all;
}

}  // namespace

void bind_fair(py::module_& module) {
    module.attr("WORDS") = listed(method_words, normal_words, equation_words, otherwise_words, fairness_words,
                                  border_words, acceleration_words);
    bind_paper_options(module);
    bind_options(module);
    bind_solver(module);
    bind(
        module, "fair",
        [](const ProgressCallback& progress, const Preview& preview, const Points& vertices, const Triangles& triangles,
           const MaybeIndices& fixed, const MaybePoints& fixed_normals, const MaybeNumbers& fixed_curvatures,
           const MaybePoints& reference, const std::optional<Triangles>& outside, const Options& options) {
            return fair({vertices, triangles, fixed, fixed_normals, fixed_curvatures, outside.value_or(Triangles(3, 0)),
                         options.held},
                        viewed(reference), options.fair, progress, preview);
        },
        &to_dict);
}

}  // namespace fairing::bindings
