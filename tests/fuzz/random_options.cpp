#include "random_options.h"

#include "random_mesh.h"

namespace fairing::fuzz {

namespace {

InnerWeights random_weights(FuzzedDataProvider& bytes, int vertex_count) {
    InnerWeights result;
    const int count = bytes.ConsumeIntegralInRange(0, 40);
    const auto vertex = [&] { return bytes.ConsumeIntegralInRange(0, vertex_count - 1); };
    for (int k = 0; k < count; ++k) {
        const int i = vertex();
        const int j = vertex();
        result.push_back({i, j, bytes.PickValueInArray({1.0, 0.5, 0.0, 1e-300, 1e300, 1e-12})});
    }
    return result;
}

std::vector<std::array<int, 2>> random_edges(FuzzedDataProvider& bytes, int vertex_count) {
    std::vector<std::array<int, 2>> result;
    const int count = bytes.ConsumeIntegralInRange(0, 40);
    for (int k = 0; k < count; ++k) {
        const int i = bytes.ConsumeIntegralInRange(0, vertex_count - 1);
        result.push_back({i, bytes.ConsumeIntegralInRange(0, vertex_count - 1)});
    }
    return result;
}

PaperOptions random_paper_options(FuzzedDataProvider& bytes) {
    PaperOptions options;
    options.damping = bytes.PickValueInArray({0.9, 1.0, 0.1, 1e-9});
    options.cg_steps = bytes.ConsumeIntegralInRange(1, 60);
    options.h_sweeps = bytes.ConsumeIntegralInRange(1, 3);
    options.vertex_sweeps = bytes.ConsumeIntegralInRange(1, 3);
    options.acceleration = bytes.ConsumeBool() ? Acceleration::anderson : Acceleration::plain;
    options.levels = bytes.ConsumeIntegralInRange(0, 5);
    return options;
}

}  // namespace

FairOptions random_options(FuzzedDataProvider& bytes, int vertex_count) {
    FairOptions options;
    options.method = bytes.ConsumeBool() ? Method::paper : Method::global;
    options.inner_fairness = bytes.PickValueInArray(
        {InnerFairness::uniform, InnerFairness::conformal, InnerFairness::inverse_distance, InnerFairness::custom});
    options.solver.equation =
        bytes.PickValueInArray({Equation::harmonic, Equation::constant, Equation::minimal_energy, Equation::soap_film});
    if (options.solver.equation == Equation::constant) {
        options.solver.load = bytes.PickValueInArray({1.0, -20.0, 1e9, 1e-300, 1e300});
    }
    const bool averaged = options.method == Method::paper || bytes.ConsumeBool();
    options.solver.normals = averaged ? NormalKind::averaged : NormalKind::fitted;
    options.solver.tolerance = bytes.PickValueInArray({1e-6, 1e-2, 1e-12, 1e-300, 1e300});
    options.solver.max_iterations = bytes.ConsumeIntegralInRange(1, 20);
    if (options.method == Method::paper) options.paper = random_paper_options(bytes);
    if (options.inner_fairness == InnerFairness::custom) options.custom = random_weights(bytes, vertex_count);
    if (bytes.ConsumeIntegralInRange(0, 3) == 3) options.neighbours = random_edges(bytes, vertex_count);
    return options;
}

std::optional<Points> random_reference(FuzzedDataProvider& bytes, const Points& vertices) {
    if (!bytes.ConsumeBool()) return std::nullopt;
    Points reference = vertices;
    const int moves = bytes.ConsumeIntegralInRange(0, 4);
    for (int k = 0; k < moves; ++k) {
        const auto v = bytes.ConsumeIntegralInRange<Eigen::Index>(0, vertices.cols() - 1);
        reference(bytes.ConsumeIntegralInRange(0, 2), v) = special_number(bytes);
    }
    return reference;
}

}  // namespace fairing::fuzz
